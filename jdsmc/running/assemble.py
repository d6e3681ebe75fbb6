"""From the history of a run to a labelled result."""

import numpy as np
import xarray as xr

from .. import sweep
from ..measure.observable import CLOCKS, COLLISION_RATIO, COLLISIONS, TIME, Observable
from ..results.result import Result
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from ..stats import jackknife
from .estimates import against_time, steady_estimates
from .history import History
from .provenance import provenance, run_name

STEADY_FROM = (
    Observable("steady_from_time", "time from which the gas was measured", "τ0"),
    Observable("steady_from_collisions", "collisions per particle before it was measured"),
)


class Labels:
    """Dimensions and coordinates of a sweep, and of what its scenes report beside it."""

    def __init__(self, scene: AbstractScene, scenes: list[AbstractScene], options: Options):
        self.coords = {}
        facts = {short: sweep.facts(scene, path) for path, short in sweep.labels(scene).items()}
        for name, values in sweep.dimensions(scene).items():
            known = facts[name]
            described = {"long_name": known.get("meaning", name), "units": known.get("unit", "1")}
            along = (name, f"{name}_component")[: values.ndim]
            self.coords[name] = (along, values, described)
        self.dims = tuple(self.coords)
        self.shape = tuple(len(values) for values in sweep.dimensions(scene).values())
        self.axes = common_axes([one.axes(options) for one in scenes])

    def dataset(self, columns: dict, observables, extra: tuple = ()) -> xr.Dataset:
        """Variables from arrays whose first axis is the sweep point, then `extra`, then their own.

        Arguments: arrays by name, `<name>_error` included; what the names mean.
        """
        data = xr.Dataset(coords=self.coords)
        known = {one.name: one for one in observables}
        for name, values in columns.items():
            one = known.get(name.removesuffix("_error"), Observable(name, name))
            wrong = name != one.name
            long = f"standard error of {one.meaning}" if wrong else one.meaning
            attributes = {"long_name": long, "units": one.unit}
            if one.symbol and not wrong:
                attributes["symbol"] = one.symbol
            array = np.asarray(values)
            own = one.dims or tuple(f"{name}_{k}" for k in range(array.ndim - 1 - len(extra)))
            data[name] = (
                (*self.dims, *extra, *own),
                array.reshape(self.shape + array.shape[1:]),
                attributes,
            )
        return data.assign_coords({n: c for n, c in self.axes.items() if n in data.dims})


def common_axes(each: list[dict]) -> dict:
    """Coordinates that all points share; shares of the whole where they differ by a factor."""
    shared = {}
    for name, first in each[0].items():
        values = [axes[name][0] if isinstance(axes[name], tuple) else axes[name] for axes in each]
        facts = dict(first[1]) if isinstance(first, tuple) else {}
        if not all(np.array_equal(values[0], other) for other in values):
            values = [np.asarray(v) / (v[0] + v[-1]) for v in values]
            facts["units"] = "share of the whole"
        shared[name] = (name, values[0], facts)
    return shared


def assemble(scene: AbstractScene, history: History, tracker, session, attrs: dict) -> Result:
    """Everything measured, labelled by the swept dimensions.

    Arguments: the scene as the user made it; the history; the tracker, or None where steady
    values make no sense; the session; attributes that tell how the run ended.
    """
    options = session.options
    labels = Labels(scene, history.scenes, options)
    groups = {"/series": _series(scene, labels, history)}
    root = xr.Dataset(coords=labels.coords)
    points = range(len(history.scenes))
    if tracker is not None and history.length and _measured(tracker, history, options.records):
        starts = [int(start) for start in tracker.start]
        estimates = [steady_estimates(history, p, starts[p]) for p in points]
        columns = {}
        for name in estimates[0][0]:
            columns[name] = [one[0][name] for one in estimates]
            columns[f"{name}_error"] = [one[1][name] for one in estimates]
        for one, clock in zip(STEADY_FROM, ("time", "collisions"), strict=True):
            columns[one.name] = [_at_start(history[clock][p], starts[p]) for p in points]
        root = labels.dataset(columns, (*scene.reports, *STEADY_FROM))
        left_out = {name: [one[2][name] for one in estimates] for name in estimates[0][2]}
        groups["/left_out"] = labels.dataset(left_out, scene.reports, ("realization",))
        means = [history.point(p, starts[p], history.length) for p in points]
        sums = {name: [one[name] for one in means] for name in means[0]}
        dims = {one.name: one._replace(meaning=one.name) for one in scene.reports}
        groups["/realizations"] = labels.dataset(
            sums, [dims[n] for n in sums if n in dims], ("realization",)
        )
        if scene.sampled:
            groups["/distribution"] = _distribution(scene, labels, history, starts, options.records)
        remarks = {
            one.remarks(*history.window(p, starts[p], history.length))
            for p, one in enumerate(history.scenes)
        }
        attrs = attrs | {"remarks": " ".join(sorted(remarks - {""}))}
    root.attrs = provenance(scene, options) | attrs
    root.attrs["swept"] = " ".join(labels.dims)
    root.attrs["n_records"] = history.length
    root.attrs["run"] = run_name(scene, options, attrs["seed"], history.length)
    groups["/"] = root
    return Result(xr.DataTree.from_dict(groups))


def _measured(tracker, history: History, records: int) -> bool:
    """True if every point has been measured for at least one whole chunk."""
    ready = tracker.all_measuring and np.all(tracker.start <= history.length - records)
    return bool(ready)


def _at_start(clock: np.ndarray, start: int | np.integer) -> float:
    return float(np.mean(clock[:, start]))


def _series(scene: AbstractScene, labels: Labels, history: History) -> xr.Dataset:
    """Observables against time: every point at its own times, all as far as the shortest."""
    found = [_one_series(history, p) for p in range(len(history.scenes))]
    length = min(len(one["time"]) for one in found)
    columns = {name: [one[name][:length] for one in found] for name in found[0]}
    described = (*CLOCKS, *scene.reports, *scene.evolves)
    data = labels.dataset(columns, described, ("sample",))
    return data.set_coords("time").assign_coords(sample=np.arange(length))


def _one_series(history: History, point: int) -> dict[str, np.ndarray]:
    time, means = history.on_common_times(point)
    one = history.scenes[point]

    def observables(averages):
        found = against_time(one, averages)
        found[COLLISIONS.name] = averages["collisions"]
        if "local_collisions" in averages:
            with np.errstate(divide="ignore", invalid="ignore"):
                ratio = averages["collisions"] / averages["local_collisions"]
            found[COLLISION_RATIO.name] = ratio
        return found

    value, error, _ = jackknife(means, observables, axis=0)
    return {TIME.name: time, **value, **{f"{name}_error": e for name, e in error.items()}}


def _distribution(scene, labels, history: History, starts, records: int) -> xr.Dataset:
    """Probability densities from the samples of all chunks after the start."""
    columns: dict[str, list] = {}
    for point, one in enumerate(history.scenes):
        densities = one.sample_densities(history.samples(point, starts[point], records))
        for name, values in densities.items():
            error = np.std(values, axis=0, ddof=1) / np.sqrt(len(values))
            columns.setdefault(name, []).append(np.mean(values, axis=0))
            columns.setdefault(f"{name}_error", []).append(error)
    return labels.dataset(columns, scene.sampled)
