"""Reduced units, and the numbers of elastic hard spheres in them: each is written here only.

m = 1, λ0 = 1 (mean free path at the mean density), v0 = √(2 T0/m) = 1, hence τ0 = λ0/v0 = 1 and
T0 = 1/2.
"""

import math

INITIAL_TEMPERATURE = 0.5
"""T0 in units of m v0²."""

VISCOSITY_TIME = 1.016 * 5.0 * math.sqrt(math.pi) / 8.0
"""τ_η/τ: eq. (2.18) of Astillero and Santos (2005)."""

COOLING = 2.0 / (3.0 * math.sqrt(math.pi))
"""ζ0 τ over 1-α²: eq. (2.16) there."""

MAXWELL_CUBED = 32.0 / math.sqrt(math.pi)
"""⟨V12³⟩0 / (T/m)^{3/2}: eq. (2.15) there."""

CONDUCTIVITY = 75.0 * math.sqrt(math.pi) / 64.0
"""κ0 at T0 in n λ0 v0, first approximation: eq. (2.47) of Montanero, Santos and Garzó (2007)."""

CONVERGED_ORDER = 10
"""Sonine polynomials after which the coefficients of elastic spheres keep all digits shown."""
