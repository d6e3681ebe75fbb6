"""All Navier-Stokes coefficients of a granular gas by simulation, from one kick at a time.

A homogeneous cooling gas is displaced a little in velocity space, V -> V + ε G(V), and a flux is
followed while the disturbance dies: its time integral is the coefficient, for any inelasticity.
Method and proofs: docs/impulse_response.md. Theory to compare with: `jdsmc.theory.transport`.
"""

from dataclasses import replace
from math import ceil

import numpy as np
from tqdm import tqdm

from . import check, faults, grid
from .engine import Engine
from .faults import FaultError
from .impulse.integrals import estimates, fourth_cumulant, kick_series
from .impulse.kicks import FIELDS
from .impulse.labels import labelled
from .impulse.response import NavierStokes
from .options import Options
from .pairs import LARGEST_HITS, TYPICAL_MAJORANT, plan_pairs
from .result import Result
from .run import interruptible

HIGHEST_MAJORANT = 9.0
"""Relative speed over v0(T) for which the longest step keeps its length; it reaches 10 at α = 0.3.
"""

WIDEST_MAJORANT = 12.0
"""The same for short steps: waves are made wide enough for it."""

SPARE = 1.25
"""Steps over those that the duration needs: very fast pairs shorten some (α = 0.3 and ε = 0.4 need
1.19)."""


def navier_stokes(
    gas,
    *,
    n_particles: int = 100_000,
    n_realizations: int = 8,
    n_kicks: int = 4,
    kick=0.2,
    duration: float = 15.0,
    seed: int = 0,
    time_step: float = 0.1,
    rtol: float | None = None,
    progress: bool = True,
) -> Result:
    """Thermal conductivities, the coefficient μ of the density gradient, and the viscosity.

    Arguments:
        gas: a gas without drag, `InelasticHardSpheres(restitution)`; an array of restitutions is
            swept in one compiled program.
        n_particles: particles of one realization; see `run`.
        n_realizations: independent realizations, at least 4; error bars come from them.
        n_kicks: kicks of every realization; the most of them if `rtol` is given.
        kick: ε in (0, 1] (1/v0 and, for the shear, 1), or a 1-D array of them. What is nonlinear
            in it biases by a few tenths of ε² (0.5% at 0.2); noise grows as 1/ε.
        duration: reduced time (τ0) for which a kick is followed, in (0, 100]. What is left is
            extrapolated (`conductivity_tail`, ...); noise in κ grows like exp(ζs/2) with it.
        seed: of all random numbers; the same seed gives the same result.
        time_step: largest time step as a fraction of τ(T), in (0, 1]; steps are shortened to
            0.079 and recorded each.
        rtol: stop once the standard errors of κ', κ and η are this share of them at every point.
        progress: show a progress bar.
    Returns:
        `Result` with `conductivity` κ/κ0, `modified_conductivity` κ'/κ0, `density_coefficient`
        nμ/(Tκ0), `viscosity` η/η0 and `a2` of the cooling state, each with an error. Reference
        values: first Sonine approximation of elastic spheres, `jdsmc.theory.transport`.
        `result.series` has against the reduced time: the responses, F, the running integrals.
    Raises:
        ValueError, TypeError: bad input, before anything is computed.
        FaultError: lost collisions or numbers that are not finite; `.result` has the kicks before.
    Ctrl-C ends the run after the present kick and returns what was measured.
    """
    scene = NavierStokes(gas, kick)
    options = _options(n_particles, time_step, duration)
    check.at_least("n_realizations", n_realizations, 4)
    check.at_least("n_kicks", n_kicks, 1)
    check.at_least("seed", seed, 0)
    if rtol is not None:
        check.in_range("rtol", rtol, 0.0, 1.0, low_included=False)
    flat, _ = grid.flatten(scene)
    kicks = Kicks(flat, Engine(flat, n_realizations, seed, options), float(duration))
    attrs = {"seed": seed, "n_realizations": n_realizations, "duration": float(duration)}

    def result(stopped: str) -> Result:
        counted = attrs | {"n_kicks": kicks.count, "stopped": stopped}
        return labelled(scene, options, kicks.times, kicks.means(), counted)

    stopped = ""
    with interruptible() as interrupted, _bar(n_kicks, progress) as bar:
        while not stopped:
            try:
                kicks.advance()
            except FaultError as error:
                error.result = result(f"fault: {error}") if kicks.count else None
                raise
            precision = kicks.precision()
            bar.set_postfix_str(f"±{precision:.2g}", refresh=False)
            bar.update()
            stopped = _ending(kicks, precision, n_kicks, rtol, interrupted.is_set())
    return result(stopped)


class Kicks:
    """A measurement under way: sums over the kicks so far, of every realization."""

    def __init__(self, scene: NavierStokes, engine: Engine, duration: float):
        self.scene, self.engine = scene, engine
        steps = duration / engine.options.time_step
        self.times = np.linspace(0.0, duration, 5 * ceil(steps / 5) + 1)
        self.count = 0
        self.total_accepted = self.total_excess = 0.0
        self._sums: dict[str, np.ndarray] = {}

    def mean_collisions(self) -> np.ndarray:
        """Collisions per particle so far, all copies and the sample together, (1,)."""
        plan, (points, realizations) = self.engine.options.plan, self.engine.shape
        particles = plan.rows * plan.lanes * points * realizations
        return np.array([self.total_accepted / particles])

    def advance(self) -> None:
        """One kick of every realization, its faults checked."""
        record, _ = self.engine.advance()
        self.total_accepted += float(np.sum(record.tally.accepted))
        self.total_excess += float(np.sum(record.tally.excess))
        faults.check(self.scene, self, record)
        if np.min(record.elapsed) < self.times[-1]:
            raise FaultError(
                f"A kick was followed for {np.min(record.elapsed):.3g} τ0 instead of "
                f"{self.times[-1]:g}: pairs much faster than {HIGHEST_MAJORANT:g} v0 shortened "
                "the steps; reduce kick, or give time_step = 0.05."
            )
        new = kick_series(record.moments, np.asarray(self.scene.kick), self.times)
        new["a2"] = fourth_cumulant(record.moments)
        for name, values in new.items():
            self._sums[name] = self._sums.get(name, 0.0) + values
        self.count += 1

    def means(self) -> dict[str, np.ndarray]:
        """Averages over the kicks: arrays (points, realizations, times) and a2."""
        return {name: total / self.count for name, total in self._sums.items()}

    def precision(self) -> float:
        """Largest relative standard error of κ', κ and η at any point."""
        value, error = estimates(self.means())
        return max(float(np.max(error[name] / np.abs(value[name]))) for name in FIELDS)


def _options(n_particles: int, time_step: float, duration: float) -> Options:
    """Waves wide enough for the fastest pairs, and as many steps as the duration needs."""
    check.in_range("duration", duration, 0.0, 100.0, low_included=False)
    options = Options.checked(n_particles, time_step, "strang", "float32", 1, 1)
    step = min(float(time_step), LARGEST_HITS * 2.0**0.5 / HIGHEST_MAJORANT)
    plan = plan_pairs(n_particles, step * WIDEST_MAJORANT / TYPICAL_MAJORANT)
    return replace(options, plan=plan, time_step=step, steps=ceil(SPARE * duration / step) + 1)


def _ending(kicks: Kicks, precision: float, n_kicks: int, rtol, interrupted: bool) -> str:
    """Why to stop now, or an empty string."""
    if rtol is not None and kicks.count > 1 and precision <= rtol:
        return f"all coefficients are known to {precision:.2g} (asked {rtol:g})"
    if kicks.count >= n_kicks:
        asked = "" if rtol is None else f", asked {rtol:g}"
        return f"{n_kicks} kicks were made: all are known to {precision:.2g}{asked}"
    return f"interrupted after {kicks.count} kicks" if interrupted else ""


def _bar(n_kicks: int, show: bool):
    return tqdm(total=n_kicks, desc="kicks", unit="kick", dynamic_ncols=True, disable=not show)
