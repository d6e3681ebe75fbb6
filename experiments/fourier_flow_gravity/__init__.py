"""Tahiri, Tij and Santos, "Monte Carlo simulation of a hard-sphere gas in the planar Fourier flow
with a gravity field" (2000): figures 2 to 7, tables 2 to 5 and all that the text quotes.

Run it with `python -m experiments.fourier_flow_gravity`; README.md tells how the files divide the
work.
"""

from . import claims, figures, tables
from .data import PAPER

__all__ = ["PAPER", "figures"]
PAPER.take([claims], [tables])
