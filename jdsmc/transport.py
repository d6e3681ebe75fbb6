"""All Navier-Stokes coefficients of a granular gas by simulation: at zero field, or from kicks.

`linear_response` disturbs nothing: sampled pairs of a cooling gas give its linearised generator,
of which the coefficients are a solution (`jdsmc.measure.linear_response`). `navier_stokes`: a
homogeneous cooling gas is displaced a little in velocity space, V -> V + ε G(V), and a flux is
followed while the disturbance dies: its time integral is the coefficient, for any inelasticity.
Method and proofs: docs/impulse_response.md. Theory to compare with: `jdsmc.theory.transport`.
"""

from pathlib import Path
from typing import Any

import xarray as xr

from . import check
from .results.result import Result
from .running import checkpoint as checkpoints
from .running.checkpoint import EVERY, Keeper, check_every
from .running.limits import Limits
from .running.resume import from_file
from .running.run import options_of, repeated, run, scenes_of, simulate
from .scenarios.cooling_response import CoolingResponse
from .scenarios.navier_stokes import NavierStokes, duration_for, kick_for
from .scenarios.options import STEPS_PER_RECORD

MOST_KICKS = 10_000


def navier_stokes(
    gas,
    *,
    n_particles: int | None = None,
    n_realizations: int = 8,
    n_kicks: int | None = None,
    kick=None,
    duration: float | None = None,
    seed: int = 0,
    time_step: float = 0.1,
    rtol: float | None = None,
    progress: bool = True,
    checkpoint: str | Path | None = None,
    every: float = EVERY,
) -> Result:
    """Thermal conductivities, the coefficient μ of the density gradient, and the viscosity.

    Arguments:
        gas: a gas without drag, `InelasticHardSpheres(restitution)`; an array of restitutions is
            swept in one compiled program.
        n_particles: particles of one realization; by default 100000, or 20000 with `rtol`.
        n_realizations: independent realizations, at least 8; error bars come from them.
        n_kicks: kicks of every realization, 4 by default; the most of them if `rtol` is given.
        kick: ε in (0, 1] (1/v0 and, for the shear, 1), or a 1-D array of them. What is nonlinear
            in it biases by an eighth of ε² (0.5% at 0.2, the default; with `rtol` at most half of
            that is allowed); noise grows as 1/ε.
        duration: reduced time (τ0) for which a kick is followed, in (0, 100]; by default as long as
            `rtol` needs, 8.4 without it. What is left is extrapolated (`conductivity_tail`, ...);
            noise in κ grows like exp(ζs/2) with it.
        seed: of all random numbers; the same seed gives the same result.
        time_step: largest time step as a fraction of τ(T), in (0, 1]; steps are shortened to
            0.079 and recorded each.
        rtol: stop once the standard errors of κ', κ and η are this share of them at every point.
        progress: show a progress bar.
        checkpoint, every: as of `jdsmc.run`; `jdsmc.transport.resume` goes on.
    Returns:
        `Result` with `conductivity` κ/κ0, `modified_conductivity` κ'/κ0, `density_coefficient`
        nμ/(Tκ0), `viscosity` η/η0 and `a2` of the cooling state, each with an error. Reference
        values: first Sonine approximation of elastic spheres, `jdsmc.theory.transport`. Over `lag`,
        the reduced time after a kick: the responses, F, the running integrals; the same as
        `result.series` over `time`.
    Raises:
        ValueError, TypeError: bad input, before anything is computed.
        FaultError: lost collisions or numbers that are not finite; `.result` has the kicks before.
    Ctrl-C ends the run after the present kick and returns what was measured.
    """
    if rtol is None:
        fitted = (100_000, 4, 0.2, duration_for(NavierStokes.default_rtol))
    else:
        check.scalar("rtol", rtol, 0.0, 1.0)
        fitted = (20_000, MOST_KICKS, kick_for(rtol), duration_for(rtol))
    asked = (n_particles, n_kicks, kick, duration)
    particles, kicks, strength, followed = (
        default if given is None else given for given, default in zip(asked, fitted, strict=True)
    )
    kicks = check.whole("n_kicks", kicks, 1)
    scene = NavierStokes(gas, strength, followed)
    scenes = scenes_of(scene)
    numerics = {"n_particles": particles, "time_step": time_step, "splitting": "strang"}
    numerics |= {"dtype": "float32", "steps_per_record": STEPS_PER_RECORD}
    options = options_of(scenes, **numerics)
    limits = Limits(scenes, options, rtol=rtol or 1e-9, budget=1e12, records=kicks)
    n_realizations, seed = repeated(n_realizations, seed)
    chosen = numerics | {"n_realizations": n_realizations, "seed": seed}
    chosen |= {"sensitivity": False, "along": False}
    check_every(every)
    keeper = None if checkpoint is None else Keeper(checkpoint, every, scene, chosen, new=True)
    return with_lag_as_series(
        simulate(
            *(scene, scenes, options, limits),
            **{"n_realizations": n_realizations, "seed": seed, "progress": progress},
            keeper=keeper,
        )
    )


def resume(
    path: str | Path,
    *,
    n_kicks: int | None = None,
    rtol: float | None = None,
    progress: bool = True,
    every: float = EVERY,
    classes: tuple[type, ...] = (),
) -> Result:
    """Go on with kicks that a checkpoint of `navier_stokes` keeps, to the bit.

    Arguments: the file; kicks of every realization, counted from the first, and `rtol`, as of
    `navier_stokes`: what is not given is as it was (kicks of the same strength); the rest as of
    `jdsmc.resume`.
    Raises ValueError for a file that keeps anything else, and what `jdsmc.resume` raises.
    """
    path = Path(path)
    kept = checkpoints.read(path, classes)
    if kept.limits["records"] is None:
        raise ValueError(f"{path} keeps no kicks of navier_stokes; go on with it by jdsmc.resume.")
    asked: dict[str, Any] = {}
    if rtol is not None:
        check.scalar("rtol", rtol, 0.0, 1.0)
        asked = {"rtol": rtol, "records": MOST_KICKS}
    if n_kicks is not None:
        asked["records"] = check.whole("n_kicks", n_kicks, 1)
    return with_lag_as_series(from_file(path, kept, asked, progress, every))


def linear_response(gas, *, time_step: float = 0.1, **options) -> Result:
    """All Navier-Stokes coefficients from pairs of a cooling gas, at zero field.

    Arguments:
        gas: one of three components without drag whose pair rate is proportional to the relative
            speed, `InelasticHardSpheres(restitution)`; an array of restitutions is swept.
        time_step: largest time step as a fraction of τ(T), in (0, 1].
        options: as of `jdsmc.run`: by default until κ', κ and η are known to 0.5%.
    Returns: `Result` with `conductivity` κ/κ0, `modified_conductivity` κ'/κ0,
        `density_coefficient` nμ/(Tκ0) and `viscosity` η/η0, each with an error and, as
        `conductivity_truncation` ..., the change that the last of four Sonine functions makes.
    Raises TypeError for another gas, and what `jdsmc.run` raises.
    """
    return run(CoolingResponse(gas), time_step=time_step, **options)


def with_lag_as_series(result: Result) -> Result:
    """`result.series` against the time after a kick: what one kick does is the series here."""
    tree = result.to_xarray()
    over_lag = [name for name, values in tree.data_vars.items() if "lag" in values.dims]
    shorter = {name: _without_prefix(str(name)) for name in over_lag}
    series = tree.to_dataset()[over_lag].rename(shorter).rename(lag="time")
    tree["series"] = xr.DataTree(series)
    return Result(tree)


def _without_prefix(name: str) -> str:
    return name.removeprefix("running_").removeprefix("response_")
