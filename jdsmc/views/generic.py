"""Table and picture of any scene, from what its observables say of themselves."""

from collections.abc import Callable

import numpy as np
import xarray as xr

from . import common, pictures, velocities
from .page import Block, Page

NEEDS: set[str] = set()
MOST_COLUMNS = 6
MOST_PANELS = 4
CLOCKS = ("collisions", "collision_ratio")

Theory = dict[str, Callable[[str, int | None], str]]
"""Headings of columns beside the measured one, and their cells: of an observable, or of one of its
components."""
Columns = dict[str, Callable[[xr.Dataset], str]]
"""Headings of columns of a sweep, and their cells at one point."""


def page(
    result,
    theory: Theory | None = None,
    columns: Columns | None = None,
    labels: dict[tuple[str, int], str] | None = None,
    middle: dict[str, int] | None = None,
    heading: str = "steady value",
) -> Page:
    """Steady values: one row each for one gas, one row a point for a sweep.

    A scene may give columns of theory, columns of its sweeps, better names of components, and the
    layer of its profiles (by dimension) that counts as the middle one.
    """
    stopped = result.attrs.get("stopped", "")
    if not result.is_steady:
        return Page([], [f"No steady values ({stopped})."])
    steady, dims = result.steady, common.dimensions(result)
    if dims:
        blocks, notes = _sweep(steady, dims, columns)
    else:
        blocks = [_rows(steady, theory or {}, labels or {}, heading)]
        blocks = [block for block in blocks if block.rows] + _profiles(steady, middle or {})
        notes = _steady_from(steady)
    return Page(blocks, [*notes, *([f"Ended because {stopped}."] if stopped else [])])


def _rows(steady: xr.Dataset, theory: Theory, labels: dict, heading: str) -> Block:
    rows = []
    for name in common.names(steady):
        own = common.own_dims(steady, name, ())
        if any(d in common.HIDDEN for d in own):
            continue
        words, where = common.meaning(steady, name), common.unit(steady, name)
        if not own:
            known = [cell(name, None) for cell in theory.values()]
            rows.append([words, common.estimate(steady, name), *known, where])
        elif len(own) == 1 and steady.sizes[own[0]] <= common.FEW:
            for k in range(steady.sizes[own[0]]):
                label = labels.get((name, k), f"{words}, {common.place(steady, own[0], k)}")
                known = [cell(name, k) for cell in theory.values()]
                rows.append([label, common.estimate(steady, name, k), *known, where])
        elif len(own) > 1:
            low, high = (f(steady[name].values) for f in (np.nanmin, np.nanmax))
            rows.append([words, f"{low:.4g} .. {high:.4g}", *("" for _ in theory), where])
    return _without_empty(Block([heading, "jdsmc", *theory, "unit"], rows, (0, len(theory) + 2)))


def _without_empty(block: Block) -> Block:
    """The same without a last column that says nothing."""
    if any(row[-1] for row in block.rows):
        return block
    return Block(block.head[:-1], [row[:-1] for row in block.rows], block.words)


def _profiles(steady: xr.Dataset, middle: dict[str, int]) -> list[Block]:
    """First, middle and last value of every profile, one table for each dimension."""
    kinds: dict[str, list[str]] = {}
    for name in common.names(steady):
        own = common.own_dims(steady, name, ())
        if len(own) == 1 and own[0] not in common.HIDDEN and steady.sizes[own[0]] > common.FEW:
            kinds.setdefault(own[0], []).append(name)
    blocks = []
    for along, found in kinds.items():
        chosen = (0, middle.get(along, steady.sizes[along] // 2), steady.sizes[along] - 1)
        head = [f"profile along {along}", *(common.place(steady, along, k) for k in chosen), "unit"]
        rows = [
            [
                common.meaning(steady, name),
                *(common.estimate(steady, name, k) for k in chosen),
                common.unit(steady, name),
            ]
            for name in found
        ]
        blocks.append(_without_empty(Block(head, rows, (0, len(chosen) + 1))))
    return blocks


def _steady_from(steady: xr.Dataset) -> list[str]:
    if "steady_from_time" not in steady:
        return []
    time, collisions = (float(steady[f"steady_from_{c}"]) for c in ("time", "collisions"))
    if time == 0.0:  # nothing had to be waited for
        return []
    return [f"steady from t = {time:.1f} τ0, s = {collisions:.0f} collisions per particle"]


def _sweep(steady: xr.Dataset, dims, columns: Columns | None):
    """One row a point, and a sentence that names what is not shown."""
    notes = []
    if columns is None:
        every = common.scalars(steady, dims)
        columns = of_observables(steady, every[:MOST_COLUMNS])
        if not every:
            columns = _of_components(steady, dims)
        if every[MOST_COLUMNS:]:
            notes = [f"More in result.steady: {', '.join(every[MOST_COLUMNS:])}."]
    head = [common.with_unit(steady, name, name) for name in dims]
    rows = []
    for point in common.points(steady, dims):
        here = steady.isel(point)
        start = [common.short(steady[name].values[k]) for name, k in point.items()]
        rows.append([*start, *(cell(here) for cell in columns.values())])
    return [Block([*head, *columns], rows)], notes


def of_observables(steady: xr.Dataset, names) -> Columns:
    """A column for each of some observables without dimensions of their own."""

    def cell(name):
        return lambda here: common.estimate(here, name)

    return {common.with_unit(steady, name): cell(name) for name in names}


def of_component(name: str, index) -> Callable[[xr.Dataset], str]:
    """The cell of one component of an observable."""
    return lambda here: common.estimate(here, name, index)


def _of_components(steady: xr.Dataset, dims) -> Columns:
    """The middle of every array, of a scene that has nothing else."""
    columns = {}
    for name in common.names(steady)[:MOST_COLUMNS]:
        own = common.own_dims(steady, name, dims)
        index = tuple(steady.sizes[d] // 2 for d in own)
        where = ", ".join(common.place(steady, d, k) for d, k in zip(own, index, strict=True))
        columns[f"{common.with_unit(steady, name)}, {where}"] = of_component(name, index)
    return columns


def draw(result):
    """Values against time, or of a steady sweep against what was swept; profiles, velocities."""
    dims = common.dimensions(result)
    steady = result.steady
    x = pictures.across(steady, dims) if result.is_steady else ""
    parts = _against_sweep(result, x) if x else _against_time(result)
    parts += _profile_panels(result) + _velocity_panels(result)
    figure, panels = pictures.grid(max(1, len(parts)))
    for panel, part in zip(panels, parts, strict=False):
        part(panel)
    return pictures.finish(figure, panels, common.title(result))


def _against_time(result) -> list[Callable]:
    series, dims = result.series, common.dimensions(result)
    found = [name for name in common.scalars(series, dims) if name not in CLOCKS]
    return [
        lambda panel, name=name: pictures.against_time(panel, result, name)
        for name in found[:MOST_PANELS]
    ]


def _against_sweep(result, x: str) -> list[Callable]:
    steady, dims = result.steady, common.dimensions(result)
    found = common.scalars(steady, dims)[:MOST_COLUMNS]
    return [
        lambda panel, name=name: pictures.against_sweep(panel, steady, dims, x, name)
        for name in found
    ]


def _profile_panels(result) -> list[Callable]:
    """Steady profiles; before that, the last ones."""
    dims = common.dimensions(result)
    data = result.steady if result.is_steady else result.series.isel(sample=-1)
    found = []
    for name in common.names(data):
        own = common.own_dims(data, name, dims)
        if len(own) == 1 and data.sizes[own[0]] > common.FEW:
            found.append(name)
    return [
        lambda panel, name=name: pictures.profile(panel, data, dims, name)
        for name in found[:MOST_PANELS]
    ]


def _velocity_panels(result) -> list[Callable]:
    data = velocities.sampled(result)
    if data is None:
        return []
    found = velocities.kinds(data, common.dimensions(result))
    return [lambda panel, along=along: velocities.draw(panel, result, along) for along in found]
