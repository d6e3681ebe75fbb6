"""From the history of a run to a labelled result."""

import numpy as np
import xarray as xr

from .. import sweep
from ..derivatives.steady import steady_derivatives
from ..derivatives.transient import transient_derivatives
from ..measure.observable import CLOCKS, COLLISION_RATIO, COLLISIONS, TIME, Observable
from ..results.result import FREEDOM, Result
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from ..stats import jackknife
from .estimates import (
    against_time,
    averages_to_print,
    check_leading_axes,
    estimates_of,
    takes_leading_axes,
)
from .history import History
from .provenance import provenance, run_name
from .session import Session

STEADY_FROM = (
    Observable("steady_from_time", "time from which the gas was measured", "τ0"),
    Observable("steady_from_collisions", "collisions per particle before it was measured"),
)
DEGREES_OF_FREEDOM = Observable(FREEDOM, "degrees of freedom of the errors of steady values")


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
        data = {}
        known = {one.name: one for one in observables}
        for name, values in columns.items():
            plain = name.removesuffix("_error").removesuffix("_truncation")
            one = known.get(plain, Observable(name, name))
            wrong = name != one.name
            kind = "standard error" if name.endswith("_error") else "truncation"
            long = f"{kind} of {one.meaning}" if wrong else one.meaning
            attributes = {"long_name": long, "units": one.unit}
            if one.symbol and not wrong:
                attributes["symbol"] = one.symbol
            array = np.asarray(values)
            own = one.dims or self.likely_dims(name, array.shape[1 + len(extra) :])
            data[name] = (
                (*self.dims, *extra, *own),
                array.reshape(self.shape + array.shape[1:]),
                attributes,
            )
        used = {dim for dims, *_ in data.values() for dim in dims}
        axes = {name: axis for name, axis in self.axes.items() if name in used}
        return xr.Dataset(data, coords=self.coords | axes)

    def likely_dims(self, name: str, shape: tuple[int, ...]) -> tuple[str, ...]:
        """Of what no observable describes: the only axis of that length, or one of its own."""
        dims = []
        for k, length in enumerate(shape):
            fits = [axis for axis, (_, values, _) in self.axes.items() if len(values) == length]
            dims.append(fits[0] if len(fits) == 1 and fits[0] not in dims else f"{name}_{k}")
        return tuple(dims)


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


def assemble(scene: AbstractScene, session: Session, can_be_steady: bool, attrs: dict) -> Result:
    """Everything measured, labelled by the swept dimensions.

    Arguments: the scene as the user made it; the session; False where steady values make no sense;
    attributes that tell how the run ended. A point of a sweep that has not settled has NaN.
    """
    history, options = session.history, session.options
    labels = Labels(scene, history.scenes, options)
    groups = {"/series": _series(scene, labels, history)}
    root = xr.Dataset(coords=labels.coords)
    settled = _settled(session) if can_be_steady and history.length else np.zeros(1, bool)
    if np.any(settled):
        steady, attrs = _steady(scene, labels, session, settled, attrs)
        root = steady.pop("/")
        groups |= steady
    if session.samples is not None:
        groups |= _sensitivity(scene, labels, session, settled)
    root.attrs = provenance(scene, options) | attrs
    root.attrs["swept"] = " ".join(labels.dims)
    root.attrs["n_records"] = history.length
    root.attrs["run"] = run_name(scene, options, attrs["seed"])
    groups["/"] = root
    return Result(xr.DataTree.from_dict(groups))


def _settled(session: Session) -> np.ndarray:
    """Points that are steady and have been measured for at least one whole chunk."""
    measured = session.tracker.start <= session.history.length - session.options.records
    return session.settled() & measured


def _steady(scene, labels, session, settled, attrs: dict) -> tuple[dict, dict]:
    """Groups of steady values, and the attributes with remarks."""
    history, starts = session.history, session.tracker.start
    points = range(len(history.scenes))
    averages = [
        averages_to_print(history, p, int(starts[p])) if settled[p] else None for p in points
    ]
    estimates = [
        one and estimates_of(history.scenes[p], *one)
        for p, one in zip(points, averages, strict=True)
    ]
    columns = {}
    for kind, suffix in enumerate(("", "_error")):
        found = _each([one and one[kind] for one in estimates])
        columns |= {f"{name}{suffix}": values for name, values in found.items()}
    for one, clock in zip(STEADY_FROM, ("time", "collisions"), strict=True):
        at_start = [_at_start(history[clock][p], starts[p]) for p in points]
        columns[one.name] = np.where(settled, at_start, np.nan)
    freedom = [len(next(iter(one[2].values()))) - 1.0 if one else np.nan for one in estimates]
    columns[FREEDOM] = np.array(freedom)
    groups = {"/": labels.dataset(columns, (*scene.reports, *STEADY_FROM, DEGREES_OF_FREEDOM))}
    left_out = _each(_as_many([one and one[2] for one in estimates]))
    groups["/left_out"] = labels.dataset(left_out, scene.reports, ("realization",))
    for p, one in enumerate(averages):
        if one is not None:
            check_leading_axes(history.scenes[p], one[0])
    sums = _each([one and one[0] for one in averages])
    dims = {one.name: one for one in scene.reports}
    groups["/realizations"] = labels.dataset(
        {name: x for name, x in sums.items() if not np.iscomplexobj(x)},
        [dims[n]._replace(meaning=n) for n in sums if n in dims],
        ("realization",),
    )
    if not scene.correlated:  # what `merge` needs
        groups["/averages"] = labels.dataset(sums, (), ("realization",))
        parts = [one and one[1] for one in averages]
        if all(part for part, there in zip(parts, settled, strict=True) if there):
            groups["/blocks"] = labels.dataset(_each(parts), (), ("part",))
    if scene.sampled:
        records = session.options.records
        groups["/distribution"] = _distribution(scene, labels, history, starts, settled, records)
    remarks = [
        one.remarks(*history.window(p, starts[p], history.length))
        for p, one in enumerate(history.scenes)
        if settled[p]
    ]
    remarks += ["Points that are not steady yet have NaN."] if not np.all(settled) else []
    return groups, attrs | {"remarks": " ".join(sorted(set(remarks) - {""}))}


def _sensitivity(scene, labels: Labels, session: Session, settled) -> dict[str, xr.Dataset]:
    """Derivatives of steady values, and of what changes with time."""
    history, samples, request = session.history, session.samples, session.request
    assert samples is not None and request is not None
    names = {"parameter": list(request.paths)}
    groups = {"/sensitivity": xr.Dataset(coords=labels.coords | names)}
    found = (
        [
            steady_derivatives(
                one, samples, p, int(session.tracker.start[p]), request.paths, request.facts
            )
            if settled[p]
            else None
            for p, one in enumerate(history.scenes)
        ]
        if np.any(settled)
        else []
    )
    if any(found):
        columns = _without_nothing(_each(found))
        last = "_left_out"
        values = {n: x for n, x in columns.items() if not n.endswith(last)}
        left_out = {n.removesuffix(last): x for n, x in columns.items() if n.endswith(last)}
        along = ("realization", "parameter")
        for group, data, extra in (
            ("/sensitivity", values, along[1:]),
            ("/sensitivity_left_out", left_out, along),
        ):
            groups[group] = labels.dataset(data, scene.reports, extra).assign_coords(names)
    if samples.sampler.each:
        series = [
            transient_derivatives(
                one, samples, p, np.mean(history["time"][p], axis=0), request.paths
            )
            for p, one in enumerate(history.scenes)
        ]
        columns = _without_nothing(_each(series))
        time = {"time": columns.pop("time")}
        data = labels.dataset(columns, scene.reports, ("parameter", "sample"))
        data = data.merge(labels.dataset(time, CLOCKS, ("sample",))).assign_coords(names)
        groups["/sensitivity_series"] = data.set_coords("time")
    return groups


def _without_nothing(columns: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The same without what is NaN everywhere, with its errors."""
    there = {name for name, values in columns.items() if np.any(np.isfinite(values))}
    endings = ("_error", "_truncation", "_left_out")
    base = {
        name: next((name.removesuffix(e) for e in endings if name.endswith(e)), name)
        for name in columns
    }
    return {name: values for name, values in columns.items() if base[name] in there}


def _each(points: list[dict | None]) -> dict[str, np.ndarray]:
    """Arrays whose first axis is the point, NaN where there is nothing.

    Names are left out whose arrays differ in shape from point to point (blocks of realizations).
    """
    one = next(point for point in points if point)
    found = {}
    for name, example in one.items():
        values = [np.asarray(point[name]) for point in points if point]
        if any(x.shape != np.shape(example) for x in values):
            continue
        nothing = np.full(np.shape(example), np.nan)
        found[name] = np.stack([np.asarray(p[name]) if p else nothing for p in points])
    return found


def _as_many(points: list[dict | None]) -> list[dict | None]:
    """Values with one realization left out, filled up to as many at every point.

    Blocks of realizations differ in number from point to point. Rows of the mean are added and the
    others spread, so that the jackknife gives the same error.
    """
    most = max(len(values) for point in points if point for values in point.values())

    def filled(values):
        count = len(values)
        middle = np.mean(values, axis=0)
        spread = np.sqrt((count - 1) / count * most / (most - 1))
        rest = np.broadcast_to(middle, (most - count, *middle.shape))
        return np.concatenate([middle + spread * (values - middle), rest])

    return [
        point and {n: filled(v) if len(v) < most else v for n, v in point.items()}
        for point in points
    ]


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

    value, error, _ = jackknife(means, observables, axis=0, leading=takes_leading_axes(one))
    return {TIME.name: time, **value, **{f"{name}_error": e for name, e in error.items()}}


def _distribution(scene, labels, history: History, starts, settled, records: int) -> xr.Dataset:
    """Probability densities from the samples of all chunks after the start."""
    found: list[dict | None] = []
    for point, one in enumerate(history.scenes):
        if not settled[point]:
            found.append(None)
            continue
        densities = one.sample_densities(history.samples(point, int(starts[point]), records))
        columns = {}
        for name, values in densities.items():
            columns[name] = np.mean(values, axis=0)
            error = np.std(values, axis=0, ddof=1) / np.sqrt(len(values))
            # where nobody was seen the density may be anything that is rare enough
            columns[f"{name}_error"] = np.where(np.any(values != 0, axis=0), error, np.nan)
        found.append(columns)
    return labels.dataset(_each(found), scene.sampled)
