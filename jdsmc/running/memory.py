"""What is said where a gas does not fit into memory."""

from collections.abc import Iterator
from contextlib import contextmanager

import jax

from ..scenarios.options import Options


@contextmanager
def room_for(gases: int, options: Options) -> Iterator[None]:
    """Raise MemoryError, which tells what to change, where a device has no room for a batch."""
    try:
        yield
    except (jax.errors.JaxRuntimeError, MemoryError) as error:
        if isinstance(error, jax.errors.JaxRuntimeError) and not _is_about_room(error):
            raise
        raise MemoryError(
            f"{gases} gases of {options.n_particles} particles do not fit into memory; take fewer "
            "n_particles, fewer n_realizations (and merge runs of several seeds: jdsmc.merge), or "
            "fewer points of a sweep at once."
        ) from error


def _is_about_room(error: Exception) -> bool:
    return "RESOURCE_EXHAUSTED" in str(error) or "Out of memory" in str(error)
