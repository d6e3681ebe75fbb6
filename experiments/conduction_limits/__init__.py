"""Heat conduction at small gradients: known coefficients, from the Fourier flow."""

from .coefficients import PAPER

__all__ = ["PAPER"]
