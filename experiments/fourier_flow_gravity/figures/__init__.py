"""The figures of the paper and of our checks, one function each."""

from . import paper  # isort: skip
from . import checks

__all__ = ["checks", "paper"]
