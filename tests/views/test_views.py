"""Tables and pictures of any scene: tiny runs, whose numbers mean nothing."""

import re
from typing import Any, ClassVar

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr
from matplotlib import pyplot
from matplotlib.backends.backend_agg import FigureCanvasAgg

import jdsmc
from jdsmc import InelasticHardSpheres, views
from jdsmc.results import join_gases
from jdsmc.scenarios import (
    AbstractHomogeneous,
    CouetteFlow,
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    ShearedSlab,
    UniformShear,
    homogeneous_observables,
)
from jdsmc.theory import bgk_shear_flow, homogeneous_cooling
from jdsmc.views import heat_flux_force, page, pictures, uniform_shear

TINY = {"n_particles": 256, "n_realizations": 8, "time_step": 0.2, "progress": False, "seed": 5}


class Rough(jdsmc.AbstractGas):
    """A user's gas, whose number has a name that no view knows."""

    alpha: Any = jdsmc.number("restitution", low=0.0, high=1.0)

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        share = (1.0 + self.alpha) / 4.0
        return tuple(share * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


class Heated(AbstractHomogeneous):
    """A user's scene."""

    gas: jdsmc.AbstractGas
    noise: Any = jdsmc.number("strength <ξ²> of the noise", "v0²/τ0", low=0.0)
    reports: ClassVar = homogeneous_observables("a2", "temperature")
    monitored: ClassVar = ("temperature", "fourth")

    def step(self, key, velocity, majorant, duration, options):
        velocity, tally = self.collide(key, velocity, majorant, duration, options)
        width = jnp.sqrt(self.noise * duration)
        kicks = jdsmc.random.normals(key, velocity, jdsmc.random.Stream.OWN)
        return tuple(v + width * k for v, k in zip(velocity, kicks, strict=True)), tally


@pytest.fixture(scope="module", autouse=True)
def in_haste():
    """Compile quickly what runs for a moment."""
    jax.config.update("jax_disable_most_optimizations", True)
    yield
    jax.config.update("jax_disable_most_optimizations", False)


@pytest.fixture(scope="module")
def sheared():
    """Swept over restitution and shear rate; its points are single results."""
    gas = InelasticHardSpheres(np.array([0.5, 0.7]))
    return jdsmc.run(UniformShear(gas, np.array([0.3, 0.6])), rtol=0.5, **TINY)


@pytest.fixture(scope="module")
def heated():
    """A user's scene with a user's gas, swept over two numbers."""
    scene = Heated(Rough(np.array([0.5, 0.6])), np.array([0.1, 0.2]))
    return jdsmc.run(scene, observable="temperature", rtol=0.5, **TINY)


def labels(figure) -> set[str]:
    """All that legends of a figure say."""
    legends = [*figure.legends, *(panel.get_legend() for panel in figure.axes)]
    return {text.get_text() for one in legends if one for text in one.get_texts()}


def check_picture(result):
    """Draw; nothing stays open, nothing is cut off, no legend lies on a panel."""
    before = pyplot.get_fignums()
    figure = result.plot()
    assert pyplot.get_fignums() == before
    figure.draw_without_rendering()
    renderer = FigureCanvasAgg(figure).get_renderer()
    whole, title = figure.bbox, figure._suptitle.get_window_extent(renderer)
    assert title.x0 >= whole.x0 and title.x1 <= whole.x1
    for panel in figure.axes:
        legend = panel.get_legend()
        if legend:
            extent = legend.get_window_extent(renderer)
            # half a pixel for the rounding of the layout
            assert extent.y0 >= panel.get_window_extent(renderer).y1 - 0.5
    return figure


def test_single_gas(sheared):
    """One row an observable, its value, unit and theory; NaN rows are hidden."""
    one = sheared.at(restitution=0.7, shear_rate=0.6)
    lines = one.table().splitlines()
    row = next(line for line in lines if line.startswith("shear stress"))
    known = float(bgk_shear_flow.steady_state(0.7).shear_stress)
    assert str(one["shear_stress"]) in row and row.endswith(f"{known:.4g}")
    assert "BGK model" in lines[0] and "nan" not in one.table()
    assert sum("C > 3" in line for line in lines) == 1
    assert lines[-2].startswith("steady from t = ") and lines[-1].startswith("Ended because ")
    figure = check_picture(one)
    assert {"BGK model", "Maxwellian", "-Pxy/nT"} <= labels(figure)


def test_sweep(sheared):
    """One row a point; the model's lines are there, whatever is swept."""
    lines = sheared.table().splitlines()
    assert len(lines) == 1 + 4 + 1 and lines[0].split()[:2] == ["restitution", "shear_rate"]
    assert "η* BGK" in lines[0] and "0.7481" in lines[-2]  # η* of the model at α = 0.7
    for part in (sheared, sheared.at(shear_rate=0.3), sheared.at(restitution=0.5)):
        figure = check_picture(part)
        assert {"BGK model", "Maxwellian"} <= labels(figure)
        assert "$C_{x}$" in {panel.get_xlabel() for panel in figure.axes}


def test_joined_gases(sheared):
    """Gases side by side, each in its own row and with its own markers."""
    joined = join_gases({"first": sheared, "second": sheared})
    lines = joined.table().splitlines()
    assert len(lines) == 1 + 8 + 1 and lines[0].split()[0] == "gas"
    assert any("first" in text for text in labels(check_picture(joined)))
    single = sheared.at(restitution=0.5, shear_rate=0.3)
    both = join_gases({"first": single, "second": single})
    assert len(both.table().splitlines()) == 4
    assert {"first", "second"} <= labels(check_picture(both))


def test_scene_of_a_user(heated):
    """The generic view needs no word about a scene."""
    lines = heated.table().splitlines()
    assert lines[0].split()[:3] == ["alpha", "noise", "(v0²/τ0)"] and "T/T0" in lines[0]
    assert len(lines) == 1 + 4 + 2 and lines[-2].startswith("More in result.steady: ")
    assert "alpha" in {p.get_xlabel() for p in check_picture(heated).axes}
    one = heated.at(alpha=0.5, noise=0.1)
    assert "fourth cumulant a2" in one.table() and "BGK" not in one.table()
    figure = check_picture(one)
    assert "Maxwellian" in labels(figure) and "Heated: Rough" in figure._suptitle.get_text()


def test_html(sheared, heated):
    """A row for every line, all text escaped."""
    for result in (sheared, sheared.at(restitution=0.5, shear_rate=0.3), heated):
        text = result._repr_html_()
        assert text.count("<tr>") == text.count("</tr>") >= 5
    one = page.Page([page.Block(["<b>", "1"], [["a & b", "<2>"]])], ["x > y"])
    assert "&lt;b&gt;" in page.as_html(one) and "a &amp; b" in page.as_html(one)
    assert not re.search(r"<(b|2)>", page.as_html(one)) and "x &gt; y" in page.as_html(one)


def test_html_of_scenes():
    """Name, value, unit and meaning of every number; nothing is markup that should be text."""
    text = Heated(Rough(0.5), np.array([0.1, 0.2]))._repr_html_()
    assert "<b>Heated</b>" in text and text.count("<tr>") == 2
    for words in ("Rough(alpha=0.5)", "[0.1, 0.2]", "v0²/τ0", "strength &lt;ξ²&gt; of the noise"):
        assert f">{words}</td>" in text
    assert ">restitution</td>" in jdsmc.InelasticHardSpheres(0.7)._repr_html_()


def test_notebook_shows_a_figure_once(sheared, tmp_path):
    """A figure draws itself, and pyplot, which would draw it again, does not know it."""
    path = tmp_path / "picture.png"
    figure = sheared.at(restitution=0.5, shear_rate=0.3).plot(path)
    assert path.read_bytes().startswith(b"\x89PNG")
    assert figure._repr_png_().startswith(b"\x89PNG")
    assert not pyplot.get_fignums()


@pytest.mark.parametrize("gas", [Rough(0.5), jdsmc.MaxwellMolecules()])
def test_no_wrong_theory(gas):
    """A gas that the model does not stand for is shown without it; also before it is steady."""
    result = jdsmc.run(UniformShear(gas, 0.3), duration=2.0, **TINY)
    assert not result.is_steady and result.table().startswith("No steady values (")
    assert "BGK model" not in labels(check_picture(result))
    assert not uniform_shear.has_theory(result.attrs)
    assert not uniform_shear.model_at(result, result.series)


def test_theory_of_frictional_gas():
    """The model is that of the elastic gas with β = (1+α)/2 alone."""
    attrs = {"gas_model": "ElasticHardSpheres", "option_rate_factor": "linear"}
    assert uniform_shear.has_theory(attrs)
    assert not uniform_shear.has_theory(attrs | {"option_rate_factor": "viscosity"})
    assert not uniform_shear.has_theory(attrs | {"parameter_drag_factor": 1.1})
    assert not uniform_shear.has_theory({"gas_model": "ElasticHardSpheres"})
    assert not uniform_shear.has_theory(attrs | {"gas_model_a": "A", "gas_model_b": "B"})


def test_cooling():
    """Theory of spheres beside a2, Haff's law beside T."""
    scene = HomogeneousCooling(InelasticHardSpheres(np.array([0.5, 0.8])))
    sweep = jdsmc.run(scene, rtol=0.5, **TINY)
    known = f"{float(homogeneous_cooling.kurtosis(0.5)):.4g}"
    assert "a2 (theory)" in sweep.table() and known in sweep.table()
    assert {"Haff's law", "a2", "a3"} <= labels(check_picture(sweep))
    one = sweep.at(restitution=0.5)
    assert known in one.table() and "first Sonine" in one.table()
    assert "Haff's law" in labels(check_picture(one))


def test_heat_flux():
    """Both Sonine approximations; at α = 1 also what they converge to."""
    gas = InelasticHardSpheres(np.array([0.7, 1.0]))
    sweep = jdsmc.run(HeatFluxForce(gas, 0.1), rtol=0.5, **TINY)
    assert {"first", "modified", "b'3"} <= set(sweep.table().split())
    figure = check_picture(sweep)
    assert {"first Sonine", "converged: 1.025218"} <= labels(figure)
    table = sweep.at(restitution=1.0).table()
    assert "b'1, eq. (3.10)" in table and "1.025" in table  # κ'/κ0, converged
    assert "b'3" in labels(check_picture(sweep.at(restitution=1.0)))


def test_smoothing():
    """Averages over windows; what does not fill one is left out."""
    assert np.array_equal(heat_flux_force.smoothed(np.arange(7.0), 3), [1.0, 4.0])


def test_fourier():
    """Profiles in a table of their own; walls are marked, gravity gets an axis."""
    scene = FourierFlow(InelasticHardSpheres(1.0), 0.5, np.array([0.0, 0.02]), 2.0, layers=10)
    sweep = jdsmc.run(scene, rtol=0.9, **TINY)
    assert "κ* halfway" in sweep.table() and "gravity (v0²/λ0)" in sweep.table()
    figure = check_picture(sweep)
    assert "walls" in labels(figure) and "g (v0²/λ0)" in {p.get_xlabel() for p in figure.axes}
    table = sweep.at(gravity=0.0).table()
    assert "profile along z" in table and "n̄ m v0³" in table
    figure = check_picture(sweep.at(gravity=0.0))
    assert {"at the hot wall", "$P_{zz}$"} <= labels(figure)


def test_flow_between_walls():
    """Walls are marked; stresses against time, or what flows against what was swept."""
    scene = CouetteFlow(InelasticHardSpheres(1.0), [0.5, 1.0], length=2.0, layers=10)
    sweep = jdsmc.run(scene, rtol=0.9, **TINY)
    figure = check_picture(sweep)
    assert "walls" in labels(figure) and "U (v0)" in {p.get_xlabel() for p in figure.axes}
    one = sweep.at(wall_velocity=0.5)
    assert {"at the lower wall", "mean over the slab"} <= labels(check_picture(one))
    # elastic collisions lose nothing, whatever their roundings add up to
    assert str(one["dissipation"]) == "0"


def test_slab():
    """Profiles at several times, beside those of uniform shear."""
    scene = ShearedSlab(InelasticHardSpheres(0.7), 0.5, layers=10)
    result = jdsmc.run(scene, collisions=1.0, **TINY)
    assert "uniform shear" in labels(check_picture(result))
    assert result.table().startswith("No steady values")


def test_navier_stokes():
    """Running integrals and their theory, α in the title."""
    result = jdsmc.transport.navier_stokes(
        InelasticHardSpheres(np.array([0.7, 1.0])),
        **TINY,
        n_kicks=1,
        duration=2.0,
    )
    assert "κ/κ0 Sonine" in result.table()
    assert {"first Sonine", "converged"} <= labels(check_picture(result))
    one = result.at(restitution=1.0)
    assert "converged" in one.table() and "lag" not in one.table()
    assert "α = 1" in check_picture(one)._suptitle.get_text()


def test_text_of_a_page():
    """Numbers to the right, words to the left, a combining mark takes no place."""
    block = page.Block(["n̄", "x"], [["ab", "1"], ["c", "10"]], (0,))
    assert page.as_text(page.Page([block], ["End."])).splitlines() == [
        "n̄    x",
        "ab   1",
        "c   10",
        "End.",
    ]


def test_subscripts():
    """One or two letters, or a sign; dollars are text."""
    assert pictures.pretty("P_zz in $") == r"$P_{zz}$ in \$"
    assert pictures.pretty("T_wall") == "T_wall" and pictures.pretty("b'_k") == "$b'_{k}$"


def test_only_what_is_there():
    """A scene of the same name without what a view needs is shown by the generic one."""
    assert views._view(_Named("UniformShear")) is views.generic


class _Named:
    def __init__(self, scene):
        self.attrs, self.series, self.steady = {"scene": scene}, xr.Dataset(), xr.Dataset()
