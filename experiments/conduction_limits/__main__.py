"""`python -m experiments.conduction_limits [--full] [--out FOLDER] [--fresh]`."""

from ..__main__ import cli

cli("conduction_limits")
