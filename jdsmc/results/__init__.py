"""What runs return: labelled, saved, loaded, joined."""

from .join import join_gases
from .result import Result, load

__all__ = ["Result", "join_gases", "load"]
