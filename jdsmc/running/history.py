"""Records of a run on the host: times, collisions, averages over any window."""

import equinox as eqx
import numpy as np

from ..errors import FaultError
from ..scenarios.base import AbstractScene, weighted_means
from .batch import point_of
from .growing import Growing

TAIL = 64
"""Records from the end among which the last common sample is looked for first."""

FINAL = {"local_rate": "final_rate", "local_loss": "final_loss"}
"""Averages over the steps of a record; or, beside what holds at its end, those at its start."""

CLOCKS = ("elapsed", "accepted", "energy_lost", "time", "collisions")


class History:
    """Everything measured so far, arrays (points, realizations, records, ...).

    Arguments: the scene of each point; particles of a realization; time steps of a record.
    """

    def __init__(self, scenes: list[AbstractScene], n_particles: int, steps_per_record: int):
        self.scenes = scenes
        self.n_particles = n_particles
        self.steps_per_record = steps_per_record
        self.total_excess = 0.0
        self._columns, self._samples = Growing(), Growing()
        self._totals: dict[str, np.ndarray] = {}

    @property
    def length(self) -> int:
        """Records so far."""
        return self._columns.length

    def append(self, record, sample) -> None:
        """Add the records and the sample of one chunk."""
        tally = record.tally
        record = self._added_up(record)
        each = [scene.averages(point_of(record, p)) for p, scene in enumerate(self.scenes)]
        new = {name: np.stack([averages[name] for averages in each]) for name in each[0]}
        new |= {
            "elapsed": record.elapsed,
            "accepted": tally.accepted / self.n_particles,
            "energy_lost": tally.energy_lost / self.n_particles,
        }
        if "log_plain_time" in new:
            new["log_time"] = self._log_continued(new.pop("log_plain_time"))
            with np.errstate(over="ignore"):
                new["time"] = np.expm1(new["log_time"])
                self._totals["time"] = np.expm1(self._totals["log_time"])
        else:
            new["time"] = self._continued("time", new["elapsed"])
        new["collisions"] = self._continued("collisions", new["accepted"])
        self._columns.append(new)
        if sample is not None:
            fields = sample.__dataclass_fields__
            self._samples.append({name: getattr(sample, name)[:, :, None] for name in fields})
        self.total_excess += float(np.sum(tally.excess))

    def state(self) -> dict:
        """All of it as a pytree of arrays and numbers; `take` puts it back."""
        return {
            "columns": self._columns.state(),
            "totals": dict(self._totals),
            "samples": self._samples.state(),
            "total_excess": self.total_excess,
        }

    def take(self, state: dict) -> None:
        """Become the history that gave this `state`."""
        self.total_excess = float(state["total_excess"])
        self._columns.take(state["columns"])
        self._totals = dict(state["totals"])
        self._samples.take(state["samples"])

    def _added_up(self, record):
        """The records with totals since the start for the fields that are increments."""
        for name in self.scenes[0].running:
            more = vars(record)[name]
            total = self._continued(name, more) + more
            record = eqx.tree_at(lambda r, name=name: vars(r)[name], record, total)
        return record

    def _log_continued(self, log_time: np.ndarray) -> np.ndarray:
        """ln(1 + t) before each record, from the logarithms of how long records lasted."""
        start = self._totals.get("log_time", np.zeros(log_time.shape[:2]))
        total = np.logaddexp.accumulate(np.concatenate([start[..., None], log_time], 2), axis=2)
        self._totals["log_time"] = total[..., -1]
        return total[..., :-1]

    def _continued(self, name: str, increments: np.ndarray) -> np.ndarray:
        """Running total before each record; the total so far is kept from chunk to chunk."""
        start = self._totals.get(name, np.zeros(increments.shape[:2]))
        total = start[..., None] + np.cumsum(increments, axis=2)
        self._totals[name] = total[..., -1]
        return total - increments

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[name]

    @property
    def names(self) -> list[str]:
        """Names of the averages over particles."""
        return [name for name in self._columns if name not in CLOCKS]

    def point(
        self, point: int, first: int | np.integer, last: int | np.integer
    ) -> dict[str, np.ndarray]:
        """Averages over a window of records of one point: arrays (realizations, ...).

        Averages over particles are weighted with the time their record stands for; `accepted` and
        `energy_lost` become rates per particle and time.
        """
        return self.scenes[point].window(*self.window(point, first, last))

    def window(
        self, point: int, first: int | np.integer, last: int | np.integer
    ) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """Averages of each record of a window of one point, and how long the records lasted."""
        return self.records(point, first, last), self["elapsed"][point, :, slice(first, last)]

    def records(
        self, point: int, first: int | np.integer, last: int | np.integer
    ) -> dict[str, np.ndarray]:
        """Averages of each record of a window of one point: arrays (realizations, records, ...)."""
        window = slice(first, last)
        elapsed = self["elapsed"][point, :, window]
        series = {name: self[name][point, :, window] for name in self.names}
        for name in ("accepted", "energy_lost"):
            series[name] = self[name][point, :, window] / elapsed
        series["time_step"] = elapsed / self.steps_per_record
        return series

    def monitored(self, point: int, first, last, names: tuple[str, ...]) -> dict[str, np.ndarray]:
        """Time averages of some averages over a window: arrays (realizations, ...).

        FaultError for a scene that has no such averages.
        """
        missing = [name for name in names if name not in self._columns]
        if missing:
            scene = type(self.scenes[point]).__name__
            raise FaultError(f"{scene}.averages lacks {', '.join(missing)}, which it monitors.")
        elapsed = self["elapsed"][point, :, slice(first, last)]
        columns = {name: self[name][point, :, slice(first, last)] for name in names}
        return weighted_means(columns, elapsed)

    def samples(
        self, point: int, first: int | np.integer, records_per_chunk: int
    ) -> dict[str, np.ndarray]:
        """Chunk samples of one point taken after record `first`: means (realizations, bins)."""
        chunk = -(-first // records_per_chunk)
        if self._samples.length <= chunk:
            return {}
        return {n: np.mean(self._samples[n][point, :, chunk:], axis=1) for n in self._samples}

    def mean_collisions(self) -> np.ndarray:
        """Accepted collisions per particle so far, (points,)."""
        return np.mean(self._totals["collisions"], axis=1)

    def least_collisions(self) -> np.ndarray:
        """The same of the realization that is least far, (points,).

        A cold gas under a strong shear heats up before it collides: one realization may have made a
        hundred collisions per particle when another has made none.
        """
        return np.min(self._totals["collisions"], axis=1)

    @property
    def total_accepted(self) -> float:
        """Accepted collisions of all gases together."""
        return float(np.sum(self._totals["collisions"])) * self.n_particles if self.length else 0.0

    def reached(self, clock: str) -> np.ndarray:
        """The last sample of each point on the common clock of its realizations, (points,).

        Arguments: "time" (τ0) or "collisions" (per particle). Records tell of their starts, and as
        far as all realizations have come: a series that is to reach a time goes on until this has.
        """
        if not self.length:
            return np.zeros(len(self.scenes))
        time = self["log_time" if "log_time" in self._columns else "time"]
        for records in (TAIL, self.length):  # clocks are seldom far apart
            there = np.mean(time[..., -records:], axis=1) <= np.min(time[..., -1:], axis=1)
            if np.all(np.any(there, axis=1)):
                break
        last = np.maximum(np.sum(there, axis=1) - 1, 0)
        means = np.mean(self[clock][..., -records:], axis=1)
        return np.take_along_axis(means, last[:, None], axis=1)[:, 0]

    def record_at_collisions(self, point: int, collisions: float) -> int:
        """First record at which every realization has made that many collisions per particle."""
        return int(np.searchsorted(np.min(self["collisions"][point], axis=0), collisions))

    def on_common_times(self, point: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Averages of every realization of one point at the mean times of the samples.

        Realizations have their own clocks (their time step follows their own temperature); each is
        interpolated linearly in time to the mean clock, as far as all have come; in the logarithm
        of time, and to the mean of that, where a scene gives logarithms. What is counted over a
        record belongs to its middle.
        Returns: times (records,) and averages (realizations, records, ...).
        """
        scene, in_logs = self.scenes[point], "log_time" in self._columns
        clock = "log_time" if in_logs else "time"
        start = self[clock][point]
        end = np.concatenate([start[:, 1:], self._totals[clock][point][:, None]], axis=1)
        own, middle = start + scene.measured_at * (end - start), 0.5 * (start + end)
        common = np.mean(own, axis=0)
        common = common[common <= np.min(own[:, -1])]
        series = self.records(point, 0, self.length)
        edges = np.concatenate([start[:, :1], end], axis=1)
        collisions = self["collisions"][point], self._totals["collisions"][point][:, None]
        at = {"collisions": (edges, np.concatenate(collisions, axis=1))}
        if "instant_rate" in series:
            at["local_collisions"] = own, _integral(own, series["instant_rate"])
            for name, final in FINAL.items():
                if final in series:
                    series[name] = record_means(edges, series[name], series[final])
        elif "local_rate" in series:
            steps = np.cumsum(series["local_rate"] * self["elapsed"][point], axis=1)
            at["local_collisions"] = edges, np.concatenate([0.0 * steps[:, :1], steps], axis=1)
        counted = {"accepted", "energy_lost", "time_step", *FINAL, *scene.counted}
        for name, values in series.items():
            at[name] = through_ends(edges, middle, values) if name in counted else (own, values)
        with np.errstate(over="ignore"):
            plain = np.expm1(common) if in_logs else common
        return plain, {
            name: np.stack([_interpolate(common, *one) for one in zip(*both, strict=True)])
            for name, both in at.items()
        }


def through_ends(edges: np.ndarray, middle: np.ndarray, values: np.ndarray):
    """Times and values (realizations, records + 2, ...) of counts at the middle of each record, and
    on straight lines through the outermost two at both ends of the series."""
    if middle.shape[1] < 2:
        return middle, values

    def beyond(end, near, far):
        times = [edges[:, end], middle[:, near], middle[:, far]]
        at, one, two = (t.reshape(-1, *(1,) * (values.ndim - 2)) for t in times)
        return values[:, near] + (values[:, near] - values[:, far]) * (at - one) / (one - two)

    first, last = beyond(0, 0, 1)[:, None], beyond(-1, -1, -2)[:, None]
    times = np.concatenate([edges[:, :1], middle, edges[:, -1:]], axis=1)
    return times, np.concatenate([first, values, last], axis=1)


def record_means(edges: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Means over the records of what is known at their starts and ends (realizations, records).

    Of the parabola through both ends of a record and the start of the one before (the first: the
    end of the next): what follows a record does not change its mean.
    """
    length = np.diff(edges, axis=1)
    slope = (last - first) / length
    found = 0.5 * (first + last)
    if length.shape[1] < 2:
        return found
    bend = np.diff(slope, axis=1) / (edges[:, 2:] - edges[:, :-2])
    return found - np.concatenate([bend[:, :1], bend], axis=1) * length**2 / 6.0


def _integral(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Trapezoidal integral from the first record, along the last axis."""
    pieces = 0.5 * (values[..., 1:] + values[..., :-1]) * np.diff(time, axis=-1)
    return np.concatenate([np.zeros_like(values[..., :1]), np.cumsum(pieces, axis=-1)], axis=-1)


def _interpolate(at: np.ndarray, time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Linear interpolation along the first axis of the values."""
    if values.ndim == 1:
        return np.interp(at, time, values)
    flat = values.reshape(len(values), -1)
    columns = np.stack([np.interp(at, time, column) for column in flat.T], axis=-1)
    return columns.reshape(len(at), *values.shape[1:])
