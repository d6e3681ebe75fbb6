"""What is said where JAX finds nothing to compute on."""

import os

import jax


def check_devices() -> None:
    """Raise ValueError, which tells what to change, for platforms that this machine does not have.

    JAX itself fails late and in its own terms (an AssertionError for a name without its plugin).
    """
    try:
        jax.devices()
    except (RuntimeError, AssertionError) as error:
        asked = jax.config.jax_platforms or os.environ.get("JAX_PLATFORMS", "")
        if not asked:
            raise
        raise ValueError(
            f"JAX_PLATFORMS = {asked!r}: JAX finds no such device here. Unset it to compute on "
            'what there is, or install what JAX needs for it (pip install "jdsmc[gpu]").'
        ) from error
