"""Write docs/observables.md from what the scenes say they report.

Run it as `python docs/make_observables.py` with the library installed. A test compares the page
with what this writes, so that it cannot go stale.
"""

from collections.abc import Iterable
from pathlib import Path

from jdsmc.measure.observable import CLOCKS, Observable
from jdsmc.running.assemble import DEGREES_OF_FREEDOM, STEADY_FROM
from jdsmc.scenarios import SCENES
from jdsmc.scenarios.base import command_of

PAGE = Path(__file__).with_name("observables.md")

HEAD = """\
# Observables

Made by `python docs/make_observables.py` from the scenes themselves. Names in results, files,
pictures and on the command line. Units: see the README; "1" is a pure number. n = 1; averages are
over particles and realizations, sums come first and ratios last. Each name has `<name>_error`, one
standard error; `result[name].interval(0.95)` is an interval that holds the truth with at least that
probability, by Student's t with `degrees_of_freedom`.

A file has steady values at its root, over the swept dimensions (`gas`, `restitution`, ...); time
series in the group `series`; velocity distributions, against C = V/√(2T/m), in `distribution`; in
`realizations` the steady averages of each realization of those observables that add up, and in
`left_out` all of them with one realization left out in turn, from which estimates take their
correlations. Attributes hold all parameters, options, the seed, versions and the commit, and in
`stopped` how the run ended."""

EVERY_RUN = """\
## Every run

Against the number of a sample in `series`, and where the measurement of steady values starts."""

NOTES = {
    "UniformShear": """\
Equations: Astillero and Santos, *Uniform shear flow in dissipative gases* (2005): (2.18), (3.12)
to (3.15), (4.15), (4.16), (4.19), (4.20) and section V C. `marginal_x` and `marginal_y` use both
halves of (5.3): their norm is 1/2. τ_η is that of hard spheres whatever the gas.""",
    "HomogeneousCooling": """\
Steady values are those of the reduced distribution. Its series has the temperature against plain
time (Haff's law) for as long as that is a number of float64; `log_temperature` goes on.""",
    "HeatFluxForce": """\
Equations: Montanero, Santos and Garzó, *First-order Chapman-Enskog velocity distribution function
in a granular gas* (2007). `time` is that of the gas held at T0. Responses depend on the field:
extrapolate to zero. b'_3 needs ⟨V⁷⟩, and the force gives the distribution an algebraic tail: keep
`field` below 0.1. `marginal_x` is the density of C_x (norm 1).""",
    "FourierFlow": """\
Equations: Tahiri, Tij and Santos, *Monte Carlo simulation of a hard-sphere gas in the planar
Fourier flow with a gravity field* (2000): (2), (21) to (25), (28), (29), (32). `z` is the centre of
a layer in λ0, or a share of the length if that is swept. κ* stands on the local slope of T^{1+ω},
κ ∝ T^ω, fitted over one λ0. `jdsmc.results.gravity_effect.at_equal_gradient(result)` takes κ*, g*
and Δκ* at the paper's point z0 from a sweep over gravity. `marginal_z_lower`, `marginal_z_middle`
and `marginal_z_upper` are densities of c_z = v_z over the thermal speed √(2T/m), T that of the
wall, and halfway the one of linear T^{3/2}; their norms are n/n̄ there. q_NS and λ are those of hard
spheres at T_+ whatever the gas: one that collides f times as often has κ* = 1/f.""",
    "CouetteFlow": """\
Measured against published values in [couette_flow.md](couette_flow.md). `z` is the centre of a
layer in λ0, or a share of the length if that is swept. Steady balances, exact:
`heat_flux_lower_wall` - `heat_flux_upper_wall` + `wall_work` + `force_work` = `dissipation`;
without a force, one shear stress in the slab and at both walls, and with it f L n̄ between the
walls. The gas beside a wall slips, so that `heat_flux` there is not that of the wall: it lacks slip
times stress. With `wall_velocity` = 0 it is a Fourier flow that may lose energy, or Poiseuille flow
under a `force`. A run ends by `shear_stress` between walls in motion, else by `mean_velocity` under
a force, else by `dissipation` or the heat flux at the lower wall. `marginal_z_lower` and so on: as
of `FourierFlow`.""",
    "WhiteNoiseThermostat": """\
Van Noije and Ernst, *Velocity distributions in homogeneous granular fluids* (1998). In the steady
state a2 does not depend on the noise, and T follows from it: ξ² = ζT. Held to published values in
[thermostat.md](thermostat.md).""",
    "ShearedSlab": """\
Equations: Astillero and Santos (2005), (4.5) to (4.9): averages over the slab are P̄_ij/n̄T̄; in the
temperature of a layer N - 1 stands for N. `y` is the centre of a layer in λ0, or a share of the
length if that is swept. Distributions are of velocities relative to the flow of their layer, over
the thermal speed of T̄.""",
    "NavierStokes": """\
`jdsmc.transport.navier_stokes`; derivation: [impulse response](impulse_response.md). κ0 and η0:
first Sonine approximation of elastic spheres. Its `result.series` has what is over `lag` against
`time`, without `running_` and `response_` in the names.""",
    "CoolingDisks": """\
Costantini and Puglisi, *Hydrodynamic noise of a cooling gas* (2010), eqs. (6) to (13). Everything
is in the stationary representation: s = ln(1 + μt)/μ, w = v exp(μs).""",
    "MolecularDynamics": """\
As of `CoolingDisks`, the disks moving from event to event.""",
}
"""What a table cannot say, by scene."""


def page() -> str:
    """The whole page."""
    parts = [HEAD, EVERY_RUN, table([*CLOCKS, *STEADY_FROM, DEGREES_OF_FREEDOM])]
    for scene in SCENES:
        parts.append(f"## {scene.__name__} (`jdsmc run {command_of(scene)}`)")
        parts += [NOTES[scene.__name__]] if scene.__name__ in NOTES else []
        parts.append(table(scene.reports))
        for one, title in ((scene.evolves, "In `series` only:"), (scene.sampled, DENSITIES)):
            parts += [title, table(one)] if one else []
    return "\n\n".join(parts) + "\n"


DENSITIES = "In `distribution`, probability densities:"


def table(observables: Iterable[Observable]) -> str:
    """Name, meaning, unit and dimensions beyond the sweep, one a line."""
    rows = ["| name | meaning | unit | dimensions |", "|---|---|---|---|"]
    for one in observables:
        meaning = one.meaning.replace("|", "\\|")
        dims = ", ".join(f"`{name}`" for name in one.dims)
        rows.append(f"| `{one.name}` | {meaning} | {one.unit} | {dims} |")
    return "\n".join(rows)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
