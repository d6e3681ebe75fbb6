"""`python -m experiments.fourier_flow_gravity [--full] [--out FOLDER] [--fresh]`."""

from ..__main__ import cli

cli("fourier_flow_gravity")
