"""How a batch is cut among cores, and put together within one, must not show in the results."""

import itertools

import numpy as np
import pytest

from jdsmc import InelasticHardSpheres, engine, grid
from jdsmc.engine import Engine
from jdsmc.options import Options
from jdsmc.scenarios import UniformShear


def first_chunk(parts: int, together: int | None, monkeypatch):
    """Temperatures and collisions of two gases x four realizations, cut and put together so."""
    edges = np.linspace(0, 8, parts + 1).astype(int)
    cut = [slice(int(a), int(b)) for a, b in itertools.pairwise(edges)]
    monkeypatch.setattr(engine, "_cut", lambda size: cut)
    monkeypatch.setattr(engine, "_together", lambda part, options: together)
    scene, _ = grid.flatten(UniformShear(InelasticHardSpheres(np.array([0.6, 0.9])), 4.0))
    options = Options.checked(512, 0.05, "strang", "float32", 4, 2)
    record, _ = Engine(scene, 4, 1, options).advance()
    moments = record.moments
    return (moments.xx + moments.yy + moments.zz) / 3.0, record.tally.accepted


@pytest.mark.parametrize(("parts", "together"), [(1, 8), (2, None), (2, 2)])
def test_a_gas_does_not_know_its_neighbours(parts, together, monkeypatch):
    """Against all gases in one part, one after the other.

    The same random numbers, hence the same collisions; fused arithmetic may round differently
    (1e-7 a step, 8 steps; 1e-5 leaves room for a few of them to add up).
    """
    temperature, accepted = first_chunk(parts, together, monkeypatch)
    reference, collisions = first_chunk(1, None, monkeypatch)
    np.testing.assert_array_equal(accepted, collisions)
    np.testing.assert_allclose(temperature, reference, rtol=1e-5)
    assert len(np.unique(reference[..., -1])) == 8  # every gas has random numbers of its own


@pytest.mark.parametrize(
    ("n_particles", "in_space", "gases", "expected"),
    [
        (1_000, False, 30, 15),
        (1_000, False, 23, None),
        (50_000, False, 4, None),
        (1_000, True, 30, None),
    ],
)
def test_gases_put_together(n_particles, in_space, gases, expected):
    """As many small homogeneous gases as divide a part and have 20 000 particles, on a CPU."""
    options = Options.checked(n_particles, 0.05, "strang", "float32", 4, 2, in_space)
    assert engine._together(slice(10, 10 + gases), options) == expected
