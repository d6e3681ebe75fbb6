"""The command line: `jdsmc run | sweep | show | plot`, made from the fields of scenes and gases."""

from .main import main

__all__ = ["main"]
