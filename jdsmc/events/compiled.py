"""How the functions of this package are compiled."""

from numba import njit

OPTIONS = {"nogil": True, "error_model": "numpy"}


def compiled(function):
    """numba's njit without the GIL, without checks of division, and without counting references.

    The last triples the speed: otherwise every call counts every array up and down with atomic
    instructions. It is right where nothing is allocated, as here: arrays are arguments only. The
    option is not public; where numba does not know it, the code is slower and otherwise the same.
    """
    try:
        return njit(**OPTIONS, _nrt=False)(function)
    except (KeyError, TypeError):
        return njit(**OPTIONS)(function)
