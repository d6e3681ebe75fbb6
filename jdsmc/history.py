"""Records of a run on the host: times, collisions, averages over any window."""

import numpy as np

from .observables import particle_means


class History:
    """Everything measured so far, arrays (points, realizations, records, ...)."""

    def __init__(self, n_particles: int, steps_per_record: int, averages=particle_means):
        self.n_particles = n_particles
        self.steps_per_record = steps_per_record
        self.total_excess = 0.0
        self.length = 0  # records so far
        self._averages = averages
        self._samples: list = []
        self._columns: dict[str, np.ndarray] = {}
        self._totals: dict[str, np.ndarray] = {}

    def append(self, record, sample) -> None:
        """Add the records and the sample of one chunk."""
        tally = record.tally
        new = {
            **self._averages(record),
            "elapsed": record.elapsed,
            "accepted": tally.accepted / self.n_particles,
            "energy_lost": tally.energy_lost / self.n_particles,
        }
        plain = new["elapsed"] / new.get("scale", 1.0)
        new["time"] = self._continued("time", plain)
        new["collisions"] = self._continued("collisions", new["accepted"])
        for name, values in new.items():
            self._store(name, values)
        self.length += record.elapsed.shape[2]
        self._samples.append(sample)
        self.total_excess += float(np.sum(tally.excess))

    def _continued(self, name: str, increments: np.ndarray) -> np.ndarray:
        """Running total before each record; the total so far is kept from chunk to chunk."""
        start = self._totals.get(name, np.zeros(increments.shape[:2]))
        total = start[..., None] + np.cumsum(increments, axis=2)
        self._totals[name] = total[..., -1]
        return total - increments

    def _store(self, name: str, values: np.ndarray) -> None:
        """Write into a column whose capacity doubles, so that long runs cost in proportion."""
        first, last = self.length, self.length + values.shape[2]
        column = self._columns.get(name, np.empty((*values.shape[:2], 0, *values.shape[3:])))
        if last > column.shape[2]:
            room = np.empty((*values.shape[:2], 2 * last, *values.shape[3:]))
            room[:, :, :first] = column[:, :, :first]
            self._columns[name] = column = room
        column[:, :, first:last] = values

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[name][:, :, : self.length]

    @property
    def names(self) -> list[str]:
        """Names of the averages over particles."""
        skip = ("elapsed", "accepted", "energy_lost", "time", "collisions")
        return [name for name in self._columns if name not in skip]

    def point(
        self, point: int, first: int | np.integer, last: int | np.integer
    ) -> dict[str, np.ndarray]:
        """Averages over a window of records of one point: arrays (realizations, ...).

        Averages over particles are weighted with the time their record stands for; `accepted` and
        `energy_lost` become rates per particle and time.
        """
        window = slice(first, last)
        elapsed = self["elapsed"][point, :, window]
        total = np.sum(elapsed, axis=1)
        means = {}
        for name in self.names:
            values = self[name][point, :, window]
            weights = elapsed.reshape(elapsed.shape + (1,) * (values.ndim - 2))
            scale = total.reshape(total.shape + (1,) * (values.ndim - 2))
            means[name] = np.sum(weights * values, axis=1) / scale
        for name in ("accepted", "energy_lost"):
            means[name] = np.sum(self[name][point, :, window], axis=1) / total
        means["time_step"] = np.mean(elapsed, axis=1) / self.steps_per_record
        return means

    def samples(
        self, point: int, first: int | np.integer, records_per_chunk: int
    ) -> dict[str, np.ndarray]:
        """Chunk samples of one point taken after record `first`: means (realizations, bins)."""
        kept = self._samples[-(-first // records_per_chunk) :]
        if not kept:
            return {}
        names = kept[0].__dataclass_fields__
        return {n: np.mean([getattr(s, n)[point] for s in kept], axis=0) for n in names}

    def mean_collisions(self) -> np.ndarray:
        """Accepted collisions per particle so far, (points,)."""
        return np.mean(self._totals["collisions"], axis=1)

    @property
    def total_accepted(self) -> float:
        """Accepted collisions of all gases together."""
        return float(np.sum(self._totals["collisions"])) * self.n_particles

    def mean_time(self) -> np.ndarray:
        """Time so far (τ0), (points,)."""
        return np.mean(self._totals["time"], axis=1)

    def record_at_collisions(self, point: int, collisions: float) -> int:
        """First record at which a point has made that many collisions per particle."""
        return int(np.searchsorted(np.mean(self["collisions"][point], axis=0), collisions))

    def on_common_times(self) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Averages of every realization at the mean times of the records.

        Realizations have their own clocks (their time step follows their own temperature); each is
        interpolated linearly in time to the mean clock of its point, as far as all have come.
        Returns: times (points, records) and averages (points, realizations, records, ...).
        """
        time = self["time"]
        common = np.mean(time, axis=1)
        reached = np.sum(common <= np.min(time[:, :, -1], axis=1, keepdims=True), axis=1)
        common = common[:, : np.min(reached)]
        series = {name: self[name] for name in self.names} | {"collisions": self["collisions"]}
        if "local_rate" in self._columns:
            series["local_collisions"] = _integral(time, self["local_rate"])
        elif "temperature" in self._columns:
            scale = self["scale"] if "scale" in self._columns else 1.0
            thermal = np.sqrt(2.0 * self["temperature"]) * scale
            series["local_collisions"] = _integral(time, thermal) / np.sqrt(np.pi)
        out = {name: np.empty_like(v[:, :, : common.shape[1]]) for name, v in series.items()}
        for p, r in np.ndindex(time.shape[:2]):
            for name, values in series.items():
                out[name][p, r] = _interpolate(common[p], time[p, r], values[p, r])
        return common, out


def _integral(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Trapezoidal integral from the first record, along the last axis."""
    pieces = 0.5 * (values[..., 1:] + values[..., :-1]) * np.diff(time, axis=-1)
    return np.concatenate([np.zeros_like(values[..., :1]), np.cumsum(pieces, axis=-1)], axis=-1)


def _interpolate(at: np.ndarray, time: np.ndarray, values: np.ndarray) -> np.ndarray:
    if values.ndim == 1:
        return np.interp(at, time, values)
    columns = [np.interp(at, time, column) for column in values.T]
    return np.stack(columns, axis=-1)
