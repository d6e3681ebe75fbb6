"""What was measured, looked up by gas, restitution and shear rate; and in the slab."""

from pathlib import Path

import numpy as np
import xarray as xr

from jdsmc import Estimate
from jdsmc.gases.hard_spheres import RATE_FACTORS

from .. import store
from ..case import Measurements, at, estimate, steady
from ..numbers import mean, stack
from ..paper import Paper
from . import cases
from .cases import FAST, LAYERS, LENGTH, SLAB_RESTITUTION, SLOW, variation

CENTRE, TOP = slice(LAYERS // 2 - 2, LAYERS // 2 + 2), slice(LAYERS - 3, LAYERS)
"""The four central and the three top layers of Fig. 3."""

HEIGHT = (np.arange(LAYERS) + 0.5) / LAYERS - 0.5
"""Centres of the layers, y/L as in the paper: from -1/2 to 1/2."""


def beta(gas: str, restitution: float = SLAB_RESTITUTION) -> float:
    """Collision rate over that of IHS."""
    return 1.0 if gas == "ihs" else RATE_FACTORS["linear"](restitution)


class Curve:
    """Values and errors against time, of each layer or of a group of them."""

    def __init__(self, time: np.ndarray, found: Estimate):
        self.time, self.found = time, found
        self.value, self.error = found

    def at(self, time) -> Estimate:
        """Interpolated linearly, layer by layer."""

        def there(columns):
            flat = columns.reshape(len(columns), -1).T
            found = np.array([np.interp(time, self.time, column) for column in flat])
            return found[0] if columns.ndim == 1 else found

        return Estimate(there(self.value), there(self.error))

    def over(self, layers: slice) -> "Curve":
        """Average over some layers, whose errors are taken as independent."""
        error = self.error[:, layers]
        mean_error = np.sqrt(np.sum(error**2, axis=1)) / error.shape[1]
        return Curve(self.time, Estimate(np.mean(self.value[:, layers], axis=1), mean_error))


class Shear(Measurements):
    """All results of a run of this experiment."""

    def __init__(self, size, folder: Path, fresh: bool = False):
        super().__init__(size, cases.cases(size), folder, fresh)

    def rates(self, gas: str) -> tuple[float, ...]:
        """Shear rates of the steady states of a gas."""
        return (FAST, SLOW) if gas in ("ihs", "ehs") else (FAST,)

    def restitutions(self, gas: str = "ihs") -> np.ndarray:
        """Restitutions of the steady states of a gas."""
        return self.results[f"steady_{gas}"].steady["restitution"].values

    def steady(self, gas: str, restitution: float, shear_rate: float, name: str) -> Estimate:
        """A steady value at one point."""
        point = {"restitution": restitution, "shear_rate": shear_rate}
        return steady(self.results[f"steady_{gas}"], name, **point)

    def against(self, gas: str, name: str, shear_rate: float | None = None) -> Estimate:
        """A steady value against restitution; without a shear rate the mean over both."""
        rates = self.rates(gas) if shear_rate is None else (shear_rate,)
        result = self.results[f"steady_{gas}"]
        found = mean([steady(result, name, shear_rate=rate) for rate in rates])
        return found if np.ndim(found.value) else stack([found])

    def both(self, name: str, shear_rate: float | None = None) -> tuple[Estimate, Estimate]:
        """The same of IHS and of EHS."""
        return self.against("ihs", name, shear_rate), self.against("ehs", name, shear_rate)

    def distribution(self, gas: str, restitution: float, rate: float | None = None) -> xr.Dataset:
        """Steady velocity distributions; without a shear rate the mean over both (Fig. 18)."""
        rates, found = self.rates(gas) if rate is None else (rate,), self.results[f"steady_{gas}"]
        parts = [at(found.distribution, restitution=restitution, shear_rate=r) for r in rates]
        means = sum(parts[1:], parts[0].copy()) / len(parts)
        for name in ("marginal_x", "marginal_y", "speed"):
            squares = sum(part[f"{name}_error"] ** 2 for part in parts)
            means[f"{name}_error"] = np.sqrt(squares) / len(parts)
        return means

    def series(self, gas: str, restitution: float, shear_rate: float) -> xr.Dataset:
        """Time series at one point, with `clock`: s for IHS and s'/β for EHS."""
        point = {"restitution": restitution, "shear_rate": shear_rate}
        found = at(self.results[f"transient_{gas}"].series, **point)
        return found.assign(clock=found["collisions"] / beta(gas, restitution))

    def repeated(self, label: str) -> "Repeated":
        """Steady values with other numerics."""
        return Repeated(self, label)

    def slab(self, stage: str, gas: str, start: str = "equilibrium") -> xr.Dataset:
        """Time series of the slab with `clock`; stage "early" or "late"."""
        found = self.results[f"slab_{stage}_{gas}_{start}"].series
        return found.assign(clock=found["collisions"] / beta(gas))

    def slab_steady(self, gas: str, name: str) -> Estimate:
        """A steady average of the slab started from equilibrium."""
        return self.results[f"slab_late_{gas}_equilibrium"][name]


class Repeated:
    """The steady values of `Shear`, every point run again with other numerics (`variation`)."""

    def __init__(self, data: Shear, label: str):
        self.data, self.label = data, label

    def steady(self, gas: str, restitution: float, shear_rate: float, name: str) -> Estimate:
        """A steady value at one point."""
        case = self.data.cases[f"steady_{gas}"]
        again = variation(case, gas, restitution, shear_rate, self.label)
        return steady(store.obtain(again, self.data.folder, self.data.fresh), name)


def profile(series: xr.Dataset, name: str) -> Curve:
    """A profile against time in the units of Fig. 2: u_x/aL, n/n̄ or T/T̄."""
    scale = {"velocity_x": FAST * LENGTH, "density": 1.0}.get(name)
    if scale is None:
        scale = series["mean_temperature"].values[:, None]
    value, error = estimate(series, name)
    return Curve(series["time"].values, Estimate(value / scale, error / scale))


PAPER = Paper("uniform_shear_flow", Shear)
