"""Transport coefficients: limits, identities, and quadrature of the inelastic brackets."""

from math import pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import roots_gegenbauer, roots_genlaguerre

from jdsmc.theory.homogeneous_cooling import cooling_rate, effective_frequency, kurtosis
from jdsmc.theory.transport import (
    elastic_conductivity,
    elastic_sonine_coefficient,
    elastic_viscosity,
    first_sonine,
    modified_first_sonine,
)

APPROXIMATIONS = [first_sonine, modified_first_sonine]
RESTITUTIONS = [0.05, 0.3, 0.5, 0.7, 0.9, 1.0]
# Closed forms and Gauss rules of a few thousand nodes: double rounding, with a margin.
ROUNDING = 1e-12


def colliding_pairs(restitution, dimension):
    """c1, c2 before and c1', c2' after, shape (d, ...), and their weights; d = 2 or 3.

    Gauss rules, exact for the polynomials below: the weights hold the Maxwellians and the rate
    g (g^.sigma^). With c = (C +- w)/sqrt(2), the axes are w^, the rest of C, and in d = 3 a third.
    """
    d = dimension
    centre, centre_weight = roots_genlaguerre(6, d / 2 - 1)
    relative, relative_weight = roots_genlaguerre(6, (d - 1) / 2)
    cosine, cosine_weight = roots_gegenbauer(10, d / 2 - 1)
    # Impact: density cos(theta) sin^{d-2}(theta), uniform in sin^{d-1}(theta).
    node, impact_weight = np.polynomial.legendre.leggauss(10)
    sine = ((1 + node) / 2) ** (1 / (d - 1))
    azimuth = np.array([0, pi]) if d == 2 else 2 * pi * np.arange(8) / 8
    weights = [centre_weight, relative_weight, cosine_weight, impact_weight, np.ones(len(azimuth))]
    weight = np.einsum("a,b,c,d,e->abcde", *weights)
    big, small, mu, sin, turn = np.ix_(np.sqrt(centre), np.sqrt(relative), cosine, sine, azimuth)

    w = on_axes(d, weight.shape, small)
    middle = on_axes(d, weight.shape, big * mu, big * np.sqrt(1 - mu**2))
    normal = on_axes(d, weight.shape, np.sqrt(1 - sin**2), sin * np.cos(turn), sin * np.sin(turn))
    w_after = w - (1 + restitution) * np.sum(w * normal, axis=0) * normal
    pairs = [(middle + sign * v) / sqrt(2) for v in (w, w_after) for sign in (1, -1)]
    return pairs, weight


def on_axes(dimension, shape, *components):
    vector = np.zeros((dimension, *shape))
    for axis, component in zip(range(dimension), components, strict=False):
        vector[axis] = component
    return vector


def second_sonine(square, dimension):
    """L_2^{(d/2-1)}."""
    d = dimension
    return square**2 / 2 - (d + 2) * square / 2 + d * (d + 2) / 8


def heat_flow(c, dimension, shift=0.0):
    """(c^2 - (1 + shift) (d+2)/2) c: S of Eq. (2.26) up to a constant, for shift = 0."""
    return (np.sum(c**2, axis=0) - (1 + shift) * (dimension + 2) / 2) * c


def shear_flow(c, dimension, shift=0.0):
    """The traceless part of c c, shape (d, d, ...)."""
    trace = np.sum(c**2, axis=0) / dimension
    identity = np.eye(dimension).reshape(dimension, dimension, *[1] * trace.ndim)
    return c[:, None] * c[None] - trace * identity


def decay_rate(flow, restitution, dimension, *, modified):
    """nu of Eq. (2.43) with `flow` for S and a trial function, to first order in a2; unit nu0.

    Trial function times f0 of the partner, over the Maxwellians: flow(c2) [1 + a2 L_2(c1^2)], and
    if `modified` with the term a2 L_2(c2^2) and the shift of `heat_flow`. The unit comes from the
    elastic shear flow, where nu_eta = nu0 because eta0 = nT/nu0 is the first approximation.
    """
    return bracket(flow, restitution, dimension, modified) / bracket(
        shear_flow, 1.0, dimension, modified=False, excess=0.0
    )


def bracket(flow, restitution, dimension, modified, excess=None):
    """-int flow . (J[f0, X] + J[X, f0]) / int flow . X, linearised in a2 (in `excess` if given)."""
    d = dimension
    a2 = kurtosis(restitution, d) if excess is None else excess
    (c1, c2, d1, d2), weight = colliding_pairs(restitution, d)
    squares = [np.sum(c**2, axis=0) for c in (c1, c2)]
    change = flow(d1, d) + flow(d2, d) - flow(c1, d) - flow(c2, d)
    tensor_axes = tuple(range(change.ndim - weight.ndim))

    def losses(a2):
        shift = a2 if modified else 0.0
        density = 1 + a2 * second_sonine(squares[0], d)
        if modified:
            density = density + a2 * second_sonine(squares[1], d)
        trial = flow(c2, d, shift)
        return -np.sum(weight * density * np.sum(change * trial, axis=tensor_axes))

    def norm(a2):
        """<flow . X> over the Maxwellian, with the same Gauss rule for one particle."""
        square, square_weight = roots_genlaguerre(8, d / 2 - 1)
        c = on_axes(d, square.shape, np.sqrt(square))
        trial = flow(c, d, a2 if modified else 0.0)
        factor = 1 + a2 * second_sonine(square, d) if modified else 1.0
        product = np.sum(flow(c, d) * trial, axis=tensor_axes)
        return np.sum(square_weight * factor * product)

    step = 1e-3
    slopes = [(f(step) - f(-step)) / (2 * step) for f in (losses, norm)]
    ratio = losses(0.0) / norm(0.0)
    return ratio * (1 + a2 * (slopes[0] / losses(0.0) - slopes[1] / norm(0.0)))


@pytest.mark.parametrize("modified", [False, True])
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("restitution", [0.05, 0.3, 0.5, 0.9, 1.0])
def test_collision_frequencies_agree_with_quadrature(restitution, dimension, modified):
    """nu_kappa and nu_eta recovered from the coefficients, against the five-fold integrals."""
    d = dimension
    approximation = modified_first_sonine if modified else first_sonine
    result = approximation(restitution, d)
    a2 = kurtosis(restitution, d)
    cooling = cooling_rate(restitution, dimension=d) / effective_frequency(d)
    heat = (d - 1) / d * (1 + 2 * a2) / result.conductivity + 2 * cooling
    modified_heat = (d - 1) / d * (1 + 1.5 * a2) / result.modified_conductivity + 1.5 * cooling
    shear = 1 / result.viscosity + cooling / 2
    expected_heat = decay_rate(heat_flow, restitution, d, modified=modified)
    expected_shear = decay_rate(shear_flow, restitution, d, modified=modified)
    # Slopes in a2 are central differences of polynomials of degree 2 over a step of 1e-3, exact
    # but for rounding of 1e-15 / 1e-3, and a sum over 1e5 nodes.
    assert_allclose([heat, modified_heat], expected_heat, rtol=1e-10)
    assert_allclose(shear, expected_shear, rtol=1e-10)


@pytest.mark.parametrize("approximation", APPROXIMATIONS)
@pytest.mark.parametrize("dimension", [2, 3, 4])
def test_elastic_limit(approximation, dimension):
    result = approximation(1.0, dimension)
    assert_allclose(result.conductivity, 1, rtol=ROUNDING)
    assert_allclose(result.modified_conductivity, 1, rtol=ROUNDING)
    assert_allclose(result.viscosity, 1, rtol=ROUNDING)
    assert_allclose(result.density_coefficient, 0, atol=ROUNDING)


@pytest.mark.parametrize("approximation", APPROXIMATIONS)
@pytest.mark.parametrize("dimension", [2, 3])
def test_density_coefficient_solves_its_own_moment_equation(approximation, dimension):
    """(nu - (3/2) zeta) mu = zeta kappa T/n + (d+2)/2 (T^2/m) a2: Eq. (2.29) times S, integrated.

    In it the moment of B (2.21) with S is -d (d+2)/2 n (T^2/m) a2, and both nu are the same.
    """
    d, alpha = dimension, np.array(RESTITUTIONS)
    result = approximation(alpha, d)
    a2 = kurtosis(alpha, d)
    cooling = cooling_rate(alpha, dimension=d) / effective_frequency(d)
    frequency = (d - 1) / d * (1 + 2 * a2) / result.conductivity + 2 * cooling
    # (d+2)/2 T^2/m in units of T kappa0/n: (d-1)/d nu0.
    source = cooling * result.conductivity + (d - 1) / d * a2
    expected = source / (frequency - 1.5 * cooling)
    assert_allclose(result.density_coefficient, expected, rtol=1e3 * ROUNDING, atol=ROUNDING)


@pytest.mark.parametrize("dimension", [2, 3])
def test_approximations_differ_only_by_the_kurtosis(dimension):
    """At alpha^2 = 1/2, a2 = 0."""
    standard, modified = (f(sqrt(0.5), dimension) for f in APPROXIMATIONS)
    for name in ("conductivity", "modified_conductivity", "density_coefficient", "viscosity"):
        assert_allclose(getattr(standard, name), getattr(modified, name), rtol=ROUNDING)


def test_modified_approximation_lowers_the_conductivities_at_strong_dissipation():
    """Where the paper's simulations (Fig. 3) lie far below the standard one: alpha < 0.7."""
    alpha = np.array([0.3, 0.4, 0.5, 0.6])
    standard, modified = (f(alpha) for f in APPROXIMATIONS)
    assert np.all(modified.conductivity < standard.conductivity)
    assert np.all(modified.modified_conductivity < standard.modified_conductivity)


def test_elastic_values_of_spheres():
    """kappa0 = (15/4)(nT/m) tau_eta1 and eta0 = nT tau_eta1, tau_eta1 = 5 sqrt(pi)/8: (2.47)."""
    assert_allclose(elastic_conductivity(), 75 * sqrt(pi) / 64, rtol=ROUNDING)
    assert_allclose(elastic_viscosity(), 5 * sqrt(pi) / 16, rtol=ROUNDING)
    assert_allclose(elastic_sonine_coefficient(), 15 * sqrt(pi) / 16, rtol=ROUNDING)


def test_elastic_prandtl_number():
    """kappa0 m / eta0 = d (d+2) / (2 (d-1)): 15/4 for spheres, 4 for disks."""
    for d, ratio in ((2, 4), (3, 15 / 4)):
        assert_allclose(elastic_conductivity(d) / elastic_viscosity(d), ratio, rtol=ROUNDING)


@pytest.mark.parametrize("approximation", APPROXIMATIONS)
def test_fields_have_the_shape_of_restitution(approximation):
    alpha = np.array([[0.5, 0.9], [0.3, 1.0]])
    together = approximation(alpha)
    assert together.viscosity.shape == (2, 2)
    assert together.conductivity[0, 1] == approximation(0.9).conductivity


@pytest.mark.parametrize("approximation", APPROXIMATIONS)
def test_bad_input_is_refused(approximation):
    for value in (0.0, 1.1, np.nan):
        with pytest.raises(ValueError, match=r"restitution must lie in \(0, 1\]"):
            approximation(value)
    with pytest.raises(ValueError, match="dimension must be an integer >= 2"):
        approximation(0.5, 1)
    for elastic in (elastic_conductivity, elastic_viscosity, elastic_sonine_coefficient):
        with pytest.raises(ValueError, match="dimension must be an integer >= 2"):
            elastic(1)
