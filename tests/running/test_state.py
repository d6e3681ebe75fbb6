"""The state of a session is one pytree, from which another session goes on to the bit."""

import jax
import numpy as np
import pytest

from jdsmc import InelasticHardDisks, InelasticHardSpheres
from jdsmc.running.limits import Limits
from jdsmc.running.run import options_of, scenes_of
from jdsmc.running.session import Session
from jdsmc.scenarios import MolecularDynamics, UniformShear

SCENES = {
    "device": (UniformShear(InelasticHardSpheres([0.6, 0.8]), 4.0), 512),
    "host": (MolecularDynamics(InelasticHardDisks(0.9), density=0.05), 160),
}


def session(kind: str) -> Session:
    scene, number = SCENES[kind]
    points = scenes_of(scene)
    options = options_of(points, number, 0.1, "strang", "float32", 8)
    points = [one.prepared() for one in points]
    return Session(points, 8, 3, options, Limits(points, options, rtol=0.05))


def through_plain_arrays(state):
    """The leaves alone are copied, as a file would keep them; the structure is that of another."""
    leaves, structure = jax.tree.flatten(state)
    assert all(isinstance(leaf, np.ndarray | float | int) for leaf in leaves)
    return jax.tree.unflatten(structure, [np.array(leaf) for leaf in leaves])


@pytest.mark.parametrize("kind", SCENES)
def test_another_session_goes_on_from_the_state(kind):
    """Also past the first look for a steady state, whose findings are in the state."""
    whole = session(kind)
    for _ in range(4):
        whole.advance()
        whole.ending()
    other = session(kind)
    other.take(through_plain_arrays(whole.state()))
    for one in (whole, other):
        for _ in range(3):
            one.advance()
            one.ending()
    for a, b in zip(*(jax.tree.leaves(s.state()) for s in (whole, other)), strict=True):
        np.testing.assert_array_equal(a, b)
