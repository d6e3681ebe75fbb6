"""The figures of the paper, one function each."""

from . import slab, steady, transients

__all__ = ["slab", "steady", "transients"]
