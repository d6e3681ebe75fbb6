"""How the functions of this package are compiled."""

from typing import Any

from numba import njit

OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy"}
UNCOUNTED: dict[str, Any] = {"_nrt": False}


def compiled(function):
    """numba's njit without the GIL, without checks of division, and without counting references.

    The last triples the speed: otherwise every call counts every array up and down with atomic
    instructions. It is right where nothing is allocated, as here: arrays are arguments only. The
    option is not public; where numba does not know it, the code is slower and otherwise the same.
    """
    try:
        return njit(**OPTIONS, **UNCOUNTED)(function)
    except (KeyError, TypeError):
        return njit(**OPTIONS)(function)
