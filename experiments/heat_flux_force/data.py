"""What was measured: equal simulations pooled, looked up by restitution, field and name."""

from pathlib import Path

import numpy as np

from jdsmc import Estimate, Result

from ..case import Case, Measurements, at, estimate, steady
from ..numbers import Even, mean, stack
from ..paper import Paper
from .cases import studies


class Pool:
    """Equal simulations of different seeds: means over them, which all weigh the same."""

    def __init__(self, cases: list[Case], results: list[Result]):
        self.cases, self.results = cases, results
        self._means: dict[tuple, Estimate] = {}

    def parts(self, name: str, restitution: float, order: int | None = None) -> list[Estimate]:
        """A steady value of every part."""
        found = [steady(result, name, restitution=restitution) for result in self.results]
        return found if order is None else [one[order - 1] for one in found]

    def value(self, name: str, restitution: float, order: int | None = None) -> Estimate:
        """A steady value; values of one gas are correlated."""
        key = name, restitution, order
        if key not in self._means:
            self._means[key] = mean(self.parts(*key))
        return self._means[key]

    def misfit(self, name: str, restitution: float, order: int | None = None) -> float:
        """χ² of the parts about their mean over its degrees of freedom: 1 if errors are honest."""
        found = self.parts(name, restitution, order)
        return Even(np.ones(len(found)), found, ()).misfit

    def each_series(
        self, restitution: float, name: str, order: int | None = None
    ) -> tuple[np.ndarray, list[Estimate]]:
        """Time, and the value at every time in every part, on the clock of the first."""
        found = [at(result.series, restitution=restitution) for result in self.results]
        if order is not None:
            found = [series.sel(sonine_order=order) for series in found]
        time = found[0]["time"].values
        time = time[time <= min(series["time"].values[-1] for series in found)]
        columns = [
            [np.interp(time, series["time"].values, part) for part in estimate(series, name)]
            for series in found
        ]
        return time, [Estimate(*column) for column in columns]

    def marginal(self, restitution: float) -> tuple[np.ndarray, np.ndarray]:
        """Centres of the bins of c_x, and the density in them: (parts, bins)."""
        found = [at(result.distribution, restitution=restitution) for result in self.results]
        density = np.array([part["marginal_x"].values for part in found])
        return found[0]["velocity"].values, density

    @property
    def n_particles(self) -> int:
        """Particles of all realizations and parts, at one point."""
        attrs = [result.attrs for result in self.results]
        return sum(int(a["n_particles"]) * int(a["n_realizations"]) for a in attrs)

    def measured_time(self, restitution: float) -> float:
        """Time averaged over, the mean of the parts (τ0)."""
        ends = [at(r.series, restitution=restitution)["time"].values[-1] for r in self.results]
        starts = [at(r.steady, restitution=restitution)["steady_from_time"] for r in self.results]
        return float(np.mean(ends) - np.mean(starts))


class Heat(Measurements):
    """All pools of a run of this experiment, by the name of their study."""

    def __init__(self, size, folder: Path, fresh: bool = False):
        found = studies(size)
        super().__init__(size, [case for cases in found.values() for case in cases], folder, fresh)
        self.pools = {n: Pool(c, [self.results[one.name] for one in c]) for n, c in found.items()}
        self.fits: dict[tuple, Even] = {}

    def __getitem__(self, name: str) -> Pool:
        return self.pools[name]

    @property
    def restitutions(self) -> tuple[float, ...]:
        """Those of the steady states."""
        return self.size.restitutions

    @property
    def fields(self) -> tuple[float, ...]:
        """Those of the steady states, from the weakest on."""
        return tuple(sorted(strength for strength, _ in self.size.fields))

    def steady(self, strength: float) -> Pool:
        """The steady states at a field."""
        return self[f"force_{strength:g}"]

    def transient(self, restitution: float, strength: float) -> Pool:
        """An approach to the steady state."""
        return self[f"transient_{restitution:g}_{strength:g}"]

    def over_restitutions(self, value) -> Estimate:
        """A function of the restitution as an array."""
        return stack(value(alpha) for alpha in self.restitutions)


PAPER = Paper("heat_flux_force", Heat)
