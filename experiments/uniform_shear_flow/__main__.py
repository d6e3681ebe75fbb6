"""`python -m experiments.uniform_shear_flow [--full] [--out FOLDER] [--fresh]`."""

from ..__main__ import cli

cli("uniform_shear_flow")
