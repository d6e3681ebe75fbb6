"""Scenes: one physical situation a file."""

from .uniform_shear import UniformShear

__all__ = ["UniformShear"]
