"""The call: what it returns, what it keeps, what it refuses, and the exact identities."""

import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres
from jdsmc.derivatives.response import Facts
from jdsmc.derivatives.steady import steady_derivatives
from jdsmc.scenarios import FourierFlow, NavierStokes, UniformShear

SMALL = {
    **{"n_particles": 512, "n_realizations": 8, "progress": False},
    **{"time_step": 0.1, "steps_per_record": 8, "rtol": 0.05},
}
ALPHA, BETA, RATE = 0.7, 0.85, 1.0
STRESSES = ("shear_stress", "normal_stress_xy", "pressure_yy", "a2", "relative_speed_cubed")


@pytest.fixture(scope="module")
def elastic():
    """Derivatives of the frictional elastic gas with respect to all three numbers."""
    return jdsmc.sensitivity(UniformShear(ElasticHardSpheres(ALPHA, BETA), RATE), **SMALL)


def without_facts(found, paths, mode=False, stationary=False):
    """The same run evaluated without the exact facts: (value, error) by observable and number."""
    session = found.result.under_way.session
    start = int(session.tracker.start[0])
    facts = Facts(mode, stationary)
    return steady_derivatives(session.history.scenes[0], session.samples, 0, start, paths, facts)


PATHS = {
    "restitution": "gas.restitution",
    "rate_factor": "gas.rate_factor",
    "shear_rate": "shear_rate",
}


def test_scaling_of_the_frictional_elastic_gas(elastic):
    """(β ∂_β + c ∂_c) of what is reduced is zero, c ∝ 1 - α²: with the facts by construction."""
    for name in STRESSES:
        of = elastic[name]
        drag = of["restitution"].value * (1 - ALPHA**2) / (-2 * ALPHA)
        assert drag == pytest.approx(-BETA * of["rate_factor"].value, rel=1e-5)
    # a* goes as β times a function of (1-α²)/β
    of, own = elastic["reduced_shear_rate"], elastic.result["reduced_shear_rate"]
    drag = of["restitution"].value * (1 - ALPHA**2) / (-2 * ALPHA)
    # a* of the samples, from which noise is taken that the value of the run keeps
    assert abs(drag + BETA * of["rate_factor"].value - own.value) < 2 * own.error < 0.02


def test_scaling_without_the_facts(elastic):
    """The same from the samples alone, to three standard errors and the truncation."""
    found = without_facts(elastic, PATHS)
    for name in ("shear_stress", "normal_stress_xy"):
        drag = (1 - ALPHA**2) / (-2 * ALPHA)
        values = found[f"{name}_left_out"]
        each = drag * values[:, 0] + BETA * values[:, 1]
        error = np.sqrt((len(each) - 1) * np.var(each))
        assert 0 < error < 0.2
        total = drag * found[name][0] + BETA * found[name][1]
        assert abs(total) < 3 * error + found[f"{name}_truncation"][1]
        assert abs(found[name][2]) < 3 * found[f"{name}_error"][2]  # the shear rate


def test_what_is_zero_by_symmetry_is_zero(elastic):
    for name in (*STRESSES, "reduced_shear_rate", "reduced_viscosity", "collision_rate_ratio"):
        one = elastic[name]["shear_rate"]
        assert (one.value, one.error, one.truncation) == (0.0, 0.0, 0.0)


def test_temperature_goes_as_the_square_of_the_shear_rate(elastic):
    """dT/da = 2T/a: known in terms of T.

    T of whole blocks of samples, which start at or after the first record that is averaged.
    """
    one, heat = elastic["temperature"]["shear_rate"], elastic.result["temperature"]
    assert abs(one.value - 2 * heat.value / RATE) < 2 * heat.error / RATE
    assert one.error < 3 * 2 * heat.error / RATE


def test_kept_in_files(elastic, tmp_path):
    assert elastic.result.sensitivity is elastic
    again = jdsmc.load(elastic.result.save(tmp_path / "run.h5")).sensitivity
    one, other = (s["shear_stress"]["restitution"] for s in (elastic, again))
    assert (one.value, one.error, one.truncation) == (other.value, other.error, other.truncation)
    assert one.uncertainty == np.hypot(one.error, one.truncation)
    assert (2.0 * one).error == pytest.approx(2.0 * one.error)
    numbers = ("restitution", "rate_factor", "drag_factor", "shear_rate")
    assert again.parameters == numbers


def test_shown(elastic):
    text = elastic.table()
    assert "shear_stress" in text and "rate_factor" in text and repr(elastic).endswith(text)
    assert "<table>" in elastic._repr_html_()
    assert elastic.plot().axes


def test_what_cannot_be_had_is_absent(elastic):
    for name in ("time_step", "speed_ratio"):
        assert name not in elastic
        with pytest.raises(KeyError, match="no derivative"):
            elastic[name]
    with pytest.raises(KeyError, match="no observable"):
        elastic["nothing"]
    with pytest.raises(KeyError, match="duration"):
        elastic.series  # noqa: B018


def test_sweep_and_series():
    """Every point has its own; a run of given length has derivatives at fixed time."""
    scene = UniformShear(InelasticHardSpheres([0.6, 0.7]), RATE)
    options = SMALL | {"collisions": 80.0, "steps_per_record": 32}
    result = jdsmc.run(scene, sensitivity="restitution", **options)
    one = result.sensitivity["shear_stress"]["restitution"]
    assert np.shape(one.value) == (2,)
    # -0.5200(5) at 0.7 by differences of long runs; less where the gas is more inelastic
    assert abs(one.value[1] + 0.52) < 4 * one.uncertainty[1] < 0.2
    assert -0.52 < one.value[0] < 0
    assert one[1].truncation == one.truncation[1] and "±" in repr(one)
    with pytest.raises(
        KeyError, match="no derivative with respect to 'foo'; there are restitution"
    ):
        result.sensitivity["shear_stress"]["foo"]
    at = result.at(restitution=0.7).sensitivity["shear_stress"]["restitution"]
    assert at.value == one.value[1]
    series = result.sensitivity.series
    assert np.all(series["temperature"].isel(sample=0) == 0.0)
    late = series.isel(sample=-1).sel(parameter="restitution")
    off = late["shear_stress"] - one.value  # one instant against all: its error decides
    assert np.all(np.abs(off) < 4 * late["shear_stress_error"])
    assert np.all(late["shear_stress_error"] < 1.5)  # of 4096 particles


def test_off_unless_asked():
    result = jdsmc.run(UniformShear(InelasticHardSpheres(0.7), RATE), **SMALL)
    assert "sensitivity" not in result.to_xarray().children
    with pytest.raises(KeyError, match="sensitivity=True"):
        result.sensitivity  # noqa: B018


@pytest.mark.parametrize(
    ("scene", "wrt", "says"),
    [
        (UniformShear(ElasticHardSpheres(0.7), 1.0), "rate_factor", "word 'linear'"),
        (UniformShear(InelasticHardSpheres(0.7), 1.0), "nothing", "no physical number"),
        (UniformShear(InelasticHardSpheres(0.7), 1.0), (), "empty"),
        (UniformShear(InelasticHardSpheres(0.7), 1.0), False, "asks for no derivatives"),
        (NavierStokes(InelasticHardSpheres(0.7)), "restitution", "moment_drift"),
    ],
)
def test_refused_in_a_sentence(scene, wrt, says):
    with pytest.raises(ValueError, match=says):
        jdsmc.sensitivity(scene, wrt, **SMALL)


def test_run_of_a_gas_in_space_points_to_the_call():
    with pytest.raises(ValueError, match=r"jdsmc\.sensitivity"):
        jdsmc.run(FourierFlow(InelasticHardSpheres(1.0), 0.5), sensitivity=True)
