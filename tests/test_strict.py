"""Every scene under JAX's strict modes, in processes of their own: they are global switches."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import sys, traceback
import equinox as eqx, jax, jax.numpy as jnp, numpy as np
import jdsmc
from jdsmc import random, scenarios, sweep
from jdsmc.gases import *
from jdsmc.running.run import options_of
from tests.helpers import Viscoelastic

x64, run = (word == "yes" for word in sys.argv[1:])
jax.config.update("jax_enable_x64", x64)
jax.config.update("jax_numpy_dtype_promotion", "strict")
jax.config.update("jax_numpy_rank_promotion", "raise")
jax.config.update("jax_debug_nans", True)

IHS, EHS = InelasticHardSpheres(0.7), ElasticHardSpheres(0.7)
SCENES = [
    *(scenarios.UniformShear(gas, 4.0) for gas in (IHS, EHS, ElasticHardSpheres(0.7, 0.8,
      "measured"), MaxwellMolecules(), Viscoelastic(0.4))),
    *(scenarios.HomogeneousCooling(gas) for gas in (IHS, InelasticHardDisks(0.7),
      MaxwellMolecules(), Viscoelastic(0.4))),
    *(scenarios.HeatFluxForce(IHS, 0.1, scheme) for scheme in ("exact", "paper")),
    *(scenarios.FourierFlow(gas, 0.5, 0.01, 5.0, wall, 5) for wall in ("maxwell", "bgk")
      for gas in (InelasticHardSpheres(1.0), MaxwellMolecules())),
    *(scenarios.ShearedSlab(gas, 1.0, 2.5, state, 5) for gas, state in (
      (IHS, "equilibrium"), (EHS, "nonequilibrium"), (IHS, "local_equilibrium"))),
    scenarios.CouetteFlow(IHS, 0.5, 0.8, 0.6, length=5.0, layers=5),
    scenarios.WhiteNoiseThermostat(IHS, 0.2),
    scenarios.NavierStokes(IHS, 0.2, 1.0),
]

def traced(scene, dtype):
    "Shapes and types of a chunk: whatever is floating has the dtype that was asked."
    options = options_of([scene], 256, 0.1, "strang", dtype, 4)
    cast = jax.tree.map(lambda x: jnp.asarray(x, dtype) if sweep.is_number(x) else x, scene)
    key = random.key_from_seed(1)
    state = eqx.filter_eval_shape(lambda s, k: s.initial(k, options), cast, key)
    after = eqx.filter_eval_shape(lambda s, k, x: s.advance(k, x, options), cast, key, state)
    sample = eqx.filter_eval_shape(lambda s, x: s.finish_chunk(x), cast, state)
    kinds = {x.dtype for x in jax.tree.leaves((state, after, sample)) if x.dtype.kind == "f"}
    assert kinds == {np.dtype(dtype)}, kinds
    before, ahead = (jax.tree.map(lambda x: (x.shape, x.dtype), x) for x in (state, after[0]))
    assert before == ahead, "a step changes the types of the state"

def simulated(scene, dtype):
    jdsmc.run(scene, n_particles=256, time_step=0.1, duration=0.1, steps_per_record=2,
              dtype=dtype, progress=False)

for dtype in ("float32", "float64")[: 1 + x64]:
    for scene in SCENES:
        try:
            (simulated if run else traced)(scene, dtype)
        except Exception as error:
            traceback.print_exc()
            print("FAILED", dtype, scene, type(error).__name__, str(error)[:300])
print("tried", len(SCENES))
"""


def outcome(x64: bool, run: bool) -> str:
    """What a process prints: the scenes that failed, and how many were tried."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, *("yes" if word else "no" for word in (x64, run))],
        env=os.environ | {"XLA_FLAGS": "--xla_backend_optimization_level=0"},  # compile in haste
        cwd=Path(__file__).parents[1],
        capture_output=True,
        text=True,
        check=False,
    )
    assert "tried 21" in done.stdout, done.stderr
    assert "FAILED" not in done.stdout, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("x64", [False, True])
def test_types_are_strict(x64):
    """No array changes its type or rank unasked: float32 and, in x64 mode, float64 too.

    Strict dtype promotion, rank promotion an error; everything is traced, nothing compiled.
    """
    outcome(x64, run=False)


@pytest.mark.slow
@pytest.mark.parametrize("x64", [False, True])
def test_runs_make_no_nan(x64):
    """All of it compiled and run with jax_debug_nans beside these."""
    outcome(x64, run=True)
