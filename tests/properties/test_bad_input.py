"""Whatever is passed to scenes, gases and runs is taken, or refused with a sentence.

In the full search annotations are not checked at run time, as for a user; in CI they are, and what
violates them comes no farther.
"""

import contextlib
import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from jaxtyping import TypeCheckError

import jdsmc
from jdsmc.cli import main
from jdsmc.cli.arguments import Arguments
from jdsmc.fields import given as fields
from jdsmc.scenarios import (
    SCENES,
    CouetteFlow,
    FourierFlow,
    HomogeneousCooling,
    ShearedSlab,
    UniformShear,
)

from .effort import cases, refused
from .numbers import ANYTHING, fields_of, within

GASES = (
    jdsmc.InelasticHardSpheres,
    jdsmc.InelasticHardDisks,
    jdsmc.ElasticHardSpheres,
    jdsmc.MaxwellMolecules,
)
OPTIONS = (
    *("n_particles", "n_realizations", "seed", "duration", "collisions", "observable", "rtol"),
    *("budget", "time_step", "splitting", "dtype", "steps_per_record", "sensitivity"),
)


pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")
"""NumPy's, of numbers like 1e308: what matters here is that they are taken or refused."""


class Begun(BaseException):
    """Everything was taken, and the simulation would begin."""


@pytest.fixture(autouse=True, scope="module")
def nothing_runs():
    """A session that is begun raises."""

    def begin(*_):
        raise Begun

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jdsmc.running.run.Session", begin)
        yield


def is_sentence(error: Exception) -> bool:
    """One sentence or two, on one line, that say more than a word."""
    text = str(error)
    return text.endswith(".") and "\n" not in text and len(text.split()) >= 4


@st.composite
def scenes(draw):
    """The class of a scene, and of a gas; arguments of both, one or none of which is anything."""
    make, gas = draw(st.sampled_from(SCENES)), draw(st.sampled_from(GASES))
    of_gas, of_scene = draw(fields_of(gas)), draw(fields_of(make))
    names = [("gas", field.name) for field in fields(gas)]
    names += [("scene", field.name) for field in fields(make) if field.name != "gas"]
    if names and draw(st.booleans()):
        owner, name = draw(st.sampled_from(names))
        (of_gas if owner == "gas" else of_scene)[name] = draw(ANYTHING)
    return make, gas, of_scene, of_gas


@cases(4000, 80)
@given(scenes())
def test_scenes(drawn):
    """Made, and then printed and begun; or refused."""
    make, gas, of_scene, of_gas = drawn
    try:
        scene = make(gas=gas(**of_gas), **of_scene)
        assert type(scene).__name__ in repr(scene)
        jdsmc.run(scene, duration=1.0, progress=False)
    except (TypeCheckError, Begun):
        pass
    except (ValueError, TypeError, jdsmc.NotSteadyError) as error:
        refused(error)
        assert is_sentence(error), f"{type(error).__name__}: {error}"


@pytest.mark.parametrize(
    "option",
    [
        *({"observable": 0.0}, {"observable": ()}, {"budget": None}, {"sensitivity": 0.0}),
        *({"splitting": np.zeros(2)}, {"dtype": np.zeros(2)}, {"dtype": (np.int8(0), 0.0)}),
    ],
    ids=str,
)
def test_options_that_were_not_refused_with_a_sentence(option):
    """Found by the full search, and mended."""
    scene = UniformShear(jdsmc.InelasticHardSpheres(0.7), 4.0)
    with pytest.raises((TypeError, ValueError)) as refused:
        jdsmc.run(scene, progress=False, **option)
    assert isinstance(refused.value, TypeCheckError) or is_sentence(refused.value)


@pytest.mark.parametrize("length", [[], 1e308, np.inf, -1e308, np.nan])
@pytest.mark.parametrize("make", [ShearedSlab, FourierFlow, CouetteFlow])
def test_sizes_that_follow_from_bad_numbers(make, length):
    """The number of layers that follows from a length hides no sentence about the length."""
    facts = {"cold_temperature": 0.5, "shear_rate": 1.0, "wall_velocity": 0.1}
    needed = {field.name for field in fields(make)} & set(facts)
    with pytest.raises(ValueError, match="length"):
        make(jdsmc.InelasticHardSpheres(1.0), length=length, **{n: facts[n] for n in needed})


SAFE = {
    "n_particles": st.integers(1, 10_000),
    "n_realizations": st.integers(0, 100),
    "seed": st.integers(0, 2**64),
    "time_step": within({"low": 0, "high": 2, "low_included": True, "high_included": True}),
    "rtol": st.floats(1e-6, 2.0),
    "budget": st.floats(0.0, 1e6),
}


@cases(2000, 100)
@given(st.sampled_from([True, False]), st.data())
def test_options_of_a_run(steady, data):
    """Begun, or refused."""
    spheres = jdsmc.InelasticHardSpheres(0.7)
    scene = UniformShear(spheres, 4.0) if steady else HomogeneousCooling(spheres)
    names = data.draw(st.sets(st.sampled_from(OPTIONS), max_size=3))
    options = {
        name: data.draw(st.one_of(ANYTHING, SAFE.get(name, ANYTHING)), label=name) for name in names
    }
    try:
        jdsmc.run(scene, progress=False, **options)
    except (TypeCheckError, Begun):
        pass
    except (ValueError, TypeError, jdsmc.NotSteadyError) as error:
        refused(error)
        assert is_sentence(error), f"{type(error).__name__}: {error}"


FLAGS = [option.flag for option in Arguments("jdsmc", UniformShear, []).of_run]
WORDS = st.one_of(
    st.sampled_from(
        ["0.5", "1:2:0.5", "1:2", "1:2:0", "nan", "inf", "1e400", "-1", "1,,2", ":", ""]
    ),
    st.sampled_from(["ihs", "ehs,ihs", "os:system", "a/b.py:C", "x" * 300, "\x00", "η", "--"]),
    st.text(max_size=6),
    st.floats().map(str),
)


@cases(1000, 60)
@given(
    st.sampled_from(["run", "sweep"]),
    st.lists(st.tuples(st.sampled_from([*FLAGS, "gas", "restitution", "shear-rate"]), WORDS)),
)
def test_command_line(command, options):
    """A status after one sentence, or begun; never a traceback."""
    words = [command, "shear", *(f"--{flag}={text}" for flag, text in options)]
    said = io.StringIO()
    with contextlib.suppress(Begun), contextlib.redirect_stderr(said):
        assert main(words) in (1, 2)  # 1 for a budget that is too small
        refused(ValueError(said.getvalue()))
        assert said.getvalue().startswith("jdsmc: ") and said.getvalue().count("\n") == 1
