"""A gas of the user's own that returns nonsense is named, with the method, before it runs."""

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc.scenarios import FourierFlow, UniformShear


def transfer_of(relative_velocity, outgoing):
    return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


def gas(rate=lambda speed: speed, transfer=transfer_of, share=lambda: None) -> Any:
    """A gas made of functions."""

    class Own(jdsmc.AbstractGas):
        def rate(self, speed):
            return rate(speed)

        def momentum_transfer(self, relative_velocity, outgoing):
            return transfer(relative_velocity, outgoing)

        def transfer_share(self):
            return share()

    return Own()


RATES = {
    "none": (lambda speed: None, TypeError, "Own.rate must return a real number"),
    "two": (lambda speed: (speed, speed), TypeError, "shape of its argument"),
    "text": (lambda speed: "fast", TypeError, "real number"),
    "complex": (lambda speed: 1j * np.ones(speed.shape), TypeError, "real number"),
    "negative": (lambda speed: -speed, ValueError, r"allowed range is \[0, inf\)"),
    "nan": (lambda speed: jnp.nan * speed, ValueError, "Own.rate gives nan"),
    "zero": (lambda speed: 0.0 * speed, ValueError, "no collisions"),
    "an if": (lambda speed: 0.0 if speed > 1 else speed, TypeError, "Own.rate cannot be compiled"),
    "of NumPy": (lambda speed: np.minimum(speed, np.sqrt(speed)), TypeError, "use jax.numpy"),
    "of others": (jnp.sum, ValueError, "beside others and alone"),
}


@pytest.mark.parametrize("case", RATES)
def test_rate(case):
    rate, kind, says = RATES[case]
    for make in (lambda own: UniformShear(own, 1.0), lambda own: FourierFlow(own, 0.5)):
        with pytest.raises(kind, match=says):
            make(gas(rate))


TRANSFERS = {
    "none": (lambda g, e: None, TypeError, "must return 3 components"),
    "of NumPy": (lambda g, e: (np.asarray(g[0]),) * 3, TypeError, "transfer cannot be compiled"),
    "two": (lambda g, e: transfer_of(g, e)[:2], TypeError, "must return 3 components"),
    "text": (lambda g, e: ("a", "b", "c"), TypeError, "real numbers each"),
    "shape": (lambda g, e: (jnp.ones(3),) * 3, TypeError, "shape"),
    "nan": (lambda g, e: (jnp.nan * g[0],) * 3, ValueError, "not finite"),
}


@pytest.mark.parametrize("case", TRANSFERS)
def test_transfer(case):
    transfer, kind, says = TRANSFERS[case]
    with pytest.raises(kind, match=says):
        UniformShear(gas(transfer=transfer), 1.0)


@pytest.mark.parametrize("share", [jnp.ones(3), "half"])
def test_share(share):
    with pytest.raises(TypeError, match="transfer_share must return one number"):
        jdsmc.run(UniformShear(gas(share=lambda: share), 1.0), collisions=1.0, progress=False)


def test_rate_that_is_one_number_for_all():
    """Maxwell molecules as one writes them first: as with an array of ones."""
    small = {"n_particles": 64, "collisions": 5.0, "progress": False, "seed": 3}
    one, other = (
        jdsmc.run(UniformShear(gas(rate), 1.0), **small)
        for rate in (lambda speed: 1.0, jnp.ones_like)
    )
    found = (result.series["temperature"].values for result in (one, other))
    np.testing.assert_array_equal(*found)
