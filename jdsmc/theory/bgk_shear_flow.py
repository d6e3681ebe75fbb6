r"""Uniform shear flow of the BGK-like model of a granular gas, solved without simulation.

Source: Astillero and Santos, "Uniform shear flow in dissipative gases", whose equation numbers are
cited here. It draws this model as dotted lines but prints no solution; that is derived here. In
the frame that moves with the flow the velocity distribution obeys

    d_t f - a V_y df/dV_x - (zeta/2) d/dV.(V f) = -nu (f - f_0),        nu = beta / tau_eta,

with f_0 the Maxwellian at the temperature T(t), beta = (1 + alpha)/2 (2.21), the local-equilibrium
cooling rate zeta = 2 (1 - alpha^2) / (3 sqrt(pi) tau) (2.16) and tau_eta = 1.016 (5 sqrt(pi)/8) tau
(2.18); tau = lambda / sqrt(2 T/m) (2.12). Its second moments close:

    T'    = -zeta T - (2a/3) P_xy / n
    P_xy' = -a P_yy - (nu + zeta) P_xy
    P_yy' = nu n T - (nu + zeta) P_yy        (and P_zz alike)
    P_xx' = nu n T - (nu + zeta) P_xx - 2 a P_xy

The steady distribution is an average over the age s, the time since a particle's last BGK
collision, of density nu exp(-nu s). The collision left it with a Maxwellian velocity V0, which
shear and drag have turned into V = exp(-zeta s/2) (V0 - a s V0_y x^). Hence

    f(V) = nu int_0^inf ds exp(-nu s + 3 zeta s/2) f_0(exp(zeta s/2) (V + a s V_y x^)).

The steady state depends on alpha only, through z = zeta/nu and e = a/nu, two symbols used all over
this file; in it e^2 = (3z/2)(1 + z)^2. Units: m = lambda0 = v0 = tau0 = 1, T0 = 1/2. Steady
velocity densities are in C = V / sqrt(2T/m) (3.16) and return the shape of their argument `c`.
"""

from dataclasses import dataclass
from math import inf, pi, sqrt

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, erfc, i0e

from ..units import VISCOSITY_TIME

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class TransientShearFlow:
    """Evolution from local equilibrium (3.12); every field has the shape of `time`.

    `time` is in tau0, `temperature` is T/T0, `shear_stress` -P_xy/nT, `normal_stress_xy` and
    `normal_stress_zy` are (P_xx - P_yy)/nT and (P_zz - P_yy)/nT (the latter exactly zero in this
    model), `reduced_shear_rate` is a* = a tau_eta (5.2), `reduced_viscosity` eta* = -P_xy/(nT a*)
    and `collisions` s0 (3.13), the local-equilibrium number of collisions per particle of the
    inelastic gas; the elastic gas with drag (EHS) has beta s0.
    """

    time: Floats
    temperature: Floats
    shear_stress: Floats
    normal_stress_xy: Floats
    normal_stress_zy: Floats
    reduced_shear_rate: Floats
    reduced_viscosity: Floats
    collisions: Floats


@dataclass(frozen=True)
class SteadyShearFlow:
    """Steady state; every field but `temperature` has the shape of `restitution`.

    Fields named as in `TransientShearFlow` mean the same. `first_viscometric` is -Psi_1 =
    (P_xx - P_yy)/(nT a*^2), `second_viscometric` Psi_2 = (P_zz - P_yy)/(nT a*^2), exactly zero in
    this model (both Sec. V C); `a2`, `a3` are the fourth and sixth cumulants (3.14). `temperature`
    has the broadcast shape of restitution and shear rate, and is None without a shear rate.
    """

    restitution: Floats
    temperature: Floats | None
    shear_stress: Floats
    normal_stress_xy: Floats
    normal_stress_zy: Floats
    reduced_shear_rate: Floats
    reduced_viscosity: Floats
    first_viscometric: Floats
    second_viscometric: Floats
    a2: Floats
    a3: Floats


def transient(
    restitution: float, shear_rate: float, times: ArrayLike, initial_temperature: float = 1.0
) -> TransientShearFlow:
    """Evolution of the sheared gas that starts at time 0 in local equilibrium, Eq. (3.12).

    Arguments: `restitution` alpha in (0, 1], at 1 the gas heats up for ever; `shear_rate` a tau0
    > 0; `times` in tau0, shape (k,), >= 0 and strictly increasing to a last one > 0, where 0 need
    not be among them; `initial_temperature` T(0)/T0 > 0.

    Integrates ln T and P_ij/nT (module docstring), with P_zz = P_yy at all times, as at the start.
    """
    alpha = _check_positive("restitution", restitution, up_to=1.0)
    _check_positive("shear_rate", shear_rate)
    _check_positive("initial_temperature", initial_temperature)
    time = np.asarray(times, dtype=np.float64)
    if time.ndim != 1 or time.size == 0 or time[0] < 0 or not np.all(np.diff(time) > 0):
        raise ValueError("times must be a 1-D array of strictly increasing values >= 0.")
    _check_positive("the last of times", time[-1])
    cooling_tau, relaxation_tau = _model_rates(alpha)

    def rates(_: float, state: Floats) -> list[float]:
        log_temperature, shear_stress, pressure_yy, _ = state
        per_tau = np.exp(log_temperature / 2)  # 1/tau(T), Eq. (2.12)
        relaxation = relaxation_tau * per_tau
        heating = 2 / 3 * shear_rate * shear_stress
        return [
            heating - cooling_tau * per_tau,
            shear_rate * pressure_yy - (relaxation + heating) * shear_stress,
            relaxation - (relaxation + heating) * pressure_yy,
            per_tau / sqrt(pi),  # Eq. (3.13)
        ]

    start = [np.log(initial_temperature), 0.0, 1.0, 0.0]
    solution = scipy.integrate.solve_ivp(
        rates, (0.0, time[-1]), start, "LSODA", time, rtol=1e-10, atol=1e-12
    )
    if not solution.success:
        raise RuntimeError(f"The moment equations could not be integrated: {solution.message}")

    log_temperature, shear_stress, pressure_yy, collisions = solution.y
    reduced_shear_rate = shear_rate * VISCOSITY_TIME * np.exp(-log_temperature / 2)
    return TransientShearFlow(
        time=time,
        temperature=np.exp(log_temperature),
        shear_stress=shear_stress,
        normal_stress_xy=3 * (1 - pressure_yy),
        normal_stress_zy=np.zeros_like(time),
        reduced_shear_rate=reduced_shear_rate,
        reduced_viscosity=shear_stress / reduced_shear_rate,
        collisions=collisions,
    )


def steady_state(restitution: ArrayLike, shear_rate: ArrayLike | None = None) -> SteadyShearFlow:
    """Closed forms of the steady state: the moment equations of the module docstring at rest.

    Arguments: `restitution` alpha in (0, 1), any shape; `shear_rate` a tau0 > 0, of a shape that
    broadcasts with `restitution`, needed only for T_s/T0 = (a tau_eta(T0) / a*)^2.
    """
    alpha = _check_positive("restitution", restitution, below=1.0)
    z, e = _steady_ratios(alpha)
    a2, a3 = _cumulants(z, e)
    shear_stress = e / (1 + z) ** 2
    normal_stress_xy = 3 * z / (1 + z)
    reduced_shear_rate = e * (1 + alpha) / 2  # a tau_eta = (a/nu) beta
    temperature = None
    if shear_rate is not None:
        rate = _check_positive("shear_rate", shear_rate)
        temperature = (rate * VISCOSITY_TIME / reduced_shear_rate) ** 2
    return SteadyShearFlow(
        restitution=alpha,
        temperature=temperature,
        shear_stress=shear_stress,
        normal_stress_xy=normal_stress_xy,
        normal_stress_zy=np.zeros_like(z),
        reduced_shear_rate=reduced_shear_rate,
        reduced_viscosity=shear_stress / reduced_shear_rate,
        first_viscometric=normal_stress_xy / reduced_shear_rate**2,
        second_viscometric=np.zeros_like(z),
        a2=a2,
        a3=a3,
    )


def marginal_x(restitution: float, c: ArrayLike) -> Floats:
    """Steady g_x^(+)(C_x), Eq. (3.18): density of C_x of the particles with C_y > 0.

    `restitution` lies in (0, 1); `c`, of any shape, holds C_x. The integral over all C_x is 1/2.
    """
    weight, strain, contraction = _shells(restitution)
    return _half_marginal(weight, strain, np.sqrt((1 + strain**2) / contraction), c)


def marginal_y(restitution: float, c: ArrayLike) -> Floats:
    """Steady g_y^(+)(C_y), Eq. (3.19): density of C_y of the particles with C_x > 0.

    `restitution` lies in (0, 1); `c`, of any shape, holds C_y. The integral over all C_y is 1/2.
    """
    weight, strain, contraction = _shells(restitution)
    return _half_marginal(weight, strain, 1 / np.sqrt(contraction), c)


def speed_distribution(restitution: float, c: ArrayLike) -> Floats:
    """Steady F(C), Eq. (3.20): density of the speed C.

    `restitution` lies in (0, 1); `c`, of any shape, holds C >= 0. The integral over all C is 1.
    """
    speed = np.asarray(c, dtype=np.float64)
    if not np.all(speed >= 0):
        raise ValueError("c must hold speeds >= 0.")
    shells = _shells(restitution)
    return np.reshape([_speed_density(*shells, value) for value in speed.ravel()], speed.shape)


def speed_ratios(restitution: float) -> Floats:
    """Steady R_0, ..., R_3, Eq. (3.15), shape (4,), from F(C); `restitution` alpha in (0, 1).

    R_l is the fraction of particles with l < C < l + 1 (l = 3: C > 3) over that fraction of the
    Maxwellian, known from the function P(x) given below Eq. (4.19).
    """
    node, node_weight = _unit_interval_rule()
    bands = [speed_distribution(restitution, lower + node) @ node_weight for lower in range(3)]
    excess, excess_weight = _half_line_rule()
    tail = speed_distribution(restitution, 3 + excess) @ excess_weight
    edge = np.arange(4.0)
    slower = np.append(erf(edge) - 2 * edge * np.exp(-(edge**2)) / sqrt(pi), 1.0)
    return np.array([*bands, tail]) / np.diff(slower)


def _model_rates(restitution: Floats) -> tuple[Floats, Floats]:
    """zeta tau, Eq. (2.16), and nu tau, Eqs. (2.18) and (2.21)."""
    return 2 * (1 - restitution**2) / (3 * sqrt(pi)), (1 + restitution) / 2 / VISCOSITY_TIME


def _steady_ratios(restitution: Floats) -> tuple[Floats, Floats]:
    """z = zeta/nu and e = a/nu of the steady state, in the shape of `restitution`."""
    cooling_tau, relaxation_tau = _model_rates(restitution)
    z = cooling_tau / relaxation_tau
    return z, np.sqrt(3 * z / 2) * (1 + z)


def _cumulants(z: Floats, e: Floats) -> tuple[Floats, Floats]:
    """a2 and a3, Eq. (3.14), of the steady distribution.

    With b = e x the strain at the age s = x/nu, the Maxwellian means of |V0 - b V0_y x^|^4 and ^6
    are (15 + 14 b^2 + 3 b^4) T^2 and (105 + 189 b^2 + 99 b^4 + 15 b^6) T^3. Their averages over x
    with the weights exp(-x - 2zx) and exp(-x - 3zx) are <V^4> and <V^6>.
    """
    g, h = 1 + 2 * z, 1 + 3 * z
    fourth_moment = 15 / g + 28 * e**2 / g**3 + 72 * e**4 / g**5
    sixth_moment = 105 / h + 378 * e**2 / h**3 + 2376 * e**4 / h**5 + 10800 * e**6 / h**7
    a2 = fourth_moment / 15 - 1
    return a2, -sixth_moment / 105 + 1 + 3 * a2


def _shells(restitution: float) -> tuple[Floats, Floats, Floats]:
    """The steady distribution cut into shells of equal age x = nu s; arrays of shape (k,).

    Returns the fraction of the particles in each shell, exp(-x) dx; their strain since the last
    collision, b = e x; and w = exp(zx), by which drag has divided their squared velocity.
    """
    z, e = _steady_ratios(_check_positive("restitution", restitution, below=1.0))
    age, age_weight = _half_line_rule()
    return age_weight * np.exp(-age), e * age, np.exp(z * age)


def _half_marginal(weight: Floats, strain: Floats, width: Floats, c: ArrayLike) -> Floats:
    """Density of C_x (C_y) times the chance of C_y > 0 (C_x > 0), summed over the shells.

    In a shell both are Gaussian, with variances (1 + b^2)/2w and 1/2w and covariance -b/2w.
    `width`, shape (k,), is the square root of twice the variance of the component in `c`.
    """
    scaled = np.asarray(c, dtype=np.float64)[..., None] / width
    chance = erfc(strain * scaled) / 2
    return (np.exp(-(scaled**2)) / (sqrt(pi) * width) * chance) @ weight


def _speed_density(weight: Floats, strain: Floats, contraction: Floats, speed: float) -> float:
    """F at one speed: the average over directions is done shell by shell.

    There |V0|^2 is a quadratic form in V with the eigenvalues w L, w / L and w, where sqrt(L) =
    (b + sqrt(b^2 + 4))/2. With the polar axis along the first, the azimuth gives a Bessel function
    I_0. Left is the cosine, whose Gaussian factor is cut off at 6 widths (exp(-36) < 1e-15).
    """
    stretch = ((strain + np.sqrt(strain**2 + 4)) / 2) ** 2
    scaled = contraction * speed**2
    spread = scaled * (stretch - 1 / stretch)
    node, node_weight = _unit_interval_rule()
    cutoff = 1 / np.maximum(1, np.sqrt(spread) / 6)
    cosine_squared = (cutoff[:, None] * node) ** 2
    bessel = i0e((scaled * (1 - 1 / stretch) / 2)[:, None] * (1 - cosine_squared))
    direction_mean = cutoff * ((np.exp(-spread[:, None] * cosine_squared) * bessel) @ node_weight)
    shell_density = contraction**1.5 * np.exp(-scaled / stretch) * direction_mean
    return float(4 / sqrt(pi) * speed**2 * (weight @ shell_density))


def _half_line_rule() -> tuple[Floats, Floats]:
    """Nodes and weights, shape (k,), for int_0^inf g(x) dx where g decays like an exponential."""
    step = 1 / 32
    y = np.arange(-3.4, 5.7, step)
    x = np.exp(y - np.exp(-y))  # dense near 0, up to 300 (double-exponential rule)
    return x, step * x * (1 + np.exp(-y))


def _unit_interval_rule() -> tuple[Floats, Floats]:
    """Gauss-Legendre nodes and weights, shape (32,), for int_0^1."""
    node, weight = np.polynomial.legendre.leggauss(32)
    return (1 + node) / 2, weight / 2


def _check_positive(name: str, value: ArrayLike, below: float = inf, up_to: float = inf) -> Floats:
    array = np.asarray(value, dtype=np.float64)
    if not np.all((array > 0) & (array < below) & (array <= up_to)):
        allowed = f"(0, {below:g})" if up_to == inf else f"(0, {up_to:g}]"
        raise ValueError(f"{name} must lie in {allowed}, got {value}.")
    return array
