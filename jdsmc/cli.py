"""The command line: `jdsmc run | sweep | show | plot`."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import jax
import numpy as np
import tyro

from .faults import FaultError
from .gas import RATE_FACTORS, ElasticHardSpheres, InelasticHardSpheres
from .result import Result, check_writable, join_gases, load
from .run import run
from .scenarios import UniformShear

GASES = ("ihs", "ehs", "ehs-measured")
PICTURES = (".png", ".pdf", ".svg")
MOST_STEPS = 100_000
"""Longest range taken for meant."""


@dataclass(frozen=True, kw_only=True)
class Numerics:
    """How a run is made."""

    particles: int = 20_000
    """Particles of one realization (at least 64, with a divisor from 64 to 1024)."""
    realizations: int = 8
    """Independent realizations (at least 4); the error bars come from them."""
    seed: int = 0
    """Seed of all random numbers."""
    duration: float | None = None
    """Time to simulate, in units of tau0; if not given, run until steady and precise."""
    collisions: float | None = None
    """Time to simulate, in accepted collisions per particle."""
    observable: str = "shear_stress"
    """Observable whose precision ends the run."""
    rtol: float = 1e-3
    """Relative standard error asked of that observable (dimensionless)."""
    budget: float = 5_000.0
    """Most collisions per particle to spend."""
    time_step: float = 0.1
    """Largest time step as a fraction of tau(T) and of 1/shear_rate, in (0, 1]."""
    splitting: Literal["strang", "lie"] = "strang"
    """Order of flow and collisions in a step: second order, or first as in the paper."""
    dtype: Literal["float32", "float64"] = "float32"
    """Precision of the velocities."""
    steps_per_record: int = 8
    """Time steps between two measurements."""
    progress: bool = True
    """Show a progress bar."""


@dataclass(frozen=True)
class Shear:
    """Uniform shear flow of a granular gas, or (sweep) many of them.

    Lengths are in mean free paths lambda0, times in tau0 = lambda0/v0, v0 = sqrt(2 T0/m).
    """

    numerics: tyro.conf.OmitArgPrefixes[Numerics]
    restitution: str = "0.9"
    """Coefficient of normal restitution, in (0, 1]. Sweeps take ranges first:last:step and lists
    separated by commas, e.g. 0.5:0.95:0.05 or 0.5,0.7."""
    shear_rate: str = "4"
    """Shear rate a, in units of 1/tau0, at least 0; sweeps take ranges and lists."""
    gas: str = "ihs"
    """Gas: ihs (inelastic hard spheres), ehs (frictional elastic hard spheres), ehs-measured (the
    same with the measured drag); sweeps take a list."""
    rate_factor: str = "linear"
    """Collision rate of the elastic gas over the inelastic one: linear, viscosity, or a number."""
    out: Path | None = None
    """File to write (HDF5); it must not exist."""
    plot: Path | None = None
    """Picture to write (PNG, PDF or SVG)."""


def run_shear(shear: tyro.conf.OmitArgPrefixes[Shear]) -> None:
    """Simulate one sheared gas and show its steady values with error bars."""
    _simulate(shear, sweep=False)


def sweep_shear(shear: tyro.conf.OmitArgPrefixes[Shear]) -> None:
    """Simulate every combination of the given parameters, in one program for each gas."""
    _simulate(shear, sweep=True)


def show(file: tyro.conf.Positional[Path]) -> None:
    """Print the table of a result file."""
    print(load(file).table())


def plot(file: tyro.conf.Positional[Path], out: Path | None = None) -> None:
    """Draw a result file.

    Args:
        file: result file.
        out: picture to write (PNG, PDF or SVG); by default the name of the file with .png.
    """
    result = load(file)
    _save_picture(result, check_picture(out or file.with_suffix(".png")))


COMMANDS = {"run shear": run_shear, "sweep shear": sweep_shear, "show": show, "plot": plot}


def join_words(arguments: list[str]) -> list[str]:
    """`run shear ...` names one command: join its words; `run --help` asks for the list."""
    words = [name.split()[0] for name in COMMANDS]
    if " ".join(arguments[:2]) in COMMANDS:
        return [" ".join(arguments[:2]), *arguments[2:]]
    if arguments and arguments[0] in words and arguments[0] not in COMMANDS:
        wanted = [name for name in COMMANDS if name.startswith(arguments[0])]
        if "--help" in arguments or "-h" in arguments:
            return ["--help"]
        raise ValueError(f"`jdsmc {arguments[0]}` needs a scene: {' or '.join(wanted)}.")
    return arguments


def main(arguments: list[str] | None = None) -> int:
    """Entry point; returns the exit status. Bad input ends with one sentence and status 2."""
    try:
        tyro.extras.subcommand_cli_from_dict(
            COMMANDS,
            prog="jdsmc",
            description="Direct simulation Monte Carlo of granular and molecular gases.",
            args=join_words(sys.argv[1:] if arguments is None else arguments),
        )
    except FaultError as error:
        print(f"jdsmc: {error}", file=sys.stderr)
        return 1
    except (ValueError, TypeError, OSError) as error:
        print(f"jdsmc: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:  # a second Ctrl-C, or one outside a run
        print("jdsmc: interrupted.", file=sys.stderr)
        return 130
    return 0


def _simulate(shear: Shear, sweep: bool) -> None:
    if shear.out is not None:
        check_writable(shear.out)
    if shear.plot is not None:
        check_picture(shear.plot)
    gases = shear.gas.split(",")
    restitution = numbers("restitution", shear.restitution)
    shear_rate = numbers("shear_rate", shear.shear_rate)
    named = shear.rate_factor in RATE_FACTORS
    factor = shear.rate_factor if named else numbers("rate_factor", shear.rate_factor)
    several = [np.ndim(values) for values in (restitution, shear_rate, factor)]
    if not sweep and (len(gases) > 1 or any(several)):
        raise ValueError("several values were given; use `jdsmc sweep` for ranges and lists.")
    scenes = {name: UniformShear(_gas(name, restitution, factor), shear_rate) for name in gases}
    results: dict[str, Result] = {}
    try:
        for name, scene in scenes.items():
            if sweep:
                print(f"{name}: {max(restitution.size, 1) * max(shear_rate.size, 1)} points")
            results[name] = _run(scene, shear.numerics)
            if results[name].attrs["stopped"].startswith("interrupted"):
                break
    except FaultError as error:
        if error.result is not None:
            results[name] = error.result
        raise
    finally:
        _keep(results, shear, sweep)


def _run(scene: UniformShear, numerics: Numerics) -> Result:
    if numerics.dtype == "float64":
        jax.config.update("jax_enable_x64", True)
    return run(
        scene,
        n_particles=numerics.particles,
        n_realizations=numerics.realizations,
        seed=numerics.seed,
        duration=numerics.duration,
        collisions=numerics.collisions,
        observable=numerics.observable,
        rtol=numerics.rtol,
        budget=numerics.budget,
        time_step=numerics.time_step,
        splitting=numerics.splitting,
        dtype=numerics.dtype,
        steps_per_record=numerics.steps_per_record,
        progress=numerics.progress,
    )


def _keep(results: dict[str, Result], shear: Shear, sweep: bool) -> None:
    """Write and show what there is, also after an interruption or a fault."""
    if not results:
        return
    result = join_gases(results) if sweep else next(iter(results.values()))
    if shear.out is not None:
        print(f"Results: {result.save(shear.out)}")
    if shear.plot is not None:
        _save_picture(result, shear.plot)
    print(result.table())


def check_picture(path: Path) -> Path:
    """The path, if a picture may be written there (an older one is replaced)."""
    if path.suffix not in PICTURES:
        raise ValueError(f"the name of a picture ends in {', '.join(PICTURES)}; got {path}.")
    return check_writable(path, overwrite=True)


def _save_picture(result: Result, path: Path) -> None:
    import matplotlib  # noqa: PLC0415 - slow to import

    matplotlib.use("agg")
    result.plot(path)
    print(f"Picture: {path}")


def _gas(name: str, restitution, factor):
    if name not in GASES:
        raise ValueError(f"gas = {name!r} is unknown; choose from {', '.join(GASES)}.")
    if name == "ihs":
        return InelasticHardSpheres(restitution)
    return ElasticHardSpheres(restitution, factor, "measured" if "measured" in name else "local")


def numbers(name: str, text: str) -> np.ndarray:
    """A number, or an array of the ranges first:last:step and comma-separated values in a text."""
    try:
        parts = [_range(part) for part in text.split(",")]
    except ValueError:
        raise ValueError(
            f"{name} = {text!r} is not a number, a range first:last:step, or a list of these."
        ) from None
    values = np.concatenate(parts)
    return values if len(values) > 1 or ":" in text else values.reshape(())


def _range(text: str) -> np.ndarray:
    if ":" not in text:
        return np.array([float(text)])
    first, last, step = (float(x) for x in text.split(":"))
    steps = (last - first) / step if step else np.nan
    if not 0 <= steps < MOST_STEPS:
        raise ValueError
    count = int(steps + 1e-6)  # the last value is met in spite of rounding, and never passed
    return np.round(first + step * np.arange(count + 1), 12)


if __name__ == "__main__":
    sys.exit(main())
