"""Shapes and types of every annotated function are checked at run time, here only.

All of jdsmc but `theory`, plain NumPy on anything array-like, which beartype cannot tell, and
`events`, whose functions numba compiles.
"""

import importlib.util
import os
import pkgutil

from jaxtyping import install_import_hook

if "PYTEST_XDIST_WORKER" in os.environ:  # one thread of XLA in each of the processes
    os.environ.setdefault("NPROC", "1")

_SPEC = importlib.util.find_spec("jdsmc")
assert _SPEC is not None
_CHECKED = [
    f"jdsmc.{module.name}"
    for module in pkgutil.iter_modules(_SPEC.submodule_search_locations)
    if module.name not in ("theory", "events")
]
with install_import_hook(_CHECKED, "beartype.beartype"):
    import jdsmc  # noqa: F401

import jax  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("agg")
# A float64 constant must not widen a float32 gas, nor an integer become a float, unnoticed.
jax.config.update("jax_numpy_dtype_promotion", "strict")
