"""Costantini and Puglisi, "Fluctuating hydrodynamics for dilute granular gases: a Monte Carlo
study", PRE 82, 011305 (2010): figures 1 to 7 and what the text states.

Run it with `python -m experiments.cooling_fluctuations`; README.md tells what is in which file.
"""

from . import claims, figures, tables
from .data import PAPER

__all__ = ["PAPER", "figures"]
PAPER.take([claims], [tables])
