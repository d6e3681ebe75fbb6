"""The page of observables is what the scenes say."""

import runpy
from pathlib import Path

import pytest

from jdsmc.scenarios import SCENES

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def script():
    return runpy.run_path(str(DOCS / "make_observables.py"))


def test_the_committed_page_is_up_to_date(script):
    """Written anew by `python docs/make_observables.py`."""
    assert (DOCS / "observables.md").read_text(encoding="utf-8") == script["page"]()


def test_every_name_of_every_scene_is_there(script):
    sections = script["page"]().split("\n## ")
    for scene in SCENES:
        (own,) = (text for text in sections if text.startswith(f"{scene.__name__} "))
        for one in (*scene.reports, *scene.evolves, *scene.sampled):
            assert f"| `{one.name}` | {one.meaning}" in own.replace("\\|", "|")
    assert script["NOTES"].keys() <= {scene.__name__ for scene in SCENES}
