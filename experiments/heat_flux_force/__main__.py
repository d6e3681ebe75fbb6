"""`python -m experiments.heat_flux_force [--full] [--out FOLDER] [--fresh]`."""

from ..__main__ import cli

cli("heat_flux_force")
