"""The section of table.md on the inhomogeneous problem."""

import numpy as np

from jdsmc import Estimate

from .. import markdown
from ..compare import compare
from .claims_slab import CLAIMS, Both
from .data import Measurements, measured_collisions
from .slab import BETA, STARTS, Slabs
from .slab_measured import NUMBERS, TIMES, values

PAPER_RECORD = 0.16
"""The paper records every 160 steps of 0.001 τ(T̄): section IV A."""

LAYER_PARTICLES = 200
"""Particles a layer in the paper."""


def sections(slabs: Slabs, homogeneous: Measurements) -> dict[str, list[str]]:
    """Headings and their lines."""
    ours = values(slabs)
    comparisons = [compare(quoted, ours[quoted.key]) for quoted in NUMBERS]
    both = Both(slabs, homogeneous)
    findings = [(claim, claim.check(both)) for claim in CLAIMS]
    return {
        "Inhomogeneous problem: quoted numbers": [NOTE, "", *markdown.numbers(comparisons)],
        "Inhomogeneous problem: statements": markdown.statements(findings),
        "Inhomogeneous problem: the paper's records": paper_records(slabs),
        "Inhomogeneous problem: steady states": steady_states(slabs, homogeneous),
        "Inhomogeneous problem: simulations": simulations(slabs),
    }


NOTE = (
    "α = 0.9, a τ0 = 4, L = 2.5 λ0, M = 50 layers; from (3.5) and IHS where nothing else is said. "
    "Errors as above; for the place of a maximum, the range within which the curve is two errors "
    "from it; uniform shear is taken as reached when n, T/T̄ and u_x of the top layers are within "
    "5% of it (range: 10% to 3%). What belongs to the homogeneous problem too (T_s and the steady "
    "stresses) is measured here in the slab."
)


def paper_records(slabs: Slabs) -> list[str]:
    """When the paper can have measured, and what s was then."""
    rows = []
    for start, equation in STARTS.items():
        series = slabs.series("early", "ihs", start)
        time, s = series["time"].values, series["collisions"].values
        speed = np.sqrt(series["mean_temperature"].values)
        records = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))])
        for nominal in TIMES:
            place = float(np.interp(nominal, time, records)) / PAPER_RECORD
            cells = []
            for number in (max(1, int(place)), max(1, int(place)) + 1):
                when = float(np.interp(number * PAPER_RECORD, records, time))
                more = float(np.interp(when, time, s))
                high = more * (1.0 + 1.0 / LAYER_PARTICLES)
                cells += [f"{number}", f"{when:.3f}", f"{more:.3f}", f"{high:.3f}"]
            rows.append([equation, f"{nominal:g}", *cells])
    header = ["from", "t quoted", *(2 * ["record", "t", "s", "s with N_I²"])]
    return [
        "The paper records every 160 steps of 0.001 τ(T̄), hence not at the times it quotes. The "
        "two records nearest to each, from our T̄(t), and s there; its eq. (4.13a) draws N_I² "
        f"instead of N_I (N_I - 1) candidates, which makes 1/{LAYER_PARTICLES} more. The second "
        "record from (3.5) is where it places the largest temperature difference.",
        "",
        *markdown.grid(header, rows),
    ]


def steady_states(slabs: Slabs, homogeneous: Measurements) -> list[str]:
    """Slab and homogeneous gas side by side."""
    rows = []
    pairs = (("mean_temperature", "temperature"), ("shear_stress",) * 2, ("normal_stress_xy",) * 2)
    pairs += (("normal_stress_zy",) * 2, ("reduced_shear_rate",) * 2)
    cases = [(gas, f"slab_late_{gas}_equilibrium", gas.upper()) for gas in BETA]
    if "slab_half_step_ihs" in slabs.results:
        cases.append(("ihs", "slab_half_step_ihs", "IHS, half the time step"))
    for gas, case, label in cases:
        flat = homogeneous.steady(gas, 0.9, 4.0)
        for mine, name in pairs:
            value, error = slabs.results[case][mine]
            other, its = float(flat[name]), float(flat[f"{name}_error"])
            score = (value - other) / np.hypot(error, its)
            apart = f"**{score:.1f}**" if abs(score) > 3.0 else f"{score:.1f}"
            texts = str(Estimate(value, error)), str(Estimate(other, its))
            rows.append([label, name, *texts, apart])
    return markdown.grid(["gas", "observable", "slab", "homogeneous", "difference/σ"], rows)


def simulations(slabs: Slabs) -> list[str]:
    """What was run."""
    rows = []
    for name, result in slabs.results.items():
        attrs, series = result.attrs, result.series
        span = f"{measured_collisions(result).item():.0f}" if result.is_steady else ""
        rows.append(
            [
                name,
                f"{attrs['n_particles']} x {attrs['n_realizations']}",
                f"{float(series['time'][-1]):.1f}",
                f"{float(series['collisions'][-1]):.0f}",
                span,
                f"{attrs['seconds']:.0f}",
            ]
        )
    header = ["simulation", "N x realizations", "t/τ0", "s", "collisions averaged", "seconds"]
    return markdown.grid(header, rows)
