"""Time series: every number belongs to the time beside it, whatever changes while it is counted."""

import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardDisks, InelasticHardSpheres
from jdsmc.running.history import record_means
from jdsmc.scenarios import CouetteFlow, HomogeneousCooling, MolecularDynamics, UniformShear

from ..helpers import Viscoelastic


def _scores(series, name, truth, error=0.0):
    return (series[name].values - truth) / np.hypot(series[f"{name}_error"].values, error)


def test_cooling_rate_of_a_gas_that_heats_up():
    """ζ/ζ0 is ⟨V12³⟩ over that of a Maxwellian at every instant, eq. (2.10).

    The temperature rises by a third from record to record. Of 64 realizations; the same gases know
    both numbers, so that their difference has less than both errors, and the first records much
    less. Counted against the temperature at the start of a record it was up to 13 errors high.
    """
    scene = UniformShear(InelasticHardSpheres(0.7), 4.0)
    sizes = {"n_particles": 1280, "n_realizations": 64, "duration": 2.5}
    series = jdsmc.run(scene, progress=False, seed=1, **sizes).series
    speeds, error = (series[f"relative_speed_cubed{x}"].values for x in ("", "_error"))
    scores = _scores(series, "relative_speed_cubed_collisional", speeds, error)
    assert np.max(np.abs(scores)) < 3.5
    assert abs(np.mean(scores)) < 1.0


def test_rates_of_a_gas_with_a_speed_of_its_own():
    """At the start it is a Maxwellian, so that both ratios are 1."""
    scene = HomogeneousCooling(Viscoelastic(0.4))
    sizes = {"n_particles": 1280, "n_realizations": 64, "duration": 4.0}
    series = jdsmc.run(scene, progress=False, seed=1, **sizes).series.isel(sample=0)
    for name in ("collision_rate_ratio", "relative_speed_cubed_collisional"):
        assert float(series[f"{name}_error"]) < 0.02
        assert abs(_scores(series, name, 1.0)) < 3.0


def test_momentum_under_a_force_grows_as_time():
    """Walls that hardly ever absorb leave the momentum to the force: u = f t, without noise."""
    scene = CouetteFlow(
        InelasticHardSpheres(1.0), 0.0, accommodation=1e-12, length=4.0, force=0.05, layers=8
    )
    sizes = {"n_particles": 512, "n_realizations": 8, "duration": 30.0, "steps_per_record": 4}
    series = jdsmc.run(scene, progress=False, **sizes).series
    time, velocity = series["time"].values, series["mean_velocity"].values
    assert np.ptp(time) > 20.0
    # the Maxwellian at the start has a momentum of its own
    grown = velocity - velocity[0] - 0.05 * (time - time[0])
    # a step that changes within a record moves its samples by a hundredth of it; half of a record
    # would be 0.04
    assert np.max(np.abs(grown)) < 1e-3
    first = 0.05 * time[0]
    noise = float(series["mean_velocity_error"][0])
    assert abs(velocity[0] - first) < 4.0 * noise


def test_molecular_dynamics_samples_at_the_end_of_an_interval():
    scene = MolecularDynamics(InelasticHardDisks(1.0), 0.1)
    result = jdsmc.run(scene, n_particles=64, duration=7.0, progress=False)
    time = result.series["time"].values
    assert time == pytest.approx(0.7 * np.arange(1, len(time) + 1))


def test_means_over_records():
    """Parabolas are integrated exactly, here over unequal records."""
    edges = np.array([[0.0, 0.5, 0.9, 1.6, 2.0, 2.7]])
    integral = edges + edges**2 - edges**3
    exact = np.diff(integral) / np.diff(edges)
    values = 1.0 + 2.0 * edges - 3.0 * edges**2
    assert record_means(edges, values[:, :-1], values[:, 1:]) == pytest.approx(exact)
    for records in (1, 2):  # what is known of so few
        same = np.full((1, records), 3.0)
        assert record_means(edges[:, : records + 1], same, same) == pytest.approx(3.0)


def test_frictional_gas_has_no_cooling_rate():
    scene = UniformShear(ElasticHardSpheres(0.7), 4.0)
    series = jdsmc.run(scene, n_particles=1024, collisions=2.0, progress=False).series
    assert np.all(np.isnan(series["relative_speed_cubed_collisional"].values))
    assert np.all(np.isfinite(series["collision_rate_ratio"].values))
