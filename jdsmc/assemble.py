"""From the history of a run to a labelled result."""

import itertools
import platform
import subprocess
from importlib import metadata
from pathlib import Path

import equinox as eqx
import jax
import numpy as np
import xarray as xr

from . import grid
from .history import History
from .measure import BIN_WIDTH, bin_centres
from .observables import collisional
from .options import Options
from .result import Result
from .stats import jackknife
from .steady import SteadyTracker

DESCRIPTIONS = {
    "time": ("time", "τ0"),
    "collisions": ("accepted collisions per particle s", "1"),
    "collision_ratio": ("collisions over their local-equilibrium number s/s0", "1"),
    "collision_rate_ratio": ("collision rate over its local-equilibrium value", "1"),
    "temperature": ("temperature T/T0", "1"),
    "mean_temperature": ("temperature T/T0 averaged over the particles", "1"),
    "velocity_x": ("flow velocity u_x", "v0"),
    "velocity_y": ("flow velocity u_y", "v0"),
    "momentum_x": ("momentum density n m u_x", "n̄ m v0"),
    "momentum_y": ("momentum density n m u_y", "n̄ m v0"),
    **{f"stress_{ij}": (f"P_{ij}", "n̄ m v0²") for ij in ("xx", "yy", "zz", "xy")},
    "reduced_shear_rate": ("a* = a τ_η", "1"),
    "shear_stress": ("-P_xy/nT", "1"),
    "normal_stress_xy": ("(P_xx-P_yy)/nT", "1"),
    "normal_stress_zy": ("(P_zz-P_yy)/nT", "1"),
    "pressure_xx": ("P_xx/nT", "1"),
    "pressure_yy": ("P_yy/nT", "1"),
    "pressure_zz": ("P_zz/nT", "1"),
    "pressure_xy": ("P_xy/nT", "1"),
    "reduced_viscosity": ("η* = (-P_xy/nT)/a*", "1"),
    "first_viscometric": ("-Ψ1 = (P_xx-P_yy)/(nT a*²)", "1"),
    "second_viscometric": ("Ψ2 = (P_zz-P_yy)/(nT a*²)", "1"),
    "relative_speed_cubed": ("⟨V12³⟩/⟨V12³⟩0 from random pairs", "1"),
    "relative_speed_cubed_collisional": ("⟨V12³⟩/⟨V12³⟩0 from the energy lost", "1"),
    "time_step": ("mean time step over τ(T)", "1"),
    "a2": ("fourth cumulant", "1"),
    "a3": ("sixth cumulant", "1"),
    "speed_ratio": ("R_l, share of particles in a speed class over the Maxwellian one", "1"),
    "conductivity_ratio": ("modified thermal conductivity κ'/κ0", "1"),
    "sonine": ("Sonine coefficients b'_k, eq. (3.10)", "1"),
    "sonine_marginal": ("Sonine coefficients b'_k, eq. (3.12)", "1"),
    "density": ("density n/n̄", "1"),
    "pressure": ("pressure p", "n̄ m v0²"),
    "heat_flux": ("heat flux q_z", "n̄ m v0³"),
    "mean_heat_flux": ("heat flux averaged over the slab", "n̄ m v0³"),
    "heat_flux_cold_wall": ("heat flux from the energy exchanged at the cold wall", "n̄ m v0³"),
    "heat_flux_hot_wall": ("heat flux from the energy exchanged at the hot wall", "n̄ m v0³"),
    "kappa_star": ("κ* = q/q_NS", "1"),
    "reduced_gradient": ("ε = λ |∂ ln T/∂z|, λ of eq. (5)", "1"),
    "reduced_gravity": ("g* = λ g/(2T/m), λ of eq. (5)", "1"),
    "mean_free_paths": ("mean free paths from the cold wall", "1"),
    "marginal_x": ("g_x^(+)(C_x)", "1"),
    "marginal_y": ("g_y^(+)(C_y)", "1"),
    "speed": ("F(C)", "1"),
}


def assemble(scene, options: Options, history: History, tracker, attrs: dict) -> Result:
    """Everything measured, labelled by the swept dimensions.

    Arguments: the scene as the user made it; the history; the tracker, or None where steady
    values make no sense; attributes that tell how the run ended.
    """
    flat, shape = grid.flatten(scene)
    dims, coords = tuple(grid.dimensions(scene)), grid.dimensions(scene)
    groups = {"/series": _series(flat, shape, dims, coords, history)}
    root = xr.Dataset(coords=coords)
    if tracker is not None and history.length and tracker.all_measuring:
        steady = _steady(flat, history, tracker, options)
        if steady is not None:
            root = _dataset(flat, steady, shape, dims, coords)
            root["steady_from_time"] = dims, _at_start(history, "time", tracker).reshape(shape)
            root["steady_from_collisions"] = (
                dims,
                _at_start(history, "collisions", tracker).reshape(shape),
            )
            labels = (shape, dims, coords)
            if scene.densities:
                groups["/distribution"] = _distribution(
                    scene.densities, history, tracker, options, labels
                )
            if hasattr(scene, "axis"):
                groups["/realizations"] = _realizations(flat, history, tracker, labels)
    root.attrs = provenance(scene, options) | attrs
    groups["/"] = root
    return Result(xr.DataTree.from_dict(groups))


def steady_estimates(scene, history: History, point: int, edges) -> tuple[dict, dict]:
    """Values and standard errors of all observables of one point.

    `edges` is the record to start from, or an array of them: each block between two of them then
    counts as a realization.
    """
    edges = [edges, history.length] if np.ndim(edges) == 0 else edges
    blocks = [history.point(point, a, b) for a, b in itertools.pairwise(edges)]
    means = {name: np.concatenate([b[name] for b in blocks]) for name in blocks[0]}
    one = grid.take(scene, point)
    own = one.observables
    restitution = getattr(one.gas, "restitution", 1.0)
    factor = float(one.gas.local_collision_factor())

    def observables(averages):
        if "T1_steps" not in averages:  # a gas in space has no one temperature
            return own(averages)
        return own(averages) | collisional(averages, restitution, factor)

    return jackknife(means, observables, axis=0)


def _steady(flat, history: History, tracker: SteadyTracker, options: Options):
    """Values and errors of every point; None unless each has at least one whole chunk."""
    points = len(tracker.start)
    if np.any(tracker.start > history.length - options.records):
        return None
    estimates = [steady_estimates(flat, history, p, tracker.start[p]) for p in range(points)]
    names = estimates[0][0]
    return {
        name: tuple(np.array([pair[k][name] for pair in estimates]) for k in (0, 1))
        for name in names
    }


def _series(flat, shape, dims, coords, history: History) -> xr.Dataset:
    time, means = history.on_common_times()
    column = grid.take(flat, (slice(None), None))
    factor = np.asarray(column.gas.local_collision_factor(), dtype=float)

    def observables(averages):
        observed = {
            **column.observables(averages),
            **column.evolution(averages),
            "collisions": averages["collisions"],
        }
        if "local_collisions" in averages:
            with np.errstate(divide="ignore", invalid="ignore"):
                ratio = averages["collisions"] / (factor * averages["local_collisions"])
            observed["collision_ratio"] = ratio
        return observed

    value, error = jackknife(means, observables, axis=1)
    pairs = {name: (value[name], error[name]) for name in value}
    data = _dataset(flat, pairs, shape, (*dims, "sample"), coords)
    return data.assign_coords(
        sample=np.arange(time.shape[1]),
        time=((*dims, "sample"), time.reshape(*shape, -1), _described("time")),
    )


def _distribution(densities, history, tracker, options, labels) -> xr.Dataset:
    """Probability densities from the sampled fractions; `densities` are their norms."""
    shape, dims, coords = labels
    pairs = {}
    for name, norm in densities.items():
        axis = "speed_bin" if name == "speed" else "velocity"
        means = [
            norm / BIN_WIDTH * history.samples(p, first, options.records)[name]
            for p, first in enumerate(tracker.start)
        ]
        value = np.array([np.mean(m, axis=0) for m in means])
        error = np.array([np.std(m, axis=0, ddof=1) / np.sqrt(len(m)) for m in means])
        pairs[name] = (value, error, axis)
    data = xr.Dataset(coords=coords)
    for name, (value, error, axis) in pairs.items():
        for suffix, array in (("", value), ("_error", error)):
            data[name + suffix] = (
                (*dims, axis),
                array.reshape(*shape, -1),
                _described(name + suffix),
            )
    centres = {"velocity": bin_centres(True), "speed_bin": bin_centres(False)}
    return data.assign_coords(
        {axis: values for axis, values in centres.items() if axis in data.dims}
    )


EXTRA_DIMENSIONS = {
    "speed_ratio": ("speed_class",),
    "sonine": ("sonine_order",),
    "sonine_marginal": ("sonine_order",),
}
EXTRA_COORDINATES = {"speed_class": np.arange(4), "sonine_order": np.arange(1, 4)}


def _realizations(flat, history: History, tracker: SteadyTracker, labels) -> xr.Dataset:
    """Steady averages of every realization: what adds up, for error bars of anything else."""
    shape, dims, coords = labels
    means = [history.point(p, first, history.length) for p, first in enumerate(tracker.start)]
    data = xr.Dataset(coords=coords)
    for name in flat.additive:
        array = np.array([point[name] for point in means])
        extra = (flat.axis,) if name in flat.profiles else ()
        data[name] = (
            (*dims, "realization", *extra),
            array.reshape(shape + array.shape[1:]),
            _described(name),
        )
    return data.assign_coords(_axis_coordinate(flat))


def _axis_coordinate(flat) -> dict:
    """Centres of the layers: in λ0, or as a share of the length if that is swept."""
    centres = (np.arange(flat.layers) + 0.5) / flat.layers
    one_length = np.ptp(flat.length) == 0
    values = centres * flat.length[0] if one_length else centres
    unit = "λ0" if one_length else "length of the slab"
    return {flat.axis: (flat.axis, values, {"long_name": f"position {flat.axis}", "units": unit})}


def _dataset(flat, pairs, shape, dims, coords) -> xr.Dataset:
    """Variables `name` and `name_error` from arrays whose first axis is the sweep point."""
    data = xr.Dataset(coords=coords)
    profiles, own = getattr(flat, "profiles", ()), getattr(flat, "descriptions", {})
    for name, arrays in pairs.items():
        extra = (flat.axis,) if name in profiles else EXTRA_DIMENSIONS.get(name, ())
        for suffix, array in zip(("", "_error"), arrays, strict=True):
            full = array.reshape(shape + array.shape[1:])
            described = _described(name + suffix, own)
            data[name + suffix] = ((*dims, *extra), full, described)
    if profiles:
        data = data.assign_coords(_axis_coordinate(flat))
    return data.assign_coords({d: c for d, c in EXTRA_COORDINATES.items() if d in data.dims})


def _described(name: str, own: dict | None = None) -> dict:
    base = name.removesuffix("_error")
    long, unit = (own or {}).get(base) or DESCRIPTIONS.get(base, (base, "1"))
    return {"long_name": f"standard error of {long}" if base != name else long, "units": unit}


def _at_start(history: History, name: str, tracker: SteadyTracker) -> np.ndarray:
    return np.array([np.mean(history[name][p, :, k]) for p, k in enumerate(tracker.start)])


def provenance(scene, options: Options) -> dict:
    """Parameters, options, versions and commit, as attributes of a file."""
    numbers = {
        f"parameter_{name}": value if value.ndim else float(value)
        for name, value in grid.parameters(scene).items()
    }
    names = {
        f"option_{leaf}": str(getattr(scene.gas, leaf))
        for leaf in ("drag", "rate_factor")
        if isinstance(getattr(scene.gas, leaf, None), str)
    }
    return {
        "jdsmc_version": metadata.version("jdsmc"),
        "jax_version": jax.__version__,
        "numpy_version": np.__version__,
        "equinox_version": eqx.__version__,
        "python_version": platform.python_version(),
        "commit": commit(),
        "backend": jax.default_backend(),
        "scene": type(scene).__name__,
        "gas_model": type(scene.gas).__name__,
        **numbers,
        **names,
        **{
            f"option_{n}": getattr(scene, n)
            for n in ("scheme", "wall", "initial_state")
            if hasattr(scene, n)
        },
        **({"layers": scene.layers} if hasattr(scene, "layers") else {}),
        "viscosity_exponent": scene.gas.viscosity_exponent,
        "n_particles": options.n_particles,
        "time_step": options.time_step,
        "steps_per_record": options.steps,
        "splitting": options.splitting,
        "dtype": str(options.dtype),
    }


def commit() -> str:
    """The git commit of the package's checkout, "+" if changed, or "unknown"."""
    folder = Path(__file__).parent

    def git(*arguments):
        return subprocess.run(
            ["git", "-C", str(folder), *arguments],
            capture_output=True,
            text=True,
            check=True,
            timeout=5,
        ).stdout.strip()

    try:
        return git("rev-parse", "HEAD") + ("+" if git("status", "--porcelain", str(folder)) else "")
    except (OSError, subprocess.SubprocessError):
        return "unknown"
