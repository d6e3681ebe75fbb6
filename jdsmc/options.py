"""The numerical options of a run: everything static, nothing physical but the time step."""

from dataclasses import dataclass

import jax
import jax.numpy as jnp

from . import check
from .pairs import PairPlan, plan_pairs

TIME_STEP = 0.05
"""Default fraction of τ(T): steady values at the strongest shear of the papers are within 0.3% of
the limit of short steps (experiments/uniform_shear_flow, convergence); 0.1 puts a2 0.5% off."""

STEPS_PER_RECORD = 16
"""Default: a record each 0.8 τ(T), nearly one collision per particle."""


@dataclass(frozen=True)
class Options:
    """Sizes and switches that select a compiled program.

    `time_step`: largest step as a fraction of τ(T) and of 1/a; `steps`: steps per record;
    `records`: records per chunk (what is done between two looks at the clock).
    """

    plan: PairPlan
    time_step: float
    splitting: str
    steps: int
    records: int
    dtype: jnp.dtype

    @property
    def n_particles(self) -> int:
        """Particles of one gas."""
        return self.plan.rows * self.plan.lanes

    @property
    def in_space(self) -> bool:
        """True if particles have places: they are one row, not exchangeable ones in many."""
        return self.plan.rows == 1

    @staticmethod
    def checked(
        n_particles: int,
        time_step: float,
        splitting: str,
        dtype: str,
        steps: int,
        records: int,
        in_space: bool = False,
    ) -> "Options":
        """Check the options of `run` and lay out the particles; raises ValueError or TypeError.

        A gas in space is one row: its pairs are found by place, not by row.
        """
        check.at_least("n_particles", n_particles, 64)
        check.scalar("time_step", time_step, 0.0, 1.0)
        check.one_of("splitting", splitting, ("strang", "lie"))
        check.one_of("dtype", str(dtype), ("float32", "float64"))
        if str(dtype) == "float64" and not jax.config.read("jax_enable_x64"):
            raise ValueError(
                'dtype = "float64" needs jax.config.update("jax_enable_x64", True) before the run.'
            )
        one_row = PairPlan(rows=1, lanes=int(n_particles), first=0, second=0)
        plan = one_row if in_space else plan_pairs(n_particles, float(time_step))
        return Options(plan, float(time_step), splitting, steps, records, jnp.dtype(dtype))
