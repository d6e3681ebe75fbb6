"""Montanero, Santos and Garzó, "First-order Chapman-Enskog velocity distribution function in a
granular gas", Physica A 376, 75 (2007): figures 1 to 7 and all that the text quotes.

Run it with `python -m experiments.heat_flux_force`; README.md tells how the files divide the work.
"""

from . import claims, figures, tables
from .data import PAPER

__all__ = ["PAPER", "figures"]
PAPER.take([claims], [tables])
