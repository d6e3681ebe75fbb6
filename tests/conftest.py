"""Shapes and types of every annotated function are checked at run time, here only.

All of jdsmc but `theory`, plain NumPy on anything array-like, which beartype cannot tell, and
`events`, whose functions numba compiles.
"""

import importlib.util
import os
import pkgutil
import tempfile

from jaxtyping import install_import_hook

# Tests leave nothing in the user's folders.
os.environ.setdefault("JDSMC_COMPILATION_CACHE", "off")

_SPEC = importlib.util.find_spec("jdsmc")
assert _SPEC is not None
_CHECKED = [
    f"jdsmc.{module.name}"
    for module in pkgutil.iter_modules(_SPEC.submodule_search_locations)
    if module.name not in ("theory", "events")
]
if os.environ.get("PROPERTIES") == "full":  # what is passed there violates annotations on purpose
    _CHECKED = []
with install_import_hook(_CHECKED, "beartype.beartype"):
    import jdsmc  # noqa: F401

import jax  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("agg")
# A float64 constant must not widen a float32 gas, nor an integer become a float, unnoticed.
jax.config.update("jax_numpy_dtype_promotion", "strict")


def pytest_configure(config):
    """What processes side by side inherit: one thread each, and programs compiled by another.

    Told to themselves it would come too late: NumPy is loaded before this file. Threads of linear
    algebra wait busily for each other, which took fifteen times the work.
    """
    if not getattr(config.option, "numprocesses", None) or hasattr(config, "workerinput"):
        return
    programs = tempfile.TemporaryDirectory()
    config.add_cleanup(programs.cleanup)
    os.environ["JAX_COMPILATION_CACHE_DIR"] = programs.name
    os.environ["JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS"] = "0"
    for name in ("NPROC", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")


LONGEST = (
    *("test_notebooks", "test_sheared_slab", "test_steady", "test_cooling_disks", "test_views"),
    *("test_sensitivity", "test_heat_flux_force", "test_uniform_shear", "test_impulse_response"),
    *("test_fourier_flow", "test_own_gas", "test_run", "test_pairs"),
)
"""Files of tests that take most, 20 s of CPU and more."""


def pytest_collection_modifyitems(items):
    """The longest first, so that no process is left alone with one at the end."""
    rank = {name: number for number, name in enumerate(LONGEST)}
    items.sort(key=lambda item: rank.get(item.path.stem, len(rank)))
