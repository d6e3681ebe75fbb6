"""Every number the text of the paper quotes, and where it stands. The paper gives no error bars."""

from ..compare import Quoted

NUMBERS = (
    Quoted("relaxation", "t/τ to steady κ'(t), α = 0.3, ε* = 0.025", 10, 5, "4, Fig. 1"),
    Quoted("relaxation_sonine_03", "t/τ to steady b'_2(t), α = 0.3", 10, 5, "4, Fig. 2"),
    Quoted("relaxation_sonine_1", "t/τ to steady b'_1(t), α = 1", 10, 5, "4, Fig. 2"),
    Quoted("elastic", "κ'/κ0, α = 1", 1.025218, 5e-7, "4, Fig. 3"),
    Quoted("share_elastic", "share of c_x² <= 6 in the heat flux, α = 1", 0.87, 0.005, "4, Fig. 7"),
    Quoted("share_03", "share of c_x² <= 6 in the heat flux, α = 0.3", 0.66, 0.005, "4, Fig. 7"),
)

THEORY = (Quoted("elastic", "κ/κ0, Sonine polynomials to order 10", 1.025218, 5e-7, "4, Ref. 37"),)
"""Numbers that are formulas, not measurements: compared with the formula."""

MISPRINTS = (
    ("(2.44)", "the factor λ c is missing on the right-hand side; compare (A.1)"),
    ("below (2.40)", "the first of the two κ' should be κ: without density gradient (2.23) holds"),
    ("end of section 3.2", "what (3.1) determines is 𝒜', not 𝒜"),
    ("(4.6)", "the upper limit is |c_x|, not c_x²: the variable of integration is u_x"),
    ("caption of Fig. 7", "the ratio is β1/b'_1, not β1/b_1"),
)
"""Where the paper cannot be meant as printed, and what was taken instead."""
