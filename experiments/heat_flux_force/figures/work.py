"""Error of κ' against work."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, figure
from ..data import Measurements
from ..work import kicks, methods

STYLES = (
    *(("black", "-"), (COLOURS[1], "--"), (COLOURS[2], "--")),
    *((COLOURS[3], "--"), (COLOURS[0], "-")),
)


def work_precision(data: Measurements) -> Figure:
    """Bias and statistical error in quadrature against particle-steps, at α = 0.5."""
    found, axes = figure(1, 1, 7.4, 5)
    ax, effort = axes[0, 0], np.geomspace(1e8, 1e13, 400)
    for method, (colour, line) in zip(methods(data), STYLES, strict=True):
        error = 100 * method.error(effort)
        ax.loglog(effort, error, color=colour, linestyle=line, lw=1.5, label=method.label)
    spent = kicks(data)
    label = "kicks, ε = 0.2 (κ, μ, η too)"
    ax.loglog(spent.work, 100 * spent.error, "^", color=COLOURS[1], mfc="none", label=label)
    ax.axhline(0.3, color="0.6", linewidth=0.8)
    ax.set(
        xlabel="particle-steps, the approach included", ylabel="error of κ' (%)", ylim=(0.05, 10)
    )
    ax.set_title("α = 0.5: bias and one standard error, in quadrature", fontsize=10)
    ax.grid(alpha=0.3, which="both")
    ax.legend(fontsize=8)
    return found
