"""Figures 1 to 7, each with the deterministic theory as lines."""

import numpy as np
from scipy.interpolate import make_interp_spline

from jdsmc.theory.closed_langevin import two_moment_limit

from ..case import estimate
from ..numbers import stack
from ..style import COLOURS, legend_of, points
from .claims import enskog
from .data import PAPER, Noise

MARKERS = {"dynamics": "o", "monte_carlo": "s"}
LABELS = {"dynamics": "MD", "monte_carlo": "DSMC"}
SHADES = dict(zip(MARKERS, COLOURS, strict=False))
QUANTITIES = {"viscosity_ratio": r"$\eta/\eta_0$", "noise_viscosity_ratio": r"$\eta_1/\eta_0$"}
LAG = r"$s$ ($\tau_0$)"


def _coarse_label(cell: float, copies: int) -> str:
    return f"{f'{cell:g} a cell' if cell else 'one cell'}, M = {copies}"


def _shades(keys) -> dict:
    """A colour for each; they repeat after five."""
    return {key: COLOURS[i % len(COLOURS)] for i, key in enumerate(keys)}


@PAPER.figure("fig1_temperature", 1, 1, 7.6, 4.6)
def temperature(data: Noise, axes) -> None:
    """Fig. 1: T~ against s for cells and copies, in means over 3 τ0; MD."""
    ax = axes[0, 0]
    runs = {_coarse_label(*row): result for row, result in data.coarse().items()}
    runs["MD"] = data.result("dynamics", *data.studied)
    end = min(float(result.series["time"][-1]) for result in runs.values())
    for number, (label, result) in enumerate(runs.items()):
        time, value = (result.series[name].values for name in ("time", "temperature"))
        each = max(1, round(3.0 / (time[1] - time[0])))
        kept = len(time) // each * each
        coarse = [x[:kept].reshape(-1, each).mean(axis=1) for x in (time, value)]
        colour = "black" if label == "MD" else COLOURS[number % len(COLOURS)]
        line = "-" if number < len(COLOURS) or label == "MD" else "--"
        ax.plot(*coarse, color=colour, lw=1.2, ls=line, label=label)
    ax.axhline(1.0, color="grey", lw=0.8, ls=":", label="dilute theory")
    ax.axhline(enskog(data) ** -2, color="grey", lw=0.8, ls="-.", label=r"$\chi^{-2}$ (Enskog)")
    alpha, number = data.studied
    ax.set(xlabel=LAG, ylabel=r"$\tilde T/T_0$", xlim=(0, end))
    ax.set_title(rf"$\alpha$ = {alpha:g}, N = {number}", fontsize=10)
    ax.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))


def _correlation(ax, result, colour, label: str, marker: str = "o") -> None:
    """C(s) with error bars at every second lag."""
    found = estimate(result.steady, "autocorrelation")
    every_second = slice(None, None, 2)
    lags = result.steady["lag"].values[every_second]
    look = {"color": colour, "label": label, "fmt": marker, "markersize": 4}
    points(ax, lags, found[every_second], **look)


def _exact_correlation(ax, data: Noise, alpha: float, number: int, colour, label="") -> None:
    mode = data.theory(alpha, number)
    lags = np.linspace(0, 4 / mode.decay_rate, 200)
    ax.plot(lags, mode.autocorrelation(lags), color=colour, lw=1.2, label=label or None)


@PAPER.figure("fig2_correlation", 1, 2, 11.0, 4.6)
def correlation(data: Noise, axes) -> None:
    """Fig. 2: C(s) in one cell, in cells and in MD, linear and logarithmic."""
    alpha, number = data.studied
    chosen = {row: r for row, r in data.coarse().items() if row[0] == 0 or row[1] > 1}
    for ax in axes[0]:
        _exact_correlation(ax, data, alpha, number, "black", "theory")
        for (row, result), colour in zip(chosen.items(), COLOURS, strict=False):
            _correlation(ax, result, colour, _coarse_label(*row), "s")
        _correlation(ax, data.result("dynamics", alpha, number), "black", "MD")
        ax.set(xlabel=LAG, xlim=(-0.4, 3.5 / data.theory(alpha, number).decay_rate))
    axes[0, 0].set_ylabel(r"$C(s)$ over $N\tilde T/m$")
    axes[0, 0].legend(fontsize=8)
    axes[0, 1].set(yscale="log", ylim=(0.03, 3))
    axes[0, 0].set_title(rf"$\alpha$ = {alpha:g}, N = {number}", fontsize=10)


@PAPER.figure("fig3_sizes", 1, 1, 6.8, 4.8)
def sizes(data: Noise, axes) -> None:
    """Fig. 3: C(s)/C(0) for several N."""
    ax, alpha = axes[0, 0], data.studied[0]
    shades = _shades(data.numbers("dynamics", alpha))
    for number, colour in shades.items():
        mode = data.theory(alpha, number)
        lags = np.linspace(0, 3 / mode.decay_rate, 200)
        ax.plot(lags, mode.autocorrelation(lags) / mode.amplitude, color=colour, lw=1.2)
        for method, marker in MARKERS.items():
            if number in data.numbers(method, alpha):
                result = data.result(method, alpha, number)
                found = estimate(result.steady, "autocorrelation")
                reduced = (found / float(found.value[0]))[::4]
                shown = {"fmt": marker, "color": colour, "markersize": 4}
                points(ax, result.steady["lag"].values[::4], reduced, **shown)
    ax.set(xlabel=LAG, ylabel=r"$C(s)/C(0)$", yscale="log", ylim=(0.05, 1.3))
    ax.set_title(rf"$\alpha$ = {alpha:g}; line: theory", fontsize=10)
    entries = {f"N = {n}": {"color": c} for n, c in shades.items()}
    entries |= _methods()
    ax.set_xlim(-1, 2.5 / data.theory(alpha, max(shades)).decay_rate)
    ax.legend(handles=legend_of(entries), fontsize=8)


def _methods(shades: dict | None = None) -> dict[str, dict]:
    look = {"color": "black", "ls": "none", "mfc": "none"}
    return {
        LABELS[m]: look | {"marker": marker} | ({"color": shades[m]} if shades else {})
        for m, marker in MARKERS.items()
    }


def _smooth(ax, x, y, **look) -> None:
    """A curve through few exact values."""
    fine = np.linspace(x[0], x[-1], 100)
    curve = make_interp_spline(x, y, k=min(3, len(x) - 1))(fine)
    ax.plot(fine, curve, **{"lw": 1.2} | look)


def _theory_line(data: Noise, ax, alpha: float, name: str) -> None:
    """Exact values against 1000/N, and the straight line through those at the paper's N."""
    first = data.size.numbers[0]
    numbers = first * np.array([30, 10, 5, 3, 2, 1.4, 1])
    exact = [data.limit(alpha, name)]
    exact += [getattr(data.theory(alpha, n), name) for n in numbers]
    _smooth(ax, [0, *(1e3 / numbers)], exact, color="black")
    ax.plot(0, exact[0], "k*", ms=9, mfc="none", clip_on=False)
    stable = np.array(data.stable(alpha))
    line = np.polyfit(1e3 / stable, [getattr(data.theory(alpha, n), name) for n in stable], 1)
    ends = np.array([0, 1e3 / first])
    ax.plot(ends, np.polyval(line, ends), color="grey", ls=":", lw=1.2)


def _line(data: Noise, ax, method: str, alpha: float, name: str, colour) -> None:
    """Straight, through the points, within what the axes show already (parabolas: the table)."""
    first = data.numbers(method, alpha)[0]
    ends = np.array([0.0, 1e3 / first])
    shown = ax.get_ylim()
    fit = data.fit(method, alpha, name, 1)
    if fit:
        start, slope = (float(term.value) for term in fit.terms)
        ax.plot(ends, start + slope * ends * first / 1e3, color=colour, ls="--", lw=0.9)
    ax.set_ylim(shown)


def _against_number(data: Noise, axes, name: str) -> None:
    """A quantity against 1/N: points, their lines, the theory, their limits."""
    alphas = data.restitutions()
    for ax, alpha in zip(axes.flat, alphas, strict=False):
        _theory_line(data, ax, alpha, name)
        run = {m: colour for m, colour in SHADES.items() if alpha in data.restitutions(m)}
        for method, colour in run.items():
            numbers = np.array(data.numbers(method, alpha))
            found = stack(data.value(method, alpha, n, name) for n in numbers)
            points(ax, 1e3 / numbers, found, fmt=MARKERS[method], color=colour)
        for method, colour in run.items():
            _line(data, ax, method, alpha, name, colour)
        ax.set_title(rf"$\alpha$ = {alpha:g}", fontsize=10)
        ax.set(xlabel="1000/N", ylabel=QUANTITIES[name], xlim=(-0.03, None))
    entries = _methods(SHADES) | {
        "theory (star: N → ∞)": {"color": "black"},
        "straight line through its values": {"color": "grey", "ls": ":"},
        "straight line through points": {"color": COLOURS[0], "ls": "--"},
    }
    for ax in list(axes.flat)[len(alphas) :]:
        ax.axis("off")
    axes.flat[-1].legend(handles=legend_of(entries), loc="center")


@PAPER.figure("fig4_viscosity", 2, 3, 11.0, 7.0)
def viscosity(data: Noise, axes) -> None:
    """Fig. 4: η against 1/N."""
    _against_number(data, axes, "viscosity_ratio")


@PAPER.figure("fig5_noise", 2, 3, 11.0, 7.0)
def noise(data: Noise, axes) -> None:
    """Fig. 5: η1 against 1/N."""
    _against_number(data, axes, "noise_viscosity_ratio")


@PAPER.figure("fig6_restitution", 1, 2, 12.0, 4.6)
def restitution(data: Noise, axes) -> None:
    """Fig. 6: η and η1 against α at every N, and for N → ∞ by straight lines."""
    fine = data.lines()
    shades = _shades(sorted({n for a in data.restitutions() for n in data.numbers("dynamics", a)}))
    for ax, (name, symbol) in zip(axes[0], QUANTITIES.items(), strict=True):
        for number, colour in shades.items():
            stable = [a for a in fine if number in data.stable(a)]
            exact = [getattr(data.theory(a, number), name) for a in stable]
            _smooth(ax, stable, exact, color=colour)
        _smooth(ax, fine, [data.limit(a, name) for a in fine], color="black")
        lines = [data.exact_continued(a, name, 1) for a in fine]
        _smooth(ax, fine, lines, color="grey", ls=":")
        for method, shift in (("dynamics", -0.002), ("monte_carlo", 0.002)):
            for alpha in data.restitutions(method):
                numbers = data.numbers(method, alpha)
                found = {shades[n]: data.value(method, alpha, n, name) for n in numbers}
                limit = data.continued(method, alpha, name, 1)
                for colour, one in (found | ({"black": limit} if limit else {})).items():
                    points(ax, alpha + shift, one, fmt=MARKERS[method], color=colour)
        ax.set(xlabel=r"$\alpha$", ylabel=symbol)
    entries = {f"N = {n}": {"color": c} for n, c in shades.items()} | _methods()
    entries["N → ∞ (points:\nstraight lines)"] = {"color": "black"}
    entries["straight line\nthrough theory"] = {"color": "grey", "ls": ":"}
    axes[0, 1].legend(
        handles=legend_of(entries), fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5)
    )


@PAPER.figure("fig7_ratio", 1, 2, 12.0, 4.6, sharey=True)
def ratio(data: Noise, axes) -> None:
    """Fig. 7: η1/η for N → ∞ by straight lines and by the theory; beside the limits."""
    fine, name = data.lines(), "noise_over_viscosity"
    dense = np.linspace(fine[0], 1.0, 100)
    closed = [two_moment_limit(a) for a in dense]
    exact, white = ([data.limit(a, n) for a in fine] for n in (name, f"tail_{name}"))
    lines = [data.ratio_of_lines(a) for a in fine]
    for ax, way in zip(axes[0], ("straight lines", "theory"), strict=True):
        _smooth(ax, fine, exact, color="black")
        _smooth(ax, fine, white, color="black", ls="-.")
        ax.plot(dense, [one.noise_over_viscosity for one in closed], color="grey", lw=1)
        ax.plot(dense, [one.tail_noise_over_viscosity for one in closed], color="grey", ls="-.")
        _smooth(ax, fine, lines, color=COLOURS[2], ls=":")
        for method, colour in SHADES.items():
            for alpha in data.restitutions(method):
                if way == "theory":
                    found = data.by_theory(method, alpha, name)
                else:
                    noise, viscosity = (
                        data.continued(method, alpha, n, 1) for n in reversed(QUANTITIES)
                    )
                    found = noise / viscosity if noise and viscosity else None
                if found:
                    points(ax, alpha, found, fmt=MARKERS[method], color=colour)
        ax.set_title(f"continued to N → ∞ by {way}", fontsize=10)
        ax.set(xlabel=r"$\alpha$", ylabel=r"$\eta_1/\eta$")
    entries = _methods(SHADES) | {
        "theory": {"color": "black"},
        "theory, white noise": {"color": "black", "ls": "-."},
        "two moments": {"color": "grey"},
        "two moments,\nwhite noise": {"color": "grey", "ls": "-."},
        "straight lines\nthrough theory": {"color": COLOURS[2], "ls": ":"},
    }
    axes[0, 1].legend(
        handles=legend_of(entries), fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5)
    )
