"""Bad input is one sentence that names what to change, before anything is run."""

import numpy as np
import pytest

from jdsmc import ElasticHardSpheres, Estimate, InelasticHardSpheres
from jdsmc.fit import calibrate
from jdsmc.scenarios import UniformShear

IHS, EHS = InelasticHardSpheres(0.7), ElasticHardSpheres(0.7)
MODEL = UniformShear(EHS, 4.0)
REFERENCE = UniformShear(IHS, 4.0)


@pytest.fixture(autouse=True)
def nothing_runs(monkeypatch):
    """A session that is begun fails the test."""
    monkeypatch.setattr("jdsmc.running.run.Session", lambda *_: pytest.fail("it ran"))


@pytest.mark.parametrize(
    "kind, words, reference, model, options",
    [
        (ValueError, "did you mean shear_stress", REFERENCE, MODEL, {"target": "shear_stres"}),
        (ValueError, "name reduced_shear_rate", REFERENCE, MODEL, {"target": "temperature"}),
        (
            *(ValueError, "loses none", REFERENCE, MODEL),
            {"target": "relative_speed_cubed_collisional"},
        ),
        (ValueError, "names nothing", REFERENCE, MODEL, {"target": "shear_stress,"}),
        (ValueError, "twice", REFERENCE, MODEL, {"target": ["a2", "a2"]}),
        (ValueError, "mixes", REFERENCE, MODEL, {"target": ["a2", "series/a2"]}),
        (
            *(ValueError, "is one number and cannot fix 2", REFERENCE, MODEL),
            {"target": "a2", "free": ("rate_factor", "drag_factor")},
        ),
        (ValueError, "free=", REFERENCE, MODEL, {"free": ()}),
        (ValueError, "did you mean drag_factor", REFERENCE, MODEL, {"free": "drag_facto"}),
        (ValueError, "take ElasticHardSpheres", REFERENCE, REFERENCE, {}),
        (TypeError, "model", REFERENCE, EHS, {}),
        (TypeError, "reference", 3.0, MODEL, {}),
        (
            *(ValueError, "same restitution", UniformShear(InelasticHardSpheres(0.8), 4.0)),
            *(MODEL, {}),
        ),
        (ValueError, "swept over shear_rate", UniformShear(IHS, [1.0, 2.0]), MODEL, {}),
        (
            *(ValueError, "only its restitution may be", REFERENCE),
            *(UniformShear(EHS, [1.0, 2.0]), {}),
        ),
        (ValueError, "restitution = 1", *[UniformShear(g, 4.0) for g in (
            InelasticHardSpheres(1.0), ElasticHardSpheres(1.0))], {}),
        (ValueError, "must be 1 positive", REFERENCE, MODEL, {"weights": [1.0, 2.0]}),
        (ValueError, "no target", REFERENCE, MODEL, {"weights": {"a2": 1.0}}),
        (ValueError, "has no 'shear_stress'", {"a2": Estimate(0.1, 0.01)}, MODEL, {}),
        (ValueError, "one value for each", {"shear_stress": np.ones(3)}, MODEL, {}),
        (ValueError, "needs duration", REFERENCE, MODEL, {"target": "series/shear_stress"}),
        (TypeError, "target", REFERENCE, MODEL, {"target": None}),
        (TypeError, "target", REFERENCE, MODEL, {"target": [3]}),
        (ValueError, "'a2' twice", REFERENCE, MODEL, {"target": "a2,a2"}),
        (TypeError, "free", REFERENCE, MODEL, {"free": 3}),
        (
            *(ValueError, "names a number twice", REFERENCE, MODEL),
            {"target": ["a2", "a3"], "free": ("rate_factor", "rate_factor")},
        ),
        (TypeError, "weights", REFERENCE, MODEL, {"weights": "a"}),
        (TypeError, "weights", REFERENCE, MODEL, {"weights": 2.0}),
        (TypeError, "sweep", REFERENCE, MODEL, {"sweep": 3}),
        (TypeError, "neither a number nor", {"shear_stress": "a"}, MODEL, {}),
        (ValueError, "has the error nan", {"shear_stress": Estimate(0.5, np.nan)}, MODEL, {}),
        (ValueError, "is 0, and misfits are relative", {"shear_stress": 0.0}, MODEL, {}),
        (
            *(ValueError, "has no steady shear_stress", {"shear_stress": np.nan}, MODEL),
            {"free": "restitution"},
        ),
    ],
)  # fmt: skip
def test_sentences(kind, words, reference, model, options):
    with pytest.raises(kind, match=words):
        calibrate(reference, model, **options, progress=False)
