"""What runs return: labelled, saved, loaded, joined."""

from .join import join_gases
from .result import Result, load
from .sensitivity import Derivative, Sensitivity

__all__ = ["Derivative", "Result", "Sensitivity", "join_gases", "load"]
