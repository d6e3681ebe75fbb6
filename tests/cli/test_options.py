"""Options are made from the fields of scenes and gases, and all reach the run."""

import jax
import numpy as np
import pytest

from jdsmc import scenarios
from jdsmc.cli.arguments import Arguments
from jdsmc.cli.catalogue import scenes
from jdsmc.scenarios.navier_stokes import duration_for, kick_for


def test_every_option_reaches_the_run(asked, status):
    """No flag is forgotten on its way to `jdsmc.run`."""
    flags = {
        "particles": ("n_particles", "1e3", 1000),
        "realizations": ("n_realizations", "16", 16),
        "seed": ("seed", "18446744073709551615", 2**64 - 1),
        "duration": ("duration", "7.5", 7.5),
        "observable": ("observable", "a2,temperature", ("a2", "temperature")),
        "rtol": ("rtol", "0.5", 0.5),
        "budget": ("budget", "77", 77.0),
        "time-step": ("time_step", "0.2", 0.2),
        "splitting": ("splitting", "lie", "lie"),
        "dtype": ("dtype", "float32", "float32"),
        "steps-per-record": ("steps_per_record", "16", 16),
        "checkpoint": ("checkpoint", "run.h5", "run.h5"),
        "every": ("every", "60", 60.0),
    }
    words = [word for flag, (_, text, _) in flags.items() for word in (f"--{flag}", text)]
    gas = "--gas ehs-measured --rate-factor 0.8 --restitution 0.6"
    assert status(f"run shear {gas} --shear-rate 2.5 --no-progress", *words) == 0
    ((scene, options),) = asked
    wanted = {name: value for name, _, value in flags.values()}
    assert options == wanted | {"collisions": None, "progress": False}
    numbers = (scene.gas.restitution, scene.gas.rate_factor, scene.shear_rate)
    assert numbers == (0.6, 0.8, 2.5) and scene.gas.drag == "measured"
    assert status("run shear --collisions 8.5") == 0 and asked[1][1]["collisions"] == 8.5


@pytest.mark.parametrize(
    "line, kind, gas, numbers",
    [
        ("shear", "UniformShear", "InelasticHardSpheres", {"shear_rate": 4.0}),
        ("cooling", "HomogeneousCooling", "InelasticHardSpheres", {}),
        ("heat-flux", "HeatFluxForce", "InelasticHardSpheres", {"field": 0.025}),
        (
            *("fourier", "FourierFlow", "InelasticHardSpheres"),
            {"cold_temperature": 0.05, "gravity": 0.0, "length": 10.0, "layers": 100},
        ),
        (
            *("sheared-slab", "ShearedSlab", "InelasticHardSpheres"),
            {"shear_rate": 4.0, "length": 2.5, "layers": 50},
        ),
    ],
)
def test_what_is_taken_if_nothing_is_said(line, kind, gas, numbers, asked, status):
    """The defaults of a scene on the command line, and those of `jdsmc.run`."""
    assert status(f"run {line}") == 0
    ((scene, options),) = asked
    assert (type(scene).__name__, type(scene.gas).__name__) == (kind, gas)
    assert scene.gas.restitution == (1.0 if line == "fourier" else 0.9)
    assert {name: getattr(scene, name) for name in numbers} == numbers
    assert (options["n_particles"], options["rtol"], options["progress"]) == (None, None, True)


def test_the_kick_follows_the_precision(asked, status):
    """The bias of a kick is at most half of what is asked."""
    for line, rtol in (("", 5e-3), ("--rtol 0.001", 1e-3)):
        status(f"run navier-stokes {line}")
        scene = asked[-1][0]
        assert (scene.kick, scene.duration) == (kick_for(rtol), duration_for(rtol))
    status("run navier-stokes --rtol 0.001 --kick 0.3 --duration 9")
    scene, options = asked[-1]
    assert (scene.kick, scene.duration) == (0.3, 9.0) and "duration" not in options


@pytest.mark.parametrize("text", ["--gravity -0.016,0,0.008", "--gravity=-0.016,0,0.008"])
def test_negative_numbers(text, asked, status):
    assert status(f"sweep fourier {text}") == 0
    np.testing.assert_array_equal(asked[0][0].gravity, [-0.016, 0.0, 0.008])


def test_disks(asked, status):
    assert status("run cooling --gas disks --restitution 0.8") == 0
    assert (asked[0][0].gas.dimension, asked[0][0].gas.restitution) == (2, 0.8)


def test_float64(asked, status):
    """The command switches JAX to 64 bits, which a user of the shell cannot."""
    before = jax.config.read("jax_enable_x64")
    try:
        assert status("run shear --dtype float64") == 0
        assert jax.config.read("jax_enable_x64") and asked[0][1]["dtype"] == "float64"
    finally:
        jax.config.update("jax_enable_x64", before)


@pytest.mark.parametrize("words", ["", "--help", "run", "run --help", "sweep", "sweep -h"])
def test_lists(words, status, capsys):
    """What there is, where too little was said."""
    assert status(words) == 0
    out = capsys.readouterr().out
    assert all(name in out for name in (*scenes(), "ihs", "disks", "module:Class"))


@pytest.mark.parametrize("scene", list(scenes()))
def test_help_explains_every_field(scene, status, capsys):
    """Meaning, unit, range and default of each number; `jdsmc.run`'s options too."""
    assert status(f"run {scene} --help") == 0
    text = " ".join(capsys.readouterr().out.split())
    arguments = Arguments(f"jdsmc run {scene}", scenes()[scene], [])
    options = [*arguments.of_scene, *arguments.of_run]
    options += [option for of in arguments.of_gases.values() for option in of]
    for option in options:
        assert f"--{option.flag} " in text
        assert option.meaning.split()[0] in text
    assert "coefficient of normal restitution α; in (0, 1] (default: 0.9)" in text or (
        scene == "fourier"
    )
    if scene == "sheared-slab":
        assert "distance L of the planes in λ0; in (0, 1000] (default: 2.5)" in text


def test_gases_that_a_scene_takes_are_offered():
    """Those with which it can be made; others are not offered, and refused with its sentence."""
    offered = {name: set(Arguments("", kind, []).known) for name, kind in scenes().items()}
    assert offered["fourier"] == {"hard-spheres", "maxwell-molecules"}
    assert "disks" in offered["cooling"] and "ehs" not in offered["cooling"]
    assert {"ihs", "ehs", "ehs-measured"} <= offered["shear"]
    assert "ehs-measured" not in offered["sheared-slab"]
    assert len(offered) == len(scenarios.SCENES)
