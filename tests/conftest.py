"""Shapes and types of every annotated function are checked at run time, here only."""

from jaxtyping import install_import_hook

with install_import_hook("jdsmc", "beartype.beartype"):
    import jdsmc  # noqa: F401

import jax
import matplotlib

matplotlib.use("agg")
# A float64 constant must not widen a float32 gas, nor an integer become a float, unnoticed.
jax.config.update("jax_numpy_dtype_promotion", "strict")
