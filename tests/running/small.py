"""Small runs that share one compiled program: eight gases of 512 particles, two groups of four."""

import xarray as xr

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import UniformShear


def scene(restitution=0.7, shear_rate=4.0):
    """A sheared gas."""
    return UniformShear(InelasticHardSpheres(restitution), shear_rate)


def simulate(what=None, **options):
    """Run a scene, this one if none is given."""
    what = scene() if what is None else what
    steps = {"time_step": 0.1, "steps_per_record": 8}
    options = {"n_particles": 512, "n_realizations": 8, "progress": False} | steps | options
    return jdsmc.run(what, **options)


def assert_same(one, other):
    """Steady values and series agree to the last bit."""
    a, b = (run.to_xarray().to_dataset().drop_attrs() for run in (one, other))
    xr.testing.assert_identical(a, b)
    xr.testing.assert_identical(one.series, other.series)
