"""The reference has every public name, and says something of it."""

import inspect
import sys
from pathlib import Path

import pytest

import jdsmc
from jdsmc import fit, gases, results, scenarios

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The pages of the reference."""
    sys.path.insert(0, str(DOCS))
    import make_api  # noqa: PLC0415 - not of a package

    sys.path.remove(str(DOCS))
    path = tmp_path_factory.mktemp("made")
    make_api.write(path)
    return path


def test_every_public_name(folder):
    """Of each room that users import from; modules and constants aside."""
    text = "".join(page.read_text(encoding="utf-8") for page in folder.glob("api_*.md"))
    rooms = (jdsmc, fit, gases, results, scenarios)
    things = {name: getattr(room, name) for room in rooms for name in room.__all__}
    wanted = {n for n, one in things.items() if inspect.isclass(one) or inspect.isfunction(one)}
    assert len(wanted) >= 40
    missing = {name for name in wanted if f".{name}" not in text}
    assert not missing


def test_an_entry(folder):
    """Arguments, unit and range of a number; stars and angles stay what they are."""
    text = (folder / "api_scenes.md").read_text(encoding="utf-8")
    made = "UniformShear(gas, shear_rate, initial_state='equilibrium')"
    assert f"::::::{{py:class}} jdsmc.scenarios.{made}" in text
    assert "| `shear_rate` | shear rate a | 1/τ0 | [0, ∞) |" in text
    assert "- `field`: reduced strength ε\\* = λ ε in [0, 2]" in text
    assert "On the command line: `jdsmc run fourier`." in text
    running = (folder / "api_run.md").read_text(encoding="utf-8")
    assert "- `duration`: time to simulate (τ0)." in running and "duration: float | None" in running
