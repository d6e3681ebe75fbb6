"""The same cooling gas of disks as `CoolingDisks`, by event-driven molecular dynamics."""

from typing import Any, ClassVar

import numpy as np

from .. import events
from ..collisions.meet import Collisions
from ..gases import InelasticHardDisks
from .disk_modes import (
    AbstractCoolingDisks,
    DiskMoments,
    DiskRecord,
    density_field,
    growth_rate_field,
)
from .options import Options


class HostMoments(DiskMoments):
    """One instant, in NumPy's float64."""

    modes: Any
    temperature: Any
    fourth: Any


class HostCollisions(Collisions):
    """What happened in a record, in NumPy's float64."""

    accepted: Any
    energy_lost: Any
    excess: Any
    overflow: Any
    fastest: Any
    watched: Any = None


class HostRecord(DiskRecord):
    """One sample and what came after it, in NumPy's float64."""

    elapsed: Any
    counts: Any


class MolecularDynamics(AbstractCoolingDisks):
    """Inelastic hard disks of finite size in a periodic square, in the stationary representation.

    Arguments:
        gas: `InelasticHardDisks`, restitution in [0.4, 1].
        density: n σ² in (0, 0.5], the packing fraction being π/4 of it.
        growth_rate: μ in 1/τ0; by default that of the dilute gas (`CoolingDisks`). Disks of finite
            size collide more often, so that T~ is then a little below T0.
    Needs numba: `pip install "jdsmc[md]"`. `n_particles` of a run counts disks; `time_step` and
    `steps_per_record` only set the time between two samples, their product.
    """

    command: ClassVar[str] = "molecular-dynamics"
    traced: ClassVar[bool] = False
    default_time_step: ClassVar[float] = 0.07
    default_steps: ClassVar[int] = 10
    measured_at: ClassVar[float] = 1.0

    gas: InelasticHardDisks
    density: Any = density_field()
    growth_rate: Any = growth_rate_field()

    def fit_options(self, options: Options) -> Options:
        """Raise ValueError for an unstable system."""
        self.check_stability(options.n_particles)
        return options

    def initial(self, key: np.random.SeedSequence, options: Options) -> events.System:
        """Disks without overlap, Gaussian velocities with mean zero and the exact temperature."""
        seed = int(key.generate_state(1, np.uint64)[0] >> 1)
        return events.start(options.n_particles, float(self.density), seed)

    def advance(
        self, key: np.random.SeedSequence, state: events.System, options: Options
    ) -> tuple[events.System, DiskRecord]:
        """One record: the gas moves on to the next sample."""
        spacing = options.steps * options.time_step
        before = events.faults(state)
        state, samples = events.advance_scaled(
            state, float(self.gas.restitution), float(self.growth_rate), spacing, 1
        )
        now = events.faults(state)
        modes = samples.modes[0]
        moments = HostMoments(
            np.stack([modes.real, modes.imag], axis=-1),
            samples.temperature[0],
            samples.fourth_moment[0],
        )
        met = {name: float(now[name] - before[name]) for name in now}
        none = np.zeros(())
        tally = HostCollisions(
            samples.collisions[0], samples.energy_lost[0], none, none, none, watched=met
        )
        sizes = np.array([options.n_particles] * 2, float)
        return state, HostRecord(moments, tally, np.asarray(spacing), sizes)

    def faults(self, record: DiskRecord) -> str:
        """What the events met that should not be."""
        counted = {name: float(np.sum(n)) for name, n in record.tally.watched.items()}
        met = [f"{n:.0f} {name}" for name, n in counted.items() if n > 0]
        if not met:
            return ""
        return (
            f"Molecular dynamics met {', '.join(met)}: disks too near to each other, or collisions "
            "without end (inelastic collapse). Take a higher restitution, or a lower density."
        )
