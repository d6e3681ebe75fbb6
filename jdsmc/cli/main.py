"""The command line: `jdsmc run | sweep | show | plot`."""

import sys
from pathlib import Path

import jax
import numpy as np
import tyro

from .. import sweep as grid
from ..results.result import Result, check_writable, join_gases, load
from ..running.faults import FaultError
from ..running.run import run
from .arguments import Cooling, Fourier, HeatFlux, Numerics, Output, Scene, Shear, Slab, named

PICTURES = (".png", ".pdf", ".svg")
MOST_STEPS = 100_000
"""Longest range taken for meant."""


def run_shear(scene: tyro.conf.OmitArgPrefixes[Shear]) -> None:
    """Simulate one sheared gas and show its steady values with error bars."""
    simulate(scene, sweep=False)


def run_cooling(scene: tyro.conf.OmitArgPrefixes[Cooling]) -> None:
    """Simulate one freely cooling gas: Haff's law, cumulants of its steady distribution."""
    simulate(scene, sweep=False)


def run_heat_flux(scene: tyro.conf.OmitArgPrefixes[HeatFlux]) -> None:
    """Simulate one gas under the heat-flux force: conductivity, Sonine coefficients."""
    simulate(scene, sweep=False)


def run_fourier(scene: tyro.conf.OmitArgPrefixes[Fourier]) -> None:
    """Simulate heat conduction between two walls, under gravity if wanted."""
    simulate(scene, sweep=False)


def run_slab(scene: tyro.conf.OmitArgPrefixes[Slab]) -> None:
    """Simulate one sheared gas in space, between Lees-Edwards planes."""
    simulate(scene, sweep=False)


def sweep_shear(scene: tyro.conf.OmitArgPrefixes[Shear]) -> None:
    """Simulate every combination of the given parameters, in one program for each gas."""
    simulate(scene, sweep=True)


def sweep_cooling(scene: tyro.conf.OmitArgPrefixes[Cooling]) -> None:
    """Simulate freely cooling gases of every given restitution, in one program."""
    simulate(scene, sweep=True)


def sweep_heat_flux(scene: tyro.conf.OmitArgPrefixes[HeatFlux]) -> None:
    """Simulate every combination of the given restitutions and fields, in one program."""
    simulate(scene, sweep=True)


def sweep_fourier(scene: tyro.conf.OmitArgPrefixes[Fourier]) -> None:
    """Simulate every combination of the given wall temperatures, gravities and lengths."""
    simulate(scene, sweep=True)


def sweep_slab(scene: tyro.conf.OmitArgPrefixes[Slab]) -> None:
    """Simulate sheared slabs of every combination of the given parameters."""
    simulate(scene, sweep=True)


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


COMMANDS = {
    "run shear": run_shear,
    "run cooling": run_cooling,
    "run heat-flux": run_heat_flux,
    "run fourier": run_fourier,
    "run sheared-slab": run_slab,
    "sweep shear": sweep_shear,
    "sweep cooling": sweep_cooling,
    "sweep heat-flux": sweep_heat_flux,
    "sweep fourier": sweep_fourier,
    "sweep sheared-slab": sweep_slab,
    "show": show,
    "plot": plot,
}


def join_words(arguments: list[str]) -> list[str]:
    """`run shear ...` names one command: join its words; `run --help` asks for the list."""
    words = [name.split()[0] for name in COMMANDS]
    if " ".join(arguments[:2]) in COMMANDS:
        return [" ".join(arguments[:2]), *arguments[2:]]
    if arguments and arguments[0] in words and arguments[0] not in COMMANDS:
        wanted = [name for name in COMMANDS if name.startswith(arguments[0])]
        if "--help" in arguments or "-h" in arguments:
            return ["--help"]
        raise ValueError(f"`jdsmc {arguments[0]}` needs a scene: {', '.join(wanted)}.")
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


def simulate(arguments: Scene, sweep: bool) -> None:
    """Run every gas of a command, then write and show what there is."""
    output = arguments.output
    if output.out is not None:
        check_writable(output.out)
    if output.plot is not None:
        check_picture(output.plot)
    scenes = _scenes(arguments, sweep)
    results: dict[str, Result] = {}
    try:
        for name, scene in scenes.items():
            if sweep:
                print(f"{name}: {np.prod(grid.flatten(scene)[1], dtype=int)} points")
            results[name] = _run(scene, arguments.numerics)
            if results[name].attrs["stopped"].startswith("interrupted"):
                break
    except FaultError as error:
        if error.result is not None:
            results[name] = error.result
        raise
    finally:
        _keep(results, output, join=sweep and arguments.has_gases)


def _scenes(arguments: Scene, sweep: bool) -> dict:
    """The scene of every gas; only a sweep may have several values of anything."""
    texts = {name: getattr(arguments, name) for name in arguments.swept}
    values = {n: text if named(n, text) else numbers(n, text) for n, text in texts.items()}
    scenes = arguments.scenes(values)
    if not sweep and (len(scenes) > 1 or any(np.ndim(value) for value in values.values())):
        raise ValueError("several values were given; use `jdsmc sweep` for ranges and lists.")
    return scenes


def _run(scene, numerics: Numerics) -> Result:
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


def _keep(results: dict[str, Result], output: Output, join: bool) -> None:
    """Write and show what there is, also after an interruption or a fault."""
    if not results:
        return
    result = join_gases(results) if join else next(iter(results.values()))
    if output.out is not None:
        print(f"Results: {result.save(output.out)}")
    if output.plot is not None:
        _save_picture(result, output.plot)
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
