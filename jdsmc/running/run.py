"""Run a scene: until steady, then until precise; or for a given time."""

import json
from pathlib import Path
from typing import Literal

import jax
import numpy as np

from .. import check, sweep
from ..derivatives.request import Request, requested
from ..derivatives.start import check_fixed_start
from ..results.result import Result
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from ..scenarios.rules import check_methods
from ..types import Whole
from .checkpoint import EVERY, Keeper, check_every
from .going import go_on
from .limits import Limits
from .provenance import specification
from .session import Session

LEAST_REALIZATIONS = 8
"""With four, Student's t decides nothing: a drift of three errors has a significance of 0.06."""

MOST_REALIZATIONS = 2**20
"""Each has its own keys on the host; more would fill its memory before anything is computed."""


def run(
    scene: AbstractScene,
    *,
    n_particles: Whole | None = None,
    n_realizations: Whole = 8,
    seed: Whole = 0,
    duration: float | None = None,
    collisions: float | None = None,
    observable: str | tuple[str, ...] | None = None,
    rtol: float | tuple[float, ...] | None = None,
    budget: float = 5_000.0,
    time_step: float | None = None,
    splitting: Literal["strang", "lie"] = "strang",
    dtype: Literal["float32", "float64"] | type | np.dtype = "float32",
    steps_per_record: Whole | None = None,
    progress: bool = True,
    sensitivity: bool | str | tuple[str, ...] = False,
    checkpoint: str | Path | None = None,
    every: float = EVERY,
) -> Result:
    """Simulate a scene and return labelled results with error bars.

    Without `duration` and `collisions` the run goes on until the gas is steady: for several times
    as long as its slowest relaxation takes, and until nothing that is printed can be off by a good
    part of its error; then until the standard error of `observable` is `rtol` of its value at every
    point of the sweep, or until the budget ends; `result.attrs["stopped"]` says which.

    Arguments:
        scene: a scene, ours or your own; one-dimensional arrays among its numbers are swept (their
            product, in one compiled program).
        n_particles: particles of one realization, at least 64, in a homogeneous gas a number with
            a divisor from 64 to 1024; by default what the scene says, mostly 5120.
        n_realizations: independent realizations, from 8 to 2^20; all error bars come from them.
        seed: of all random numbers; the same seed gives the same result.
        duration: time to simulate (τ0).
        collisions: time to simulate, in accepted collisions per particle.
        observable, rtol: the precision asked for, one number or one for each observable; by
            default of the scene's main observables, and 0.001 for most scenes.
        budget: most collisions per particle to spend; a gas that hardly collides ends after ten
            times the steps that hard spheres would need for them.
        time_step: largest time step in (0, 1], 0.05 for most scenes, as a fraction of τ(T) and of
            the scene's own times (1/shear_rate) in homogeneous gases and sheared slabs, of τ0 in a
            Fourier flow; it is shortened so that no pair is likelier to collide than the pair
            selection allows.
        splitting: "strang" (second order) or "lie" (first order, as in the papers).
        dtype: "float32", or "float64" with JAX's x64 mode enabled.
        steps_per_record: time steps between two measurements, 16 for most scenes.
        progress: show a progress bar.
        sensitivity: names of numbers of gas and scene, or True for all: `result.sensitivity` then
            has the derivatives of what is reported with respect to them (homogeneous gases).
        checkpoint: a file that does not exist yet, in which the run is kept: `jdsmc.resume(file)`
            goes on with it to the bit, after a crash or with other limits.
        every: seconds between two checkpoints; more where writing one takes a hundredth of that.
    Raises:
        ValueError, TypeError: bad input, before anything is computed.
        NotSteadyError: no steady state within the budget; before the run, with `.result` None, if
            the warm-up alone needs more.
        FaultError: lost collisions or numbers that are not finite. Both have `.result`, what was
            measured until then, or None.
        MemoryError: the gases do not fit into the memory of the device.
        FileExistsError: there is a file of the checkpoint's name.
    Ctrl-C, or SIGTERM, ends the run after the present chunk and returns what was measured.
    """
    check_every(every)
    scenes = scenes_of(scene)
    along = duration is not None or collisions is not None
    request = None if sensitivity is False else requested(scene, scenes, sensitivity, along=along)
    options = options_of(scenes, n_particles, time_step, splitting, dtype, steps_per_record)
    n_realizations, seed = repeated(n_realizations, seed)
    scenes = [one.prepared() for one in scenes]
    check_told(scene, scenes[0].axes(options))
    check_methods(scenes[0], options)
    if request is not None and request.sampler.each:
        check_fixed_start(scenes[0], options, request.paths)
    limits = Limits(
        scenes,
        options,
        duration=duration,
        collisions=collisions,
        observable=observable,
        rtol=rtol,
        budget=budget,
    )
    keeper = None
    if checkpoint is not None:
        chosen = {"n_particles": n_particles, "time_step": time_step, "splitting": splitting}
        chosen |= {"dtype": str(options.dtype), "steps_per_record": steps_per_record}
        chosen |= {"n_realizations": n_realizations, "seed": seed, "sensitivity": sensitivity}
        chosen["along"] = along
        keeper = Keeper(checkpoint, every, scene, chosen, new=True)
    return simulate(
        *(scene, scenes, options, limits),
        n_realizations=n_realizations,
        seed=seed,
        progress=progress,
        request=request,
        keeper=keeper,
    )


def repeated(n_realizations, seed) -> tuple[int, int]:
    """The checked number of realizations and seed."""
    low, high = LEAST_REALIZATIONS, MOST_REALIZATIONS
    return check.size("n_realizations", n_realizations, low, high), check.whole("seed", seed, 0)


def check_told(scene: AbstractScene, axes: dict) -> None:
    """Raise for a scene that its result could not tell of: before the run, not at its end."""
    try:
        json.dumps(specification(scene))
    except TypeError as error:
        raise TypeError(
            f"{type(scene).__name__} has a field that a file cannot hold ({error}); fields are "
            "numbers, text, tuples of these, and gases. What a scene does belongs into its methods."
        ) from None
    told = {one.name for one in (*scene.reports, *scene.evolves, *scene.sampled)}
    told |= {"time", "sample", "collisions", "collision_ratio", "realization", *axes}
    twice = sorted(told & set(sweep.dimensions(scene)))
    if twice:
        raise ValueError(
            f"{twice[0]} is swept, and is what {type(scene).__name__} reports, too: a result could "
            "not tell them apart. Give the field of your gas or scene another name, or run its "
            "values one by one."
        )


def scenes_of(scene) -> list[AbstractScene]:
    """The scene at every point of its sweep; TypeError for what is no scene."""
    if isinstance(scene, type) and issubclass(scene, AbstractScene):
        raise TypeError(
            f"scene is the class {scene.__name__}; make one: {scene.__name__}(gas, ...)."
        )
    if not isinstance(scene, AbstractScene):
        raise TypeError(f"scene must be one of jdsmc.scenarios or derive from them, got {scene!r}.")
    check.untraced(type(scene).__name__, jax.tree.leaves(scene))
    return sweep.points(scene)[0]


def options_of(scenes, n_particles, time_step, splitting, dtype, steps_per_record) -> Options:
    """The checked options, as all points of a sweep need them."""
    scene = scenes[0]
    options = Options.checked(
        scene.default_particles() if n_particles is None else n_particles,
        scene.default_time_step if time_step is None else time_step,
        *(splitting, dtype),
        scene.default_steps if steps_per_record is None else steps_per_record,
        samples=scene.samples_per_record,
        in_space=scene.in_space,
    )
    fitted = [one.fit_options(options) for one in scenes]
    if any(other != fitted[0] for other in fitted):
        raise ValueError(
            f"the points of this sweep of {type(scene).__name__} need different sizes of arrays; "
            "run them one by one."
        )
    return fitted[0]


def simulate(
    scene: AbstractScene,
    scenes: list[AbstractScene],
    options: Options,
    limits: Limits,
    *,
    n_realizations: int,
    seed: int,
    progress: bool,
    request: Request | None = None,
    keeper: Keeper | None = None,
) -> Result:
    """Advance until a limit is met, and assemble what was measured; see `run`."""
    limits.check_warm_up()
    session = Session(scenes, n_realizations, seed, options, limits, request)
    attrs = {"seed": seed, "n_realizations": n_realizations}
    return go_on(scene, session, attrs, progress, keeper)
