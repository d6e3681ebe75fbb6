"""`python -m experiments.calibration [--full] [--out FOLDER] [--fresh]`."""

from ..__main__ import cli

cli("calibration")
