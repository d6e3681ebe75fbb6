"""The map in small: points of every kind, and that a wrong point is called wrong."""

import numpy as np
import pytest

from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import UniformShear

from . import picture
from .__main__ import append, read
from .judge import REFUSED, RIGHT, WARNED, WRONG, Point, Truth, Verdict, judge
from .points import every_point

MAP = {(one.family, one.setting): one for one in every_point()}
SMALL = (
    (("restitution", "0.01"), RIGHT),
    (("shear rate", "0"), REFUSED),
    (("shear rate", "1e-10"), RIGHT),
    (("shear rate", "1e+06"), RIGHT),
    (("particles", "32"), REFUSED),
    (("type II walls", "T = 0.05, L = 0.1"), REFUSED),
    (("particles a layer", "1"), REFUSED),
    (("particles a layer", "2"), RIGHT),
    (("Maxwell molecules", "HeatFluxForce"), REFUSED),
    (("Maxwell molecules", "HomogeneousCooling"), RIGHT),
)


@pytest.mark.parametrize(("name", "verdict"), SMALL, ids=[" ".join(name) for name, _ in SMALL])
def test_points(name, verdict):
    found = judge(MAP[name])
    assert found.verdict == verdict, found


def test_every_point_has_a_name_of_its_own():
    """The table goes on by them."""
    assert len(MAP) == len(every_point()) > 70


def test_what_is_wrong_is_called_wrong():
    """A value that is off, one whose error tells nothing, NaN, and a silence where a sentence is
    due; a sentence is a refusal, a remark a warning.
    """
    assert Truth("x", 1.0, 0.01, 1.04, 0.0).is_right
    assert not Truth("x", 1.0, 0.01, 1.06, 0.0).is_right
    assert not Truth("x", 1.0, 0.5, 1.0, 0.0).is_right
    assert not Truth("x", np.nan, 0.01, 1.0, 0.1).is_right
    scene = UniformShear(InelasticHardSpheres(0.7), 4.0)
    sizes = {"n_particles": 64, "collisions": 1.0}
    for value, refuses, verdict in ((1.0, None, RIGHT), (1.2, None, WRONG), (1.0, True, WRONG)):
        truth = Truth("x", value, 0.01, 1.0, 0.01)
        point = Point("family", "one", lambda: scene, sizes, lambda _, t=truth: [t], refuses)
        assert judge(point).verdict == verdict
    refused = Point("family", "two", lambda: scene, {"n_particles": 3}, lambda _: [], False)
    assert judge(refused).verdict == WRONG
    assert judge(refused._replace(refuses=None)).verdict == REFUSED


def test_table_and_page(tmp_path):
    """Rows come back as they were; the page has every one, the picture is drawn."""
    row = Verdict("walls", "L = 2", WARNED, "q", -0.1, 0.01, -0.11, "Take more layers.", 1.5)
    nothing = row._replace(setting="L = 3", verdict=REFUSED, value=np.nan, expected=np.nan)
    for one in (row, nothing):
        append(tmp_path / "table.csv", one)
    rows = read(tmp_path / "table.csv")
    assert rows[0] == row and np.isnan(rows[1].value) and len(rows) == 2
    page = picture.page(rows)
    assert "| L = 2 | warned | q | -0.1 ± 0.01 | -0.11 | Take more layers. |" in page
    assert "1 warned, 1 refused, 0 WRONG" in page
    picture.draw(rows, tmp_path / "map.png")
    assert (tmp_path / "map.png").stat().st_size > 1000
