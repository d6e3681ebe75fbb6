"""The points of the map: every scene at the edges of what it allows."""

import numpy as np

from jdsmc import ElasticHardSpheres, InelasticHardSpheres, MaxwellMolecules
from jdsmc.scenarios import (
    CoolingDisks,
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    NavierStokes,
    ShearedSlab,
    UniformShear,
)
from jdsmc.units import COOLING, VISCOSITY_TIME

from . import truths
from .judge import Point, Truth

SMALL = {"n_particles": 2560, "rtol": 0.005}
ELASTIC = InelasticHardSpheres(1.0)
RATE = 1.0 / np.sqrt(np.pi)
"""Collisions per particle and τ0 of elastic spheres in equilibrium."""


def restitutions() -> list[Point]:
    """Sheared gases from α = 0.01 to 1 - 1e-7: the energy balance, molecular chaos, and the kinetic
    model near the elastic limit. What needs more than the budget is refused.
    """

    def point(alpha: float, **options) -> Point:
        def found(result):
            own = [truths.balance(result, alpha), truths.chaos(result)]
            return own + ([truths.kinetic_stress(result, alpha)] if alpha > 0.9 else [])

        return Point(
            *("restitution", f"{alpha:.10g}"),
            lambda: UniformShear(InelasticHardSpheres(alpha), 4.0 * np.sqrt(1 - alpha**2)),
            *(SMALL | options, found),
        )

    few = {"n_particles": 256, "rtol": 0.02}
    return [
        *(point(alpha) for alpha in (0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99)),
        *(point(alpha, **few) for alpha in (0.999, 0.9999, 1 - 1e-7)),
    ]


def shear_rates() -> list[Point]:
    """From 1e-10 to 1e6, T_s/T0 from 1e-21 to 1e12: hard spheres have no scale of time, so that all
    have one stress; 6e-3 and 60 are the cold and hot starts of T0/T_s = 1e4 and 1e-4.
    """

    def found(result):
        cubed = truths.balance(result, 0.7)
        return [truths.stress(result), cubed, Truth("a3", *result["a3"], -0.1336, 0.1)]

    rates = (0.0, 1e-10, 1e-6, 6e-3, 0.3, 4.0, 60.0, 1e3, 1e6)
    return [
        Point(
            *("shear rate", f"{rate:g}"),
            lambda rate=rate: UniformShear(InelasticHardSpheres(0.7), rate),
            *(SMALL, found, rate == 0.0 or None),
        )
        for rate in rates
    ]


def steps_and_sizes() -> list[Point]:
    """Time steps up to τ(T), which the pair selection shortens; N from 64, whose 1/N shows, on."""
    scene = UniformShear(InelasticHardSpheres(0.7), 4.0)
    steps = [
        Point(
            *("time step", f"{step:g}"),
            *(lambda: scene, SMALL | {"time_step": step}),
            lambda result: [truths.stress(result, 0.01), truths.balance(result, 0.7)],
        )
        for step in (0.01, 0.05, 0.2, 0.5, 1.0)
    ]
    sizes = [
        Point(
            *("particles", f"{size:g}"),
            *(lambda: scene, {"n_particles": size, "rtol": 0.01, "budget": 2000.0}),
            lambda result, size=size: [truths.stress(result, 0.01 + 3 / size)],
            size < 64 or None,
        )
        for size in (32, 64, 97, 256, 20_000)
    ]
    many = {"n_particles": 1_000_000, "collisions": 0.6, "steps_per_record": 1}
    still = Point(
        *("particles", "1e+06"),
        *(lambda: HomogeneousCooling(ELASTIC), many),
        lambda result: [
            truths.at_rest(result, "temperature", 1.0, 1e-4),
            truths.at_rest(result, "collision_ratio", 1.0, 1e-3),
        ],
    )
    return [*steps, *sizes, still]


def frictional() -> list[Point]:
    """Rate factors from 0.01 to 2 at one x = d(1-α²)/β, that of α = 0.9: only it matters.

    And the shear supplies what the drag takes, exactly: (2/3) Π aτ = 2d(1-α²)/3√π.
    """

    def point(beta: float) -> Point:
        def scene():
            gas = ElasticHardSpheres(0.9, rate_factor=beta, drag_factor=beta)
            return UniformShear(gas, 4.0 * beta)

        def found(result):
            stress, error = result["shear_stress"]
            supplied = (2 / 3) * stress * result["reduced_shear_rate"].value / VISCOSITY_TIME
            taken = COOLING * (1 - 0.9**2) * beta
            return [
                Truth("shear_stress", stress, error, STRESS_OF_X, 0.005),
                Truth("heating over drag", supplied / taken, 2 * error / stress, 1.0, 0.01),
            ]

        rtol = 0.02 if beta < 0.1 else 0.005  # hundred times the steps for a collision
        return Point("rate factor", f"{beta:g}", scene, SMALL | {"rtol": rtol}, found)

    return [point(beta) for beta in (0.01, 0.1, 0.5, 1.0, 2.0)]


STRESS_OF_X = 0.3184
"""-P_xy/nT of elastic spheres with x = 0.19: the mean of all five, ± 0.0004."""


def long_coolings() -> list[Point]:
    """1e4 collisions per particle: T/T0 down to e^{-6300}, times up to e^{3100} τ0."""
    return [
        Point(
            *("cooling", f"α = {alpha:g}, s = {collisions:g}"),
            lambda alpha=alpha: HomogeneousCooling(InelasticHardSpheres(alpha)),
            {"n_particles": 256, "collisions": float(collisions)},
            lambda result, alpha=alpha: truths.cooling(result, alpha),
        )
        for alpha, collisions in ((0.1, 300), (0.3, 1e4), (0.9, 2e3), (0.9999, 300))
    ]


def fields() -> list[Point]:
    """Heat-flux fields up to where they run away: κ' of the Boltzmann equation while it is linear.

    Beyond, no value is known: they must be refused, or keep to the sign and size of κ'.
    """

    def point(field: float) -> Point:
        def found(result):
            if field < 0.05:
                return [truths.conductivity(result, 0.7)]
            known = truths.conductivity(result, 0.7)
            return [known._replace(tolerance=0.5)]

        return Point(
            *("heat-flux field", f"{field:g}"),
            lambda: HeatFluxForce(InelasticHardSpheres(0.7), field),
            {"n_particles": 20_480, "rtol": 0.02, "budget": 400.0},
            *(found, field > 1.0 or field == 0.0 or None),
        )

    return [point(field) for field in (0.0, 0.03, 0.1, 0.3, 0.6, 2.0)]


def walls() -> list[Point]:
    """Slabs between walls: thin and thick, cold and equal, under strong gravity, of few layers."""
    few = {"n_particles": 2000, "rtol": 0.01, "budget": 1000.0}

    def flow(*numbers, **more):
        return lambda: FourierFlow(ELASTIC, *numbers, **more)

    lengths = [
        Point(
            *("wall distance", f"{length:g}"),
            flow(0.2, 0.0, length),
            few | {"time_step": min(0.05, length / 8), "n_particles": 2000 if length < 9 else None},
            lambda result, length=length: [
                *truths.fluxes(result),
                truths.free_molecular(result, 0.2, 0.05)
                if length < 0.1
                else truths.fourier(result, 0.2, length, 0.02 + 0.3 / length),
            ],
        )
        for length in (0.05, 2.0, 5.0, 200.0)
    ]
    cold = [
        Point(
            *("cold wall", f"{cold:g}"),
            *(flow(cold, 0.0, 2.0), few, truths.fluxes),
        )
        for cold in (0.001, 0.01, 0.99)
    ]
    bgk = [
        Point(
            *("type II walls", f"T = {cold:g}, L = {length:g}"),
            flow(cold, 0.0, length, wall="bgk", layers=20),
            few | {"time_step": min(0.05, length / 8), "rtol": 0.02},
            *(truths.fluxes, refuses),
        )
        for cold, length, refuses in ((0.05, 0.1, True), (0.001, 5.0, True), (0.3, 2.0, False))
    ]
    equal = Point(
        *("type II walls", "T = 1, L = 2"),
        flow(1.0, 0.0, 2.0, wall="bgk", layers=4),
        {"n_particles": 1000, "duration": 60.0, "steps_per_record": 2},
        lambda result: [truths.at_rest(result, "temperature", 1.0, 5e-3)],
    )
    gravity = [
        Point(
            *("gravity", f"{pull:g}"),
            flow(1.0, pull, 2.0, layers=20),
            {"n_particles": 1000, "duration": 100.0, "time_step": 0.02},
            lambda result, pull=pull: [barometric(result, pull)],
        )
        for pull in (-1.0, 1.0)
    ]
    wide = [
        Point(
            *("layer width", f"{4.0 / layers:g}"),
            flow(0.2, 0.0, 4.0, layers=layers),
            {"n_particles": max(2000, 10 * layers), "rtol": 0.005},
            truths.fluxes,
        )
        for layers in (2, 4, 8, 40, 200)
    ]
    return [*lengths, *cold, *bgk, equal, *gravity, *wide]


def barometric(result, pull: float) -> Truth:
    """Mean height of exp(-2gz) over L = 2, which T0 everywhere gives, from the density."""
    weight = 2 * abs(pull)
    height = 1 / weight - 2 * np.exp(-2 * weight) / (1 - np.exp(-2 * weight))
    density = result.series["density"].values
    half = density[len(density) // 2 :]
    z = result.series["z"].values if pull > 0 else 2.0 - result.series["z"].values
    each = np.sum(half * z, axis=1) / np.sum(half, axis=1)
    blocks = each[: len(each) // 8 * 8].reshape(8, -1).mean(axis=1)
    error = float(np.std(blocks, ddof=1) / np.sqrt(8))
    return Truth("mean height", float(np.mean(blocks)), error, height, 0.01)


def slabs() -> list[Point]:
    """Few particles in a layer, and slabs in which uniform shear is unstable."""
    few = [
        Point(
            *("particles a layer", f"{each:g}"),
            lambda: ShearedSlab(ELASTIC, 0.0, layers=32),
            {"n_particles": 32 * each, "duration": 200.0},
            lambda result, each=each: [
                truths.at_rest(result, "mean_temperature", 32 * each / (32 * each - 1), 2e-3),
                truths.at_rest(result, "collision_ratio", 1.0, 0.01),
            ],
            each == 1 or None,
        )
        for each in (1, 2, 3, 5, 10)
    ]
    long = [
        Point(
            *("sheared slab length", f"{length:g}"),
            lambda length=length: ShearedSlab(
                InelasticHardSpheres(0.7), 4.0, length, layers=max(10, int(4 * length))
            ),
            {"n_particles": max(500, int(160 * length)), "rtol": 0.01, "budget": 300.0},
            lambda result: [truths.stress(result, 0.02)],
        )
        for length in (0.1, 2.5, 40.0)
    ]
    return [*few, *long]


def maxwell_molecules() -> list[Point]:
    """Molecules without a scale of speed of their own, in every scene."""
    gas = MaxwellMolecules()
    still = {"n_particles": 2560, "duration": 10.0}
    refused = [
        Point("Maxwell molecules", name, make, {}, lambda result: [], True)
        for name, make in (
            ("HeatFluxForce", lambda: HeatFluxForce(gas, 0.1)),
            ("CoolingDisks", lambda: CoolingDisks(gas)),
            ("NavierStokes", lambda: NavierStokes(gas)),
        )
    ]
    return [
        Point(
            *("Maxwell molecules", "HomogeneousCooling"),
            *(lambda: HomogeneousCooling(gas), still),
            lambda result: [truths.at_rest(result, "temperature", 1.0, 1e-4)],
        ),
        Point(
            *("Maxwell molecules", "UniformShear"),
            lambda: UniformShear(gas, 1.0),
            {"n_particles": 20_480, "duration": 4.0},
            lambda result: [sheared_molecules(result, 1.0)],
        ),
        Point(
            *("Maxwell molecules", "ShearedSlab"),
            lambda: ShearedSlab(gas, 0.0, layers=10),
            *({"n_particles": 1000, "duration": 60.0},),
            lambda result: [truths.at_rest(result, "mean_temperature", 1000 / 999, 1e-3)],
        ),
        Point(
            *("Maxwell molecules", "FourierFlow"),
            lambda: FourierFlow(gas, 0.5, 0.0, 2.0, layers=20),
            {"n_particles": 2000, "rtol": 0.01},
            truths.fluxes,
        ),
        *refused,
    ]


def sheared_molecules(result, shear_rate: float) -> Truth:
    """T at the end, by the closed equations of the second moments (Ikenberry and Truesdell).

    d(xx, xy, yy, zz)/dt with ν = 8/(5√π), the rate at which stresses decay: from rest at T0.
    """
    nu, a = 8 / (5 * np.sqrt(np.pi)), shear_rate
    mean = np.array([1, 0, 1, 1]) / 3.0
    relax = nu * (np.outer(mean * 3, [1, 0, 1, 1]) / 3.0 - np.eye(4))
    shear = np.zeros((4, 4))
    shear[0, 1], shear[1, 2] = -2 * a, -a
    values, vectors = np.linalg.eig(relax + shear)
    start = np.linalg.solve(vectors, np.array([1.0, 0, 1.0, 1.0]))
    time = float(result.series["time"][-1])
    moments = (vectors @ (start * np.exp(values * time))).real
    last = result.series.isel(sample=-1)
    known = float((moments[0] + moments[2] + moments[3]) / 3)
    return Truth("T/T0", float(last["temperature"]), float(last["temperature_error"]), known, 3e-3)


def precisions() -> list[Point]:
    """float64 beside float32, on a gas far from T0: both must have the one stress."""
    return [
        Point(
            *("precision", f"{dtype}, a = {rate:g}"),
            lambda rate=rate: UniformShear(InelasticHardSpheres(0.7), rate),
            SMALL | {"dtype": dtype},
            lambda result: [truths.stress(result), truths.balance(result, 0.7)],
        )
        for dtype in ("float32", "float64")
        for rate in (1e-10, 1e6)
    ]


def every_point() -> list[Point]:
    """The whole map."""
    families = (restitutions, shear_rates, steps_and_sizes, frictional, long_coolings, fields)
    families += (walls, slabs, maxwell_molecules, precisions)
    return [point for family in families for point in family()]
