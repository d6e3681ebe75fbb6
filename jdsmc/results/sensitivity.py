"""Derivatives of steady values and time series, labelled."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from .. import views
from ..estimate import Estimate, format_estimate


class Derivative(Estimate):
    """A derivative: `value`, `error` (one standard error), `truncation` (that of the method).

    Arithmetic is that of `Estimate`, and propagates the error.
    """

    def __init__(self, value, error, truncation, left_out: dict | None = None, points=None):
        super().__init__(value, error, left_out, points)
        self.truncation = truncation

    @property
    def uncertainty(self) -> Any:
        """Error and truncation together, √(error² + truncation²)."""
        return np.hypot(self.error, self.truncation)

    def __getitem__(self, index) -> "Derivative":
        """One element of an array, or some of them."""
        part = super().__getitem__(index)
        truncation = np.asarray(self.truncation)[index]
        made = Derivative(part.value, part.error, truncation)
        vars(made).update(vars(part))
        return made

    def __repr__(self) -> str:
        return f"Derivative({self})"

    def __str__(self) -> str:
        if np.ndim(self.value):
            return "\n".join(str(self[index]) for index in np.ndindex(np.shape(self.value)))
        return f"{format_estimate(float(self.value), float(self.error))} ±{self.truncation:.1g}"


class ByNumber(dict):
    """Derivatives by the name of the number."""

    def __missing__(self, name):
        raise KeyError(f"no derivative with respect to {name!r}; there are {', '.join(self)}.")


class Sensitivity:
    """`s["shear_stress"]["restitution"]` is ∂(-P_xy/nT)/∂α; `s.series` those at fixed time."""

    def __init__(self, result):
        self.result = result
        self._steady = result.to_xarray()["sensitivity"].to_dataset()

    @property
    def parameters(self) -> tuple[str, ...]:
        """The numbers with respect to which there are derivatives."""
        return tuple(str(name) for name in self._steady["parameter"].values)

    def __iter__(self) -> Iterator[str]:
        """Names of the observables that have derivatives."""
        return (str(n) for n in self._steady.data_vars if f"{n}_error" in self._steady)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __contains__(self, name: object) -> bool:
        return name in self._steady and f"{name}_error" in self._steady

    def __getitem__(self, name: str) -> Mapping[str, Derivative]:
        """Derivatives of one observable, by the number; KeyError says why there are none."""
        if name in self:
            return ByNumber({p: self._derivative(name, p) for p in self.parameters})
        if not len(self):
            stopped = self.result.attrs.get("stopped", "the run was not steady")
            raise KeyError(f"no steady derivatives: {stopped}. See .series.")
        known = ", ".join(self)
        if name in self.result:
            raise KeyError(f"{name} has no derivative by this method; there are {known}.")
        raise KeyError(f"no observable {name!r}; there are {known}.")

    def _derivative(self, name: str, parameter: str) -> Derivative:
        found = self._steady.sel(parameter=parameter)
        value, error, truncation = (
            found[f"{name}{suffix}"].values for suffix in ("", "_error", "_truncation")
        )
        value, error, truncation = (x if x.ndim else float(x) for x in (value, error, truncation))
        tree, left_out, points = self.result.to_xarray(), None, None
        if "sensitivity_left_out" in tree.children:
            data = tree["sensitivity_left_out"].to_dataset().sel(parameter=parameter)[name]
            left_out = {self.result.attrs["run"]: data.transpose("realization", ...).values}
            points = self.result.points_of(found[name].dims, np.shape(value))
        return Derivative(value, error, truncation, left_out, points)

    @property
    def series(self) -> xr.Dataset:
        """Derivatives at fixed time (τ0) along the run; KeyError if none were kept."""
        tree = self.result.to_xarray()
        if "sensitivity_series" not in tree.children:
            raise KeyError(
                "no derivatives along the time series: only a run of given duration or collisions "
                "has them."
            )
        return tree["sensitivity_series"].to_dataset()

    def to_xarray(self) -> xr.Dataset:
        """Steady derivatives: every observable, its `_error` and `_truncation`."""
        return self._steady

    def table(self) -> str:
        """Derivatives with error and truncation, as text."""
        return views.sensitivity_table(self)

    def plot(self, path: str | Path | None = None):
        """Draw them; returns the matplotlib figure, saved to `path` if given."""
        figure = views.draw_sensitivity(self)
        if path is not None:
            figure.savefig(path, dpi=130)
        return figure

    def __repr__(self) -> str:
        return f"<jdsmc.Sensitivity {self.result.attrs.get('scene', '')}>\n{self.table()}"

    def _repr_html_(self) -> str:
        return views.sensitivity_html(self)
