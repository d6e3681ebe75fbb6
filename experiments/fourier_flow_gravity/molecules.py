"""Maxwell molecules against eq. (6), derived for them and exact to second order in g.

κ* = 1 + (46/5) ε g* + (24/5 + 503.7 ε²) g*²: exactly 1 at g = 0 in the bulk for any ε. The slab
adds what its walls do, and orders beyond the second.
"""

from jdsmc.gravity_effect import at_equal_gradient, linear_response, means

from jdsmc import Estimate, Result, conduction
from jdsmc.stats import jackknife

FIRST_ORDER = 46.0 / 5.0
WINDOW = 0.3
"""Share of the slab: T² is nearly linear, so that a wide window costs no bias that is seen
(table.md), and the error of the slope falls faster than 1/window."""
WINDOWS = (0.1, 0.2, 0.3)


def second_order(gradient):
    """Coefficient of g*² in eq. (6)."""
    return 24.0 / 5.0 + 503.7 * gradient**2


def prediction(gradient, strength):
    """κ* of eq. (6)."""
    return 1.0 + FIRST_ORDER * gradient * strength + second_order(gradient) * strength**2


def distances(found: dict[str, Estimate]) -> dict[str, float]:
    """κ*(g = 0), B and C of `response`: their distances from eq. (6) in errors."""
    gradient = found["reduced_gradient"].value
    wanted = {"kappa_star": 1.0, "B": FIRST_ORDER, "C": second_order(gradient)}
    return {n: (found[n].value - w) / found[n].error for n, w in wanted.items()}


def response(result: Result, window: float) -> dict[str, Estimate]:
    """B, C and κ* at the point halfway in mean free paths at g = 0, and where ε is the same.

    `window`: of the slope, as a share of the slab.
    """
    return linear_response(result, window * _length(result))


def points(result: Result):
    """ε0, g* and Δκ* with errors, at the points of equal ε."""
    effect = at_equal_gradient(result, WINDOW * _length(result))
    gradient = float(effect["reduced_gradient"].sel(gravity=0.0))
    change = Estimate(effect["kappa_star_change"].values, effect["kappa_star_change_error"].values)
    return gradient, effect["reduced_gravity"].values, change


def profile(result: Result):
    """𝒩/L and κ* with errors of every layer, at g = 0."""
    free = result.to_xarray().indexes["gravity"].get_loc(0.0)
    averages = {name: value[free] for name, value in means(result).items()}
    length, exponent = _length(result), float(result.attrs["viscosity_exponent"])

    def local(one: dict) -> dict:
        profiles = conduction.profiles(one)
        return conduction.reduced(profiles, 0.0, length, exponent, WINDOW * length)

    value, error = jackknife(averages, local, axis=0)
    return value["mean_free_paths"] / length, Estimate(value["kappa_star"], error["kappa_star"])


def _length(result: Result) -> float:
    return float(result.attrs["parameter_length"])
