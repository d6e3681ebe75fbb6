"""The tables of table.md that belong to this paper, each as lines of Markdown."""

from jdsmc.theory import langevin

from ..markdown import grid
from .cases import METHODS
from .claims import enskog
from .data import ORDERS, Noise

SYMBOLS = {
    "viscosity_ratio": "η/η0",
    "noise_viscosity_ratio": "η1/η0",
    "noise_over_viscosity": "η1/η",
}
"""What is continued to N -> infinity."""

SEEN = ("mode_amplitude", *SYMBOLS, "tail_noise_over_viscosity")


def values(data: Noise) -> list[str]:
    """Every state: each number with its distance from the exact one."""
    rows = []
    for method, label in METHODS.items():
        for alpha in data.restitutions(method):
            for number in data.numbers(method, alpha):
                exact, result = data.theory(alpha, number), data.result(method, alpha, number)
                cells = [_off(result[n], _exact(exact, n)) for n in SEEN]
                rows.append([label, f"{alpha:g}", number, result["temperature"], *cells])
    header = ["method", "α", "N", "T~/T0", "C(0)", *SYMBOLS.values(), "η1/η (tail)"]
    return grid(header, rows)


def _exact(mode: langevin.TransverseMode, name: str) -> float:
    return getattr(mode, name.removeprefix("mode_"))


def _off(found, exact: float) -> str:
    return f"{found} / {exact:.4f} ({found.distance(exact):+.1f} σ)"


def continuations(data: Noise) -> list[str]:
    """Values at N -> infinity by every way."""
    rows = []
    for name, symbol in SYMBOLS.items():
        for alpha in data.restitutions():
            cells = [f"{data.exact_continued(alpha, name, order):.4f}" for order in ORDERS.values()]
            for method in METHODS:
                if alpha not in data.restitutions(method):
                    cells += ["-"] * (len(ORDERS) + 1)
                    continue
                ways = [data.continued(method, alpha, name, order) for order in ORDERS.values()]
                cells += [str(one) if one else "-" for one in ways]
                cells.append(str(data.by_theory(method, alpha, name)))
            tail = f"tail_{name}" if "noise" in name else ""
            white = f"{data.limit(alpha, tail):.4f}" if tail else "-"
            rows.append([symbol, f"{alpha:g}", f"{data.limit(alpha, name):.4f}", *cells, white])
    ways = [*ORDERS, "theory"]
    header = ["", "α", "exact", *(f"exact, {way}" for way in ORDERS)]
    header += [f"{short}, {way}" for short in ("MD", "DSMC") for way in ways]
    return grid([*header, "white noise"], rows)


def temperatures(data: Noise) -> list[str]:
    """Fig. 1 in numbers."""
    alpha, number = data.studied
    rows = [
        [
            "DSMC",
            f"{cell:g}" if cell else "all (one cell)",
            copies,
            f"{(cell or number) * copies:g}",
            *(result[n] for n in ("temperature", "a2", "collision_rate_ratio")),
        ]
        for (cell, copies), result in data.coarse().items()
    ]
    md = data.result("dynamics", alpha, number)
    rows.append(["MD", "", "", "", *(md[n] for n in ("temperature", "a2", "collision_rate_ratio"))])
    header = ["method", "real a cell", "M", "fictive a cell", "T~/T0", "a2", "collision rate/ω(T~)"]
    return grid(header, rows)


def stability(data: Noise) -> list[str]:
    """The largest stable N."""
    rows = []
    for alpha in (a for a in data.restitutions() if a < 1):
        kinetic, hydro = langevin.stability_limit(alpha), langevin.navier_stokes_limit(alpha)
        density = data.size.density
        rows.append([f"{alpha:g}", f"{kinetic:.3f}", f"{kinetic / density:.0f}", f"{hydro:.3f}"])
    return grid(["α", "N n σ²", "N", "N n σ² of hydrodynamics"], rows)


def chi(data: Noise) -> str:
    """The Enskog factor and what it makes of T~."""
    return f"χ = {enskog(data):.4f}, χ⁻² = {enskog(data) ** -2:.4f}"


def state(data: Noise) -> str:
    """Where the cells are studied."""
    return f"α = {data.studied[0]:g}, N = {data.studied[1]}, n σ² = {data.size.density:g}"
