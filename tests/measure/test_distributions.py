"""Histograms of velocities against what is known of them."""

import jax.numpy as jnp
import numpy as np
from scipy.special import erf

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.measure.distributions import BIN_WIDTH, at_walls, bin_centres, histogram, over_slab
from jdsmc.scenarios import FourierFlow, ShearedSlab


def test_what_is_beyond_is_in_no_bin():
    """On either side; a negative index would count from the other end."""
    values = jnp.asarray([-25.0, -10.05, -9.95, 0.05, 10.05, jnp.inf, -jnp.inf, 1e9])
    for symmetric, first in ((True, 2), (False, 1)):
        counts = np.asarray(histogram(values, symmetric=symmetric)) * values.size
        assert counts.sum() == first
        assert counts[len(counts) // 2 if symmetric else 0] == 1


def in_bins(symmetric: bool):
    """Shares of a Maxwellian in the bins, of a component or of the speed."""
    edges = bin_centres(symmetric)[:, None] + [-BIN_WIDTH / 2, BIN_WIDTH / 2]
    whole = 0.5 * erf(edges)
    if not symmetric:
        whole = erf(edges) - 2 / np.sqrt(np.pi) * edges * np.exp(-(edges**2))
    return whole[:, 1] - whole[:, 0]


def test_few_in_a_layer_show_the_distribution_and_no_flow():
    """Any flow that layers have, and their small number, leave the Maxwellian as it is.

    Without the stretch, two particles would seem to be at half of their temperature. 3·10⁵
    particles (one in twenty of them alone): each count within five of its errors.
    """
    rng = np.random.default_rng(0)
    count, number = 100_000, 300_000
    layer = np.sort(rng.integers(0, count, number))  # three on average, some layers empty
    velocity = [
        rng.normal(size=number) * np.sqrt(0.5) + rng.normal(size=count)[layer] * 3 for _ in range(3)
    ]
    layer = np.append(layer, count)  # one alone, and left out
    velocity = tuple(jnp.asarray(np.append(v, 7.0), jnp.float32) for v in velocity)
    found = over_slab(jnp.asarray(layer), velocity, count + 1)
    for values, symmetric in (
        (found.marginal_x, True),
        (found.marginal_y, True),
        (found.speed, False),
    ):
        known = in_bins(symmetric)
        error = np.sqrt(known / number) + 3 / number
        assert np.all(np.abs(np.asarray(values) - known) < 5 * error)
        assert abs(np.sum(values) - 1.0) < 1e-5  # float32, 3e5 counts


def test_places_at_walls():
    """Two of three particles are in the lowest layer of three, one in the highest, none between."""
    found = at_walls(jnp.array([0, 0, 2]), jnp.array([0.5, -1.0, 0.5]), 3, (0.5, 1.0, 2.0))
    centre = bin_centres(True)
    lower, middle, upper = (
        np.asarray(x)
        for x in (found.marginal_z_lower, found.marginal_z_middle, found.marginal_z_upper)
    )
    assert lower.sum() == 2.0 and middle.sum() == 0.0 and upper.sum() == 1.0
    np.testing.assert_allclose(np.sort(centre[lower > 0]), [-1.95, 1.05], atol=1e-6)
    np.testing.assert_allclose(centre[upper > 0], [0.25], atol=1e-6)


def test_equilibrium_between_walls():
    """Maxwellian in every place; 8 realizations: Student's t, χ² per bin 1.4 on average."""
    scene = FourierFlow(InelasticHardSpheres(1.0), 1.0, length=1.0, layers=4)
    result = jdsmc.run(scene, n_particles=512, duration=150.0, time_step=0.1, progress=False)
    for place in ("lower", "middle", "upper"):
        value, error = (
            result.distribution[f"marginal_z_{place}{x}"].values for x in ("", "_error")
        )
        known = in_bins(True) / BIN_WIDTH
        seen = known > 0.01
        assert np.mean(((value - known) / error)[seen] ** 2) < 2.5
        assert abs(np.sum(value) * BIN_WIDTH - 1.0) < 0.02  # n/n̄ of 512 in four layers


def test_sheared_slab_is_the_homogeneous_gas():
    """Uniform shear: the same distribution of speeds with and without places, within 5 errors."""
    options = {"progress": False, "collisions": 120.0}
    gas = InelasticHardSpheres(0.8)
    scene = ShearedSlab(gas, 1.0, 2.5, "local_equilibrium", layers=10)
    slab = jdsmc.run(scene, n_particles=2048, **options).distribution
    flat = jdsmc.run(
        jdsmc.scenarios.UniformShear(gas, 1.0), n_particles=2048, **options
    ).distribution
    for name in ("speed", "marginal_x", "marginal_y"):
        error = np.hypot(slab[f"{name}_error"], flat[f"{name}_error"]).values
        seen = np.minimum(slab[name], flat[name]).values > 0.01
        off = ((slab[name] - flat[name]).values / error)[seen]
        assert np.mean(off**2) < 2.5  # 8 realizations each
