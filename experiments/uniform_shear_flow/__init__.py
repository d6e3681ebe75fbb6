"""Astillero and Santos (2005), "Uniform shear flow in dissipative gases".

All of it: figures 1 to 18, homogeneous and inhomogeneous. Run it with
`python -m experiments.uniform_shear_flow`; README.md tells how the files divide the work.
"""

from . import (
    claims_distribution,
    claims_slab,
    claims_steady,
    claims_transient,
    figures,
    figures_slab,
    tables,
)
from .data import PAPER

__all__ = ["PAPER", "figures", "figures_slab"]
PAPER.take([claims_distribution, claims_slab, claims_steady, claims_transient], [tables])
