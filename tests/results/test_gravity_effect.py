"""The rule of equal reduced gradient, on profiles made up: its errors, blind."""

import numpy as np
import pytest

from jdsmc.results.gravity_effect import linearised
from jdsmc.stats import jackknife

Z = (np.arange(100) + 0.5) / 10.0
REALIZATIONS, SEEDS = 16, 150


def made_up(seed: int, flatness: float, noise: float) -> dict[str, np.ndarray]:
    """Profiles (gravity, realization, z): without gravity ε falls by 0.05/λ0; with it ε and κ* fall
    by `flatness` of that, and ε has the same value at z = 4. Noise is correlated over 1 λ0."""
    random = np.random.default_rng(seed)

    def with_noise(profiles, size):
        white = random.normal(size=(2, REALIZATIONS, Z.size + 10))
        total = np.cumsum(white, axis=-1)
        return profiles[:, None, :] + size * (total[..., 10:] - total[..., :-10]) / np.sqrt(10.0)

    slope = 0.05 * np.array([1.0, flatness])[:, None]
    gradient = 0.35 - slope * (Z - np.array([[5.0], [4.0]]))
    return {
        "reduced_gradient": with_noise(gradient, noise),
        "kappa_star": with_noise(1.0 - 0.5 * slope * (Z - 4.0), noise),
        "reduced_gravity": np.broadcast_to(0.01, (2, REALIZATIONS, Z.size)),
        "mean_free_paths": np.broadcast_to(Z, (2, REALIZATIONS, Z.size)),
    }


def scores(flatness: float, noise: float) -> tuple[np.ndarray, np.ndarray]:
    """(estimate - truth)/error of z0 and κ* of the state with gravity, and which are flat."""
    found, flat = [], []
    for seed in range(SEEDS):
        averages = made_up(seed, flatness, noise)
        rule = linearised(lambda one: one, averages, 0, Z, 5.0, None)
        value, error, _ = jackknife(averages, rule.at_points, axis=1)
        truth = {"z0": 4.0, "kappa_star": 1.0}
        found.append([(value[n][1] - truth[n]) / error[n][1] for n in truth])
        flat.append(rule.flat[1])
    return np.array(found), np.array(flat)


@pytest.mark.parametrize(("flatness", "noise"), [(1.0, 0.01), (1.0, 0.03), (0.1, 0.005)])
def test_errors_of_the_point_cover_it(flatness, noise):
    """Steep, and so flat that the noise of neighbouring layers exceeds their difference."""
    found, flat = scores(flatness, noise)
    known = found[~flat]
    assert len(known) > 0.5 * SEEDS
    # 16 realizations: Student's t of 15 has a variance of 1.15, and within 2 errors are 94%; 150
    # squares scatter by 12%. The flattest slope is 6 times its error, a second-order share of 20%.
    # With the slope between neighbouring layers ⟨z²⟩ of z0 is 1.2, 1.8 and 3 there.
    assert np.all(np.mean(known**2, axis=0) < 1.6), np.mean(known**2, axis=0)
    assert np.all(np.mean(np.abs(known) < 2.0, axis=0) > 0.90)


def test_a_gradient_that_does_not_change_has_no_point():
    """Nothing but noise: an error would be made up."""
    _, flat = scores(0.0, 0.01)
    assert np.mean(flat) > 0.99  # five errors of a slope with 15 degrees of freedom: 2e-4
