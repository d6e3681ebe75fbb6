"""What a scene is: one physical situation, its steps on the device, its observables on the host."""

import re
from abc import abstractmethod
from typing import Any, ClassVar

import equinox as eqx
import numpy as np

from ..collisions.meet import Collisions
from ..fields import as_html, check_fields, plain_methods, text
from ..gases import AbstractGas, ElasticHardSpheres
from ..gases.base import check_gas
from ..measure.observable import Observable
from ..types import Scalar
from .approach import UNKNOWN, Approach
from .options import PARTICLES, STEPS_PER_RECORD, TIME_STEP, Options


class Record(eqx.Module):
    """What one record reports: sums over the particles, what its steps did, for how long (τ0).

    A scene may add fields. On the host every array has leading axes (realizations, records).
    """

    moments: Any
    tally: Collisions
    elapsed: Scalar


class AbstractScene(eqx.Module):
    """One physical situation. `jdsmc.run` advances, measures, tabulates and draws any of them.

    A scene of a homogeneous gas derives from `AbstractHomogeneous`, one of a gas in space from
    `AbstractSlab`: these give nearly everything. For instance, a gas heated by white noise:

        class Heated(jdsmc.scenarios.AbstractHomogeneous):
            \"""Kicks of variance ξ² dt make up for the energy lost.\"""

            gas: jdsmc.AbstractGas
            noise: Any = jdsmc.number("strength ξ² of the noise", "v0²/τ0", low=0.0)
            reports: ClassVar = jdsmc.scenarios.homogeneous_observables("a2", "temperature")
            monitored: ClassVar = ("temperature", "fourth")

            def step(self, key, velocity, majorant, duration, options):
                velocity, tally = self.collide(key, velocity, majorant, duration, options)
                width = jnp.sqrt(self.noise * duration)
                kicks = jdsmc.random.normals(key, velocity, jdsmc.random.Stream.OWN)
                return tuple(v + width * k for v, k in zip(velocity, kicks)), tally

    (`docs/own_scene.md` makes half of the kicks before the collisions: that is second order.)

    Methods of the first group are pure and traced. All others run on the host in float64 and see
    ONE gas at ONE point of a sweep: every number of the scene is a scalar.
    """

    gas: eqx.AbstractVar[AbstractGas]
    reports: eqx.AbstractClassVar[tuple[Observable, ...]]
    monitored: eqx.AbstractClassVar[tuple[str, ...]]

    default_rtol: ClassVar[float] = 1e-3
    """The precision that is asked if nothing else is said."""
    evolves: ClassVar[tuple[Observable, ...]] = ()
    """Reported against time only, beside `reports` (what changes for ever, say)."""
    sampled: ClassVar[tuple[Observable, ...]] = ()
    """Fields of what `finish_chunk` reports (velocity distributions), averaged once steady."""
    command: ClassVar[str] = ""
    """Name on the command line; made from the name of the class if empty."""
    dimensions: ClassVar[tuple[int, ...]] = (3,)
    """Numbers of velocity components that the scene can do."""
    applies_drag: ClassVar[bool] = False
    """True if the scene applies the drag of a frictional gas."""
    in_space: ClassVar[bool] = False
    """True if particles have places: they are then not exchangeable."""
    traced: ClassVar[bool] = True
    """False if `initial` and `advance` are plain Python on NumPy arrays (compiled otherwise)."""
    running: ClassVar[tuple[str, ...]] = ()
    """Fields of a record that are increments: `averages` is handed their totals since the start."""
    samples_per_record: ClassVar[int] = 1
    measured_at: ClassVar[float] = 0.0
    """Where in a record the samples lie on average: 0 at its start, 1 at its end."""
    counted: ClassVar[tuple[str, ...]] = ()
    """Averages that count what happens all along a record, as collisions do: at walls, say."""
    default_time_step: ClassVar[float] = TIME_STEP
    default_steps: ClassVar[int] = STEPS_PER_RECORD
    """Time steps between two records if nothing else is asked."""
    correlated: ClassVar[bool] = False
    """True if observables come from correlations in time: `window` then cuts blocks that are long
    against them, and shorter windows are not compared."""

    __getattribute__ = plain_methods

    def __check_init__(self):
        check_gas(self.gas)
        name = type(self).__name__
        if self.gas.dimension not in self.dimensions:
            wanted = " or ".join(str(d) for d in self.dimensions)
            raise TypeError(
                f"{name} needs a gas of {wanted} velocity components; "
                f"{type(self.gas).__name__} has {self.gas.dimension}."
            )
        if isinstance(self.gas, ElasticHardSpheres) and not self.applies_drag:
            raise TypeError(
                f"{name} does not apply the drag of ElasticHardSpheres; take a gas without drag, "
                "or apply it in `step` and state applies_drag = True."
            )
        if not self.reports or not all(isinstance(one, Observable) for one in self.reports):
            raise TypeError(f"{name}.reports must hold at least one jdsmc.Observable.")
        if not isinstance(self.monitored, tuple):
            raise TypeError(f"{name}.monitored = {self.monitored!r} is no tuple of names.")
        check_fields(self)

    def __repr__(self) -> str:
        return text(self)

    def _repr_html_(self) -> str:
        return as_html(self)

    # On the device: pure, traced, one gas.

    @abstractmethod
    def initial(self, key: Any, options: Options) -> Any:
        """The state at time zero. `key` is a `jdsmc.types.Key`; a seed sequence if not traced."""

    @abstractmethod
    def advance(self, key: Any, state: Any, options: Options) -> tuple[Any, Any]:
        """One record: what is measured at its start (see `measured_at`), and its steps."""

    def finish_chunk(self, state: Any) -> tuple[Any, Any]:
        """The state after a chunk of records, and a sample (a module of arrays) or None."""
        return state, None

    # On the host, asked before anything is compiled.

    def prepared(self) -> "AbstractScene":
        """The scene of one point with the numbers that follow from the others worked out."""
        return self

    def fit_options(self, options: Options) -> Options:
        """The options as the scene needs them; raises ValueError for what cannot be right."""
        return options

    def default_particles(self) -> int:
        """Particles of one realization if nothing else is asked."""
        return PARTICLES

    def ends(self) -> tuple[str, ...]:
        """Observables whose precision ends a run if none is named; they must not be zero."""
        return (self.reports[0].name,)

    def has_steady_state(self) -> bool:
        """True if averages become steady."""
        return True

    def no_steady_state(self) -> str:
        """What to change where there is no steady state."""
        return "give duration or collisions"

    def approach(self, options: Options) -> Approach:
        """How fast a steady state is approached, as far as it is known beforehand."""
        return UNKNOWN

    # On the host, one gas: records to averages to observables.

    @abstractmethod
    def averages(self, record: Any) -> dict[str, np.ndarray]:
        """What adds up: averages over the particles at each record, by name.

        `local_rate`, if there, is the number of collisions per particle and time in local
        equilibrium; `log_plain_time`, if there, is the logarithm of how long each record lasted
        where that is not `elapsed`, and the history then has `log_time`, ln(1 + t).
        """

    @abstractmethod
    def observables(self, means: dict[str, np.ndarray]) -> dict[str, Any]:
        """Every name of `reports` and `evolves` from averages of the above; ratios come last.

        Beside those, `means` has `accepted` and `energy_lost` (per particle and time), `time_step`
        and, for a time series, `collisions` and `local_collisions`. Leading axes of any shape.
        """

    def evolution(self, means: dict[str, np.ndarray]) -> dict[str, Any]:
        """What is reported against time; by default all observables."""
        return self.observables(means)

    def trouble(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """A sentence if a whole run so far cannot be trusted (arguments as of `window`)."""
        return ""

    def long_enough(self, series: dict[str, np.ndarray], weights: np.ndarray) -> bool:
        """True if error bars of such a measurement can be believed (arguments as of `window`)."""
        return True

    def remarks(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """A sentence that goes with the results, or none (arguments as of `window`)."""
        return ""

    def window(self, series: dict[str, np.ndarray], weights: np.ndarray) -> dict[str, np.ndarray]:
        """Averages of each realization over a window: arrays (realizations, ...).

        Arguments: averages of every record (realizations, records, ...), and how long each record
        lasted. A scene of correlations in time overrides this.
        """
        return weighted_means(series, weights)

    def sample_densities(self, sample: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Every name of `sampled` from the means of what `finish_chunk` sampled."""
        return sample

    def axes(self, options: Options) -> dict[str, Any]:
        """Coordinates along every dimension of the observables: values, or (values, attributes)."""
        return {}

    def faults(self, record: Any) -> str:
        """A sentence if these records cannot be trusted, and what to change."""
        return ""


def weighted_means(series: dict[str, np.ndarray], weights: np.ndarray) -> dict[str, np.ndarray]:
    """Means over records of arrays (realizations, records, ...), weighted along these axes."""
    total = np.sum(weights, axis=1)

    def mean(values):
        share = weights.reshape(weights.shape + (1,) * (values.ndim - 2))
        whole = total.reshape(total.shape + (1,) * (values.ndim - 2))
        return np.sum(share * values, axis=1) / whole

    return {name: mean(values) for name, values in series.items()}


def command_of(scene: type[AbstractScene]) -> str:
    """The name of a scene on the command line."""
    return scene.command or re.sub(r"(?<!^)(?=[A-Z])", "-", scene.__name__).lower()
