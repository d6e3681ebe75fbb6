"""Astillero and Santos (2005), "Uniform shear flow in dissipative gases": the homogeneous part.

Sections III, IV B, V B and V C; figures 5 to 8 and 10 to 18. Run it with
`python -m experiments.uniform_shear_flow`; README.md tells how the files divide the work.
"""
