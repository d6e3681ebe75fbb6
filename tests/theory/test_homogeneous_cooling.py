"""Cooling state: limits, an independent quadrature of its collision integrals, and Haff's ODE."""

from math import pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp
from scipy.special import gamma, roots_gegenbauer, roots_genlaguerre

from jdsmc.theory.homogeneous_cooling import (
    collision_rate,
    cooling_rate,
    effective_frequency,
    haff_collisions,
    haff_temperature,
    kurtosis,
)

RESTITUTIONS = [0.05, 0.3, 0.5, 0.7, 0.9, 1.0]

# Closed forms of a few dozen operations on numbers of order one: double rounding, with a margin.
ROUNDING = 1e-12
# The integrators' own tolerance is 1e-12 a step, over some hundred steps.
INTEGRATED = 1e-9


def pair_mean(power, excess, dimension):
    """Mean of |c1 - c2|^power with f_M(c1) f_M(c2) [1 + excess (L_2(c1^2) + L_2(c2^2))].

    Gauss rules in C^2, w^2 and the cosine between C and w, where c = (C +- w)/sqrt(2).
    """
    d = dimension
    centre, centre_weight = roots_genlaguerre(6, d / 2 - 1)
    relative, relative_weight = roots_genlaguerre(6, d / 2 - 1 + power / 2)
    cosine, cosine_weight = roots_gegenbauer(6, d / 2 - 1)
    square = (centre[:, None, None] + relative[:, None]) / 2
    overlap = np.sqrt(centre[:, None, None] * relative[:, None]) * cosine
    polynomial = 1 + excess * (
        second_sonine(square + overlap, d) + second_sonine(square - overlap, d)
    )
    total = np.einsum("x,y,z,xyz->", centre_weight, relative_weight, cosine_weight, polynomial)
    return 2 ** (power / 2) * total / gamma(d / 2) ** 2 / cosine_weight.sum()


def second_sonine(square, dimension):
    """L_2^{(d/2-1)}."""
    d = dimension
    return square**2 / 2 - (d + 2) * square / 2 + d * (d + 2) / 8


def test_kurtosis_has_the_papers_special_values():
    assert kurtosis(1.0) == 0
    # Numerator of Eq. (2.16): zero at alpha^2 = 1/2, positive below and negative above.
    assert_allclose(kurtosis(sqrt(0.5)), 0, atol=ROUNDING)
    # Eq. (2.16) by hand: 4 / 80.25 for spheres at alpha = 1/2, 4 / 52.25 for disks.
    assert_allclose(kurtosis(0.5), 4 / 80.25, rtol=ROUNDING)
    assert_allclose(kurtosis(0.5, dimension=2), 4 / 52.25, rtol=ROUNDING)


@pytest.mark.parametrize("dimension", [2, 3, 5])
@pytest.mark.parametrize("restitution", RESTITUTIONS)
def test_cooling_rate_is_the_mean_loss_per_collision(restitution, dimension):
    """zeta = (1 - alpha^2) m g^2/4 a collision (mean over directions), from <V12^3> by quadrature.

    Per particle and time, n sigma^{d-1}/2 <g^3> (1 - alpha^2)/4 times the integral B_3 of
    (g^.sigma^)^3 over the hemisphere; B_n = pi^{(d-1)/2} Gamma((n+1)/2) / Gamma((n+d)/2).
    """
    d = dimension
    density = gamma((d + 1) / 2) / (sqrt(2) * pi ** ((d - 1) / 2))  # n sigma^{d-1}, lambda0 = 1
    cube = pair_mean(3, kurtosis(restitution, d), d)
    integral = pi ** ((d - 1) / 2) / gamma((d + 3) / 2)
    loss = density / 2 * cube * (1 - restitution**2) / 4 * integral
    energy = d / 2 * 0.5  # d T0/2
    assert_allclose(cooling_rate(restitution, dimension=d), loss / energy, rtol=ROUNDING)


@pytest.mark.parametrize("dimension", [2, 3, 5])
@pytest.mark.parametrize("restitution", RESTITUTIONS)
def test_collision_rate_is_that_of_the_mean_relative_speed(restitution, dimension):
    d = dimension
    density = gamma((d + 1) / 2) / (sqrt(2) * pi ** ((d - 1) / 2))
    speed = pair_mean(1, kurtosis(restitution, d), d)
    integral = pi ** ((d - 1) / 2) / gamma((d + 1) / 2)
    expected = density / 2 * speed * integral
    assert_allclose(collision_rate(restitution, dimension=d), expected, rtol=ROUNDING)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("restitution", [0.05, 0.3, 0.5, 0.7, 0.9])
def test_kurtosis_balances_the_fourth_moment(restitution, dimension):
    """mu_4 / (1 + a2) = (d+2) mu_2 to first order in a2, with mu_p by quadrature.

    Loss of c1^4 + c2^4 at a collision: with E = C^2 + w^2 it is (E^2 + 4 (C.w)^2)/2 before and
    after, so that only w^2 and (C.w)^2 change; after it, w' = w - (1+alpha) (w.sigma^) sigma^.
    """
    d = dimension
    rates = np.array([moment_losses(restitution, excess, d) for excess in (0.0, 1.0)])
    second, fourth = rates[0]
    second_slope, fourth_slope = rates[1] - rates[0]  # exactly linear in the excess
    expected = (fourth - (d + 2) * second) / ((d + 2) * second_slope - fourth_slope + fourth)
    # The difference in the numerator is some 100 times smaller than its terms.
    assert_allclose(kurtosis(restitution, d), expected, rtol=100 * ROUNDING)


def moment_losses(restitution, excess, dimension):
    """Losses of c1^2 + c2^2 and of c1^4 + c2^4 per pair, in a common unit; d = 2 or 3."""
    d = dimension
    centre, centre_weight = roots_genlaguerre(6, d / 2 - 1)
    relative, relative_weight = roots_genlaguerre(6, (d - 1) / 2)
    cosine, cosine_weight = roots_gegenbauer(8, d / 2 - 1)
    # Impact: density cos(theta) sin^{d-2}(theta), uniform in u = sin^{d-1}(theta).
    node, impact_weight = np.polynomial.legendre.leggauss(16)
    sine = ((1 + node) / 2) ** (1 / (d - 1))
    azimuth = np.cos(pi * np.arange(2 if d == 2 else 8) / (1 if d == 2 else 4))
    big, small, mu, sin, turn = np.ix_(centre, relative, cosine, sine, azimuth)
    weight = np.einsum(
        "a,b,c,d,e->abcde",
        centre_weight,
        relative_weight,
        cosine_weight,
        impact_weight,
        np.full(len(azimuth), 1 / len(azimuth)),
    )
    cos = np.sqrt(1 - sin**2)
    length = np.sqrt(big * small)
    before = length * mu  # C.w
    along = mu * cos + np.sqrt(1 - mu**2) * sin * turn  # C^.sigma^
    after = before - (1 + restitution) * length * cos * along
    lost = (1 - restitution**2) * small * cos**2  # of w^2
    total = big + small
    fourth = (total**2 + 4 * before**2 - (total - lost) ** 2 - 4 * after**2) / 2
    sonines = second_sonine(total / 2 + before, d) + second_sonine(total / 2 - before, d)
    density = weight * (1 + excess * sonines)
    return np.sum(density * lost), np.sum(density * fourth)


def test_effective_frequency_of_spheres_and_disks():
    """Eq. (2.15): spheres 16 sqrt(pi)/5 n sigma^2 sqrt(T), disks 2 sqrt(pi) n sigma sqrt(T)."""
    assert_allclose(effective_frequency(), 16 * sqrt(pi) / 5 / (sqrt(2) * pi) / sqrt(2))
    assert_allclose(effective_frequency(2), 2 * sqrt(pi) / sqrt(8) / sqrt(2))


def test_spheres_have_the_rates_of_local_equilibrium_but_for_the_kurtosis():
    """2 (1 - alpha^2)/(3 sqrt(pi) tau), 1/(sqrt(pi) tau): Astillero and Santos, (2.16), (3.13)."""
    alpha = np.array(RESTITUTIONS)
    a2 = kurtosis(alpha)
    equilibrium = 2 * (1 - alpha**2) / (3 * sqrt(pi))
    assert_allclose(cooling_rate(alpha), equilibrium * (1 + 3 / 16 * a2), rtol=ROUNDING)
    assert_allclose(collision_rate(alpha), (1 - a2 / 16) / sqrt(pi), rtol=ROUNDING)
    assert_allclose(cooling_rate(alpha, 4.0), 2 * cooling_rate(alpha), rtol=ROUNDING)
    assert_allclose(collision_rate(alpha, 4.0), 2 * collision_rate(alpha), rtol=ROUNDING)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("restitution", [0.3, 0.9, 0.999])
def test_haffs_law_solves_the_cooling_equation(restitution, dimension):
    start, times = 2.0, np.array([0.5, 10.0, 100.0])

    def rates(_, state):
        warmth = state[0]
        return [
            -cooling_rate(restitution, warmth, dimension) * warmth,
            collision_rate(restitution, warmth, dimension),
        ]

    exact = solve_ivp(rates, (0, times[-1]), [start, 0.0], "DOP853", times, rtol=1e-12, atol=1e-14)
    temperature = haff_temperature(times, restitution, start, dimension)
    collisions = haff_collisions(times, restitution, start, dimension)
    assert_allclose(temperature, exact.y[0], rtol=INTEGRATED)
    assert_allclose(collisions, exact.y[1], rtol=INTEGRATED)


def test_collisions_are_the_integral_of_the_rate():
    integral, _ = quad(lambda t: collision_rate(0.5, haff_temperature(t, 0.5)), 0, 30)
    # quad's default tolerance is 1.5e-8.
    assert_allclose(haff_collisions(30.0, 0.5), integral, rtol=1e-7)


def test_elastic_gas_neither_cools_nor_slows():
    times = np.array([0.0, 3.0, 1e6])
    assert np.all(haff_temperature(times, 1.0) == 1)
    assert_allclose(haff_collisions(times, 1.0), times / sqrt(pi), rtol=ROUNDING)
    # ... and is the limit: ln(1 + x)/x = 1 - x/2, with x = 1e-10 t here.
    assert_allclose(haff_collisions(3.0, 1 - 1e-10), 3 / sqrt(pi), rtol=1e-9)


def test_arguments_broadcast():
    times = np.linspace(0, 5, 4)
    alpha = np.array([[0.5], [1.0]])
    for law in (haff_temperature, haff_collisions):
        table = law(times, alpha)
        assert table.shape == (2, 4)
        assert table[0, 2] == law(times[2], 0.5)


@pytest.mark.parametrize("value", [0.0, -0.1, 1.1, np.nan, [0.5, 2.0]])
def test_bad_restitution_is_refused(value):
    for function in (kurtosis, cooling_rate, collision_rate):
        with pytest.raises(ValueError, match=r"restitution must lie in \(0, 1\]"):
            function(value)


def test_other_bad_input_is_refused():
    for dimension in (1, 2.5, "3", None):
        with pytest.raises(ValueError, match="dimension must be an integer >= 2"):
            kurtosis(0.5, dimension)
    for law in (haff_temperature, haff_collisions):
        with pytest.raises(ValueError, match=r"time must lie in \[0, inf\)"):
            law(-1.0, 0.5)
        with pytest.raises(ValueError, match=r"initial_temperature must lie in \(0, inf\)"):
            law(1.0, 0.5, 0.0)
    with pytest.raises(ValueError, match=r"temperature must lie in \(0, inf\)"):
        cooling_rate(0.5, np.inf)
