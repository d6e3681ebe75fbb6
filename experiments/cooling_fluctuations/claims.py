"""The test of every statement of the text (`claims.txt`). The paper has no error bars."""

import numpy as np
from scipy.stats import chi2

from jdsmc import Estimate
from jdsmc.theory.closed_langevin import sonine_kurtosis

from ..claims import Finding, every, percent, positive
from ..numbers import mean
from .data import Noise

FEW_PERCENT = 0.03
"""What "good", "close" and "agree" are taken to allow, at two standard errors."""

UNLIKELY = 0.01
"""Probability of a χ² below which a straight line is refused."""


def _near(found: Estimate, allowed: float = FEW_PERCENT) -> bool | None:
    """Whether a relative deviation is as small as allowed; None if the errors leave it open."""
    size, error = abs(float(found.value)), 2.0 * float(found.error)
    return True if size + error < allowed else (False if size - error > allowed else None)


def _agree(found: list[Estimate]) -> bool | None:
    """Whether numbers that should be 0 are, by their χ²."""
    score = sum((float(one.value) / float(one.error)) ** 2 for one in found)
    return bool(chi2.sf(score, len(found)) > UNLIKELY)


def _temperature(result) -> Estimate:
    return result["temperature"]


def _md(data: Noise, name: str) -> Estimate:
    """Of molecular dynamics at the state whose cells are studied."""
    return data.value("dynamics", *data.studied, name)


def _crowded(data: Noise):
    """Cells with copies as the paper takes them: the smallest cells, some ten copies."""
    found = {row: result for row, result in data.coarse().items() if row[0] and row[1] > 1}
    cell = min(per_cell for per_cell, _ in found)
    ordered = sorted((copies, r) for (per_cell, copies), r in found.items() if per_cell == cell)
    return ordered[0], ordered[-1]


def _one_cell(data: Noise):
    found = sorted((copies, r) for (cell, copies), r in data.coarse().items() if cell == 0)
    return found[0], found[-1]


def steady(data: Noise) -> Finding:
    late = [one.series["temperature"].values for one in data.coarse().values()]
    drift = [abs(t[len(t) // 2 : -len(t) // 4].mean() / t[-len(t) // 4 :].mean() - 1) for t in late]
    reached = all(one.is_steady for one in data.results.values())
    return Finding(
        f"steady in {len(data.results)} of {len(data.results)} runs; third against fourth quarter "
        f"differ by at most {max(drift):.2%} in the runs of Fig. 1",
        reached,
    )


def one_cell(data: Noise) -> Finding:
    ours = _temperature(_one_cell(data)[1][1]) - 1.0
    dynamics = _md(data, "temperature") - 1.0
    text = f"T~/T0 - 1: one cell {percent(ours, 2)}, MD {percent(dynamics, 2)}"
    return Finding(text, every([_near(ours, 0.01), positive(abs(dynamics) - abs(ours))]))


def hot_cells(data: Noise) -> Finding:
    found = {row: _temperature(r) - 1.0 for row, r in data.coarse().items() if row[0]}
    single = {cell: one for (cell, copies), one in found.items() if copies == 1}
    text = "; ".join(f"{cell:g} a cell: {percent(one)}" for cell, one in single.items())
    hottest = single[min(single)]
    return Finding(f"T~/T0 - 1 with M = 1, {text}", positive(hottest - FEW_PERCENT))


def copies_help(data: Noise) -> Finding:
    rows = [(copies, _temperature(r)) for copies, r in _crowded(data)]
    dynamics = _md(data, "temperature")
    apart = rows[-1][1] - dynamics
    text = ", ".join(f"M = {copies}: {t}" for copies, t in rows)
    return Finding(
        f"{text}, MD {dynamics}; the dilute gas has 1, MD the Enskog factor χ⁻² = "
        f"{enskog(data) ** -2:.4f}: DSMC - MD = {percent(apart)}",
        _agree([apart]),
    )


def enskog(data: Noise) -> float:
    """χ of disks at this density."""
    packing = np.pi * data.size.density / 4
    return float((1 - 7 * packing / 16) / (1 - packing) ** 2)


def _lag(result, data: Noise) -> tuple[float, Estimate]:
    """C at the lag nearest to the decay time of the theory."""
    lags = result.steady["lag"].values
    at = int(np.argmin(abs(lags - 1.0 / data.theory(*data.studied).decay_rate)))
    return float(lags[at]), result["autocorrelation"][at]


def _decay(data: Noise, one, other, text: str, allowed: float = 0.1) -> Finding:
    """Two correlations at one decay time, and whether they are as near as allowed."""
    (lag, first), (_, second) = _lag(one, data), _lag(other, data)
    apart = first - second
    return Finding(f"C({lag:.1f} τ0): {text.format(first, second)}", _near(apart, allowed))


def one_cell_decay(data: Noise) -> Finding:
    md = data.result("dynamics", *data.studied)
    found = _decay(data, _one_cell(data)[0][1], md, "one cell {}, MD {}")
    return Finding(found.measured, None if found.holds is None else not found.holds)


def one_cell_copies(data: Noise) -> Finding:
    (few, first), (many, second) = _one_cell(data)
    return _decay(data, first, second, f"M = {few}: {{}}, M = {many}: {{}}")


def cells_decay(data: Noise) -> Finding:
    md = data.result("dynamics", *data.studied)
    copies, ours = _crowded(data)[0]
    return _decay(data, ours, md, f"M = {copies}: {{}}, MD {{}}")


def more_copies(data: Noise) -> Finding:
    (few, first), (many, second) = _crowded(data)
    return _decay(data, first, second, f"M = {few}: {{}}, M = {many}: {{}}")


def every_size(data: Noise) -> Finding:
    pairs = [n for a, n in data.both() if a == data.studied[0]]
    return _compared(data, "mode_decay_rate", [(data.studied[0], n) for n in pairs])


def _compared(data: Noise, name: str, states: list[tuple[float, int]] | None = None) -> Finding:
    """DSMC over MD at every state of both, and whether all are 1."""
    states = states or data.both()
    apart = [
        data.value("monte_carlo", *one, name) / data.value("dynamics", *one, name) - 1.0
        for one in states
    ]
    pairs = zip(states, apart, strict=True)
    text = "; ".join(f"({a:g}, {n}) {percent(one)}" for (a, n), one in pairs)
    return Finding(f"DSMC/MD - 1 at (α, N): {text}", _agree(apart))


def same_viscosity(data: Noise) -> Finding:
    return _compared(data, "viscosity_ratio")


def bending(data: Noise) -> Finding:
    texts, signs = [], []
    for method, label in (("dynamics", "MD"), ("monte_carlo", "DSMC")):
        number = data.numbers(method, 1.0)[0]
        head, tail = (
            data.value(method, 1.0, number, n) for n in ("mode_amplitude", "tail_amplitude")
        )
        texts.append(f"{label} {tail / head}")
        signs.append(positive(tail / head - 1.0))
    exact = data.theory(1.0, data.numbers("dynamics", 1.0)[0])
    text = (
        f"tail over C(0), α = 1, smallest N: {', '.join(texts)}; exact {exact.tail_amplitude:.3f}"
    )
    return Finding(text + "; dC/ds = 0 at s = 0 exactly", every(signs))


def cooling_rate(data: Noise) -> Finding:
    """ζ at the measured T~ over eqs. (12), (13)."""
    alpha, number = data.studied
    dilute = np.sqrt(np.pi) / 4 * (1 - alpha**2) * (1 + 3 * sonine_kurtosis(alpha) / 16)
    texts, signs = [], []
    for method, label in (("dynamics", "MD"), ("monte_carlo", "DSMC")):
        result = data.result(method, alpha, number)
        off = result["cooling_rate"] / (result["temperature"] ** 0.5 * dilute) - 1.0
        texts.append(f"{label} {percent(off, 2)}")
        signs.append(_near(off))
    text = f"ζ(T~) over (12) - 1: {', '.join(texts)}; χ - 1 = {enskog(data) - 1:.2%}"
    return Finding(text, every(signs))


def _linear(data: Noise, name: str) -> Finding:
    """χ² of straight lines; how far exact values are from theirs, at the N of the paper."""
    scores, freedom, bent = 0.0, 0, 0.0
    for method in ("dynamics", "monte_carlo"):
        for alpha in data.restitutions(method):
            fit, number = data.fit(method, alpha, name, 1), len(data.numbers(method, alpha))
            if fit is not None and number > 2:
                scores, freedom = scores + fit.misfit * (number - 2), freedom + number - 2
    for alpha in data.restitutions():
        numbers = np.array(data.stable(alpha), float)
        exact = np.array([getattr(data.theory(alpha, n), name) for n in numbers])
        line = np.polyval(np.polyfit(1 / numbers, exact, 1), 1 / numbers)
        bent = max(bent, float(np.max(abs(line / exact - 1))))
    return Finding(
        f"straight lines through our points: χ² = {scores:.1f} for {freedom} degrees of freedom; "
        f"exact values leave theirs by at most {bent:.1%}: it looks linear, and is not",
        bool(chi2.sf(scores, freedom) > UNLIKELY),
    )


def linear_viscosity(data: Noise) -> Finding:
    return _linear(data, "viscosity_ratio")


def linear_noise(data: Noise) -> Finding:
    return _linear(data, "noise_viscosity_ratio")


def _limits(data: Noise, name: str) -> Finding:
    missed = {
        alpha: data.exact_continued(alpha, name, 1) / data.limit(alpha, name) - 1.0
        for alpha in data.restitutions()
    }
    text = ", ".join(f"α = {alpha:g}: {off:+.1%}" for alpha, off in missed.items())
    return Finding(
        f"a line through the exact values at the paper's N misses the exact limit by {text}",
        max(map(abs, missed.values())) < 0.01,
    )


def viscosity_limit(data: Noise) -> Finding:
    return _limits(data, "viscosity_ratio")


def noise_limit(data: Noise) -> Finding:
    return _limits(data, "noise_viscosity_ratio")


def lower_noise(data: Noise) -> Finding:
    found = _compared(data, "noise_viscosity_ratio")
    name, states = "noise_viscosity_ratio", data.both()
    values = ((data.value(m, *s, name) for m in ("monte_carlo", "dynamics")) for s in states)
    average = mean([ours / md - 1.0 for ours, md in values])
    lower = positive(-average)
    holds = lower if lower is not None else (False if found.holds else None)
    return Finding(f"{found.measured}; mean {percent(average)}", holds)


def violation(data: Noise) -> Finding:
    alpha = data.restitutions("monte_carlo")[0]
    number = data.numbers("monte_carlo", alpha)[-1]
    ours, md = (
        data.value(m, alpha, number, "noise_over_viscosity") for m in ("monte_carlo", "dynamics")
    )
    exact = data.theory(alpha, number).noise_over_viscosity
    text = f"η1/η at α = {alpha:g}, N = {number}: DSMC {ours}, MD {md}, exact {exact:.4f}"
    return Finding(text, positive(ours - 1.0))


def underestimate(data: Noise) -> Finding:
    alpha = data.restitutions("monte_carlo")[0]
    texts, signs = [], []
    for name, symbol in (("viscosity_ratio", "η"), ("noise_viscosity_ratio", "η1")):
        ours = data.continued("monte_carlo", alpha, name, 1)
        md = data.continued("dynamics", alpha, name, 1)
        if ours is None or md is None:
            return Finding("too few N", None)
        exact = data.limit(alpha, name)
        line = data.exact_continued(alpha, name, 1)
        texts.append(
            f"{symbol}/η0: DSMC {ours}, MD {md}, exact values {line:.4f}; exact limit {exact:.4f}"
        )
        signs.append(_agree([ours - md]))
    alike, noise = signs
    text = f"straight lines to N → ∞ at α = {alpha:g}, {'; '.join(texts)}"
    return Finding(text, not noise if alike else None)


def near_white(data: Noise) -> Finding:
    alpha, name = data.restitutions("monte_carlo")[0], "noise_over_viscosity"
    exact, white = (data.limit(alpha, n) for n in (name, f"tail_{name}"))
    ratio = data.ratio_of_lines(alpha)
    ours = data.against_theory("monte_carlo", alpha, name)
    text = (
        f"α = {alpha:g}: exact limit {exact:.3f}, with white noise {white:.3f}; the paper's lines "
        f"through exact values of the dilute gas end at {ratio:.3f}. At finite N DSMC over exact "
        f"is {ours}, MD over exact {data.against_theory('dynamics', alpha, name)}: no whiter noise"
    )
    apart = positive(abs(ours - 1.0) - FEW_PERCENT)
    return Finding(text, None if apart else False)


def copies_noise(data: Noise) -> Finding:
    (few, first), (many, second) = _crowded(data)
    name = "noise_viscosity_ratio"
    text = f"η1/η0 with M = {few}: {first[name]}, M = {many}: {second[name]}"
    exact = data.theory(*data.studied).noise_viscosity_ratio
    text += f", MD {_md(data, name)}, exact {exact:.4f}"
    return Finding(text, positive(second[name] - first[name]))
