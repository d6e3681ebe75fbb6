"""What was measured: equal simulations pooled, looked up by restitution, field and name."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import xarray as xr

from jdsmc import Estimate, Result

from ..store import obtain
from .systems import Size, Study, steady_name, studies, transient_name


class Pool:
    """Several equal simulations: means over them, errors from the realizations of all."""

    def __init__(self, study: Study, results: list[Result]):
        self.study, self.results = study, results
        self._roots = [result.to_xarray().to_dataset() for result in results]

    def parts(self, name: str, restitution: float, order: int | None = None) -> Estimate:
        """A steady value of every part: arrays (parts,)."""
        points = [at(root, restitution, order) for root in self._roots]
        pairs = [[float(p[n]) for n in (name, f"{name}_error")] for p in points]
        return Estimate(*np.array(pairs).T)

    def value(self, name: str, restitution: float, order: int | None = None) -> Estimate:
        """A steady value; parts are equally long, so that all weigh the same."""
        return mean(self.parts(name, restitution, order))

    def misfit(self, name: str, restitution: float, order: int | None = None) -> float:
        """χ² of the parts about their mean over its degrees of freedom: 1 if errors are honest."""
        value, error = self.parts(name, restitution, order)
        if len(value) < 2:
            return float("nan")
        return float(np.sum(((value - np.mean(value)) / error) ** 2) / (len(value) - 1))

    def series(
        self, restitution: float, name: str, order: int | None = None
    ) -> tuple[np.ndarray, Estimate]:
        """Time, and a value with its error at every time; parts on the clock of the first."""
        time, value = self._on_one_clock(name, restitution, order)
        _, error = self._on_one_clock(f"{name}_error", restitution, order)
        return time, mean(Estimate(value, error))

    def each_series(
        self, restitution: float, name: str, order: int | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Time, and the value at every time in every part: (parts, times)."""
        return self._on_one_clock(name, restitution, order)

    def _on_one_clock(self, name: str, restitution: float, order: int | None):
        found = [at(result.series, restitution, order) for result in self.results]
        last = min(float(series["time"].values[-1]) for series in found)
        time = found[0]["time"].values
        time = time[time <= last]
        return time, np.array([np.interp(time, s["time"].values, s[name].values) for s in found])

    def marginal(self, restitution: float) -> tuple[np.ndarray, np.ndarray]:
        """Centres of the bins of c_x, and the density in them: (parts, bins)."""
        found = [at(result.distribution, restitution) for result in self.results]
        density = np.array([part["marginal_x"].values for part in found])
        return found[0]["velocity"].values, density

    @property
    def n_particles(self) -> int:
        """Particles of all realizations and parts, at one point."""
        attrs = [result.attrs for result in self.results]
        return sum(int(a["n_particles"]) * int(a["n_realizations"]) for a in attrs)

    def duration(self, restitution: float) -> tuple[float, float]:
        """Time simulated and time averaged over, the mean of the parts (τ0)."""
        total = np.mean([at(r.series, restitution)["time"].values[-1] for r in self.results])
        start = np.mean([at(root, restitution)["steady_from_time"] for root in self._roots])
        return float(total), float(total - start)

    @property
    def seconds(self) -> float:
        """Wall time of all parts."""
        return sum(float(result.attrs["seconds"]) for result in self.results)


def mean(parts: Estimate) -> Estimate:
    """Mean of equally long parts along the first axis."""
    value, error = parts
    found = np.mean(value, axis=0), np.sqrt(np.sum(np.square(error), axis=0)) / len(value)
    return Estimate(*(float(x) if np.ndim(x) == 0 else x for x in found))


def at(data: xr.Dataset, restitution: float, order: int | None = None) -> xr.Dataset:
    """One restitution of a sweep, its only field or kick, and one Sonine order k."""
    found = data.sel(restitution=restitution, method="nearest", tolerance=1e-9)
    found = found.squeeze([d for d in ("field", "kick") if d in found.dims])
    return found if order is None else found.sel(sonine_order=order)


class Measurements:
    """All pools of a run of this experiment, by the name of their study."""

    def __init__(self, size: Size, pools: dict[str, Pool]):
        self.size, self.pools = size, pools

    def __getitem__(self, name: str) -> Pool:
        return self.pools[name]

    @property
    def restitutions(self) -> tuple[float, ...]:
        """Those of the steady states."""
        return self.size.restitutions

    @property
    def fields(self) -> tuple[float, ...]:
        """Those of the steady states, from the weakest on."""
        return tuple(sorted(self.size.fields))

    def steady(self, strength: float) -> Pool:
        """The steady states at a field."""
        return self[steady_name(strength)]

    def transient(self, restitution: float, strength: float) -> Pool:
        """An approach to the steady state."""
        return self[transient_name(restitution, strength)]

    def against_field(self, name: str, restitution: float, order: int | None = None) -> Estimate:
        """A steady value at every field, arrays."""
        return stack(self.steady(f).value(name, restitution, order) for f in self.fields)


def stack(estimates: Iterable[Estimate]) -> Estimate:
    """Numbers with errors as one array with errors."""
    return Estimate(*(np.array(column) for column in zip(*estimates, strict=True)))


def measure(size: Size, folder: Path, fresh: bool) -> Measurements:
    """Every simulation of a size, from FOLDER where it is there."""
    pools = {}
    for name, study in studies(size).items():
        pools[name] = Pool(study, [obtain(case, folder, fresh) for case in study.cases()])
    return Measurements(size, pools)
