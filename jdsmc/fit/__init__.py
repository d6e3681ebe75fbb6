"""Calibration: numbers of a model gas adjusted until it does what another gas does."""

from .calibrate import calibrate
from .elastic_curve import elastic_sweep

__all__ = ["calibrate", "elastic_sweep"]
