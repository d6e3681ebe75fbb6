"""`python -m experiments.cooling_fluctuations [--full] [--out FOLDER] [--fresh]`."""

from ..__main__ import cli

cli("cooling_fluctuations")
