"""What runs return: labelled, saved, loaded, joined."""

from . import gravity_effect
from .join import join_gases
from .result import Result, load
from .sensitivity import Derivative, Sensitivity

__all__ = ["Derivative", "Result", "Sensitivity", "gravity_effect", "join_gases", "load"]
