"""The figures of the paper and of our checks, one function each."""

from . import checks, paper

__all__ = ["checks", "paper"]
