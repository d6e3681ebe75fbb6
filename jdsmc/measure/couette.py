"""Flow between moving walls: profiles, stress, heat flux and slip. On the host, float64.

Lengths in λ0, T in that of the upper wall, stresses in n̄ m v0², energy fluxes in n̄ m v0³.
"""

import numpy as np

from ..units import INITIAL_TEMPERATURE
from .observable import Observable

ALONG = ("z",)
OBSERVABLES = (
    Observable(
        "shear_stress", "shear stress -P_xz averaged over the slab", "n̄ m v0²", symbol="-P_xz"
    ),
    *(
        Observable(
            f"shear_stress_{side}_wall",
            f"shear stress -P_xz from the momentum exchanged at the {side} wall",
            "n̄ m v0²",
        )
        for side in ("lower", "upper")
    ),
    *(
        Observable(
            f"heat_flux_{side}_wall",
            f"heat flux q_z from the energy exchanged at the {side} wall, less its work",
            "n̄ m v0³",
        )
        for side in ("lower", "upper")
    ),
    Observable("mean_velocity", "flow velocity averaged over the particles", "v0"),
    Observable("wall_work", "work done by the walls, per area and time", "n̄ m v0³"),
    Observable("force_work", "work done by the force, per area and time", "n̄ m v0³"),
    Observable("dissipation", "energy lost in collisions, per area and time", "n̄ m v0³"),
    Observable("shear_rate", "slope du_x/dz of a line through the middle half", "1/τ0"),
    *(
        Observable(
            f"slip_{side}_wall",
            f"that line at the {side} wall, from the velocity of the wall inwards",
            "v0",
        )
        for side in ("lower", "upper")
    ),
    Observable("density", "density n/n̄", dims=ALONG, symbol="n/n̄"),
    Observable("velocity_x", "flow velocity u_x", "v0", ALONG, "u_x"),
    Observable("temperature", "temperature T/T0", dims=ALONG, symbol="T/T0"),
    Observable("pressure", "pressure p", "n̄ m v0²", ALONG, "p"),
    Observable("pressure_zz", "pressure P_zz", "n̄ m v0²", ALONG, "P_zz"),
    Observable("pressure_xz", "stress P_xz", "n̄ m v0²", ALONG, "P_xz"),
    Observable("heat_flux", "heat flux q_z", "n̄ m v0³", ALONG, "q_z"),
)


def profiles(means: dict) -> dict:
    """Profiles from averages that add up: density, momentum, energy and their fluxes of each layer.

    What moves with the flow is taken off: p = (n⟨v²⟩ - n u²)/3, and q_z = n⟨v² v_z⟩/2 - u_x P_xz,
    since nothing flows along z.
    """
    density, momentum, xz = means["density"], means["momentum"], means["pressure_xz"]
    with np.errstate(divide="ignore", invalid="ignore"):
        flow = momentum / density
        pressure = (means["square"] - momentum * flow) / 3.0
        temperature = pressure / density / INITIAL_TEMPERATURE
    return {
        "density": density,
        "velocity_x": flow,
        "temperature": temperature,
        "pressure": pressure,
        "pressure_zz": means["pressure_zz"],
        "pressure_xz": xz,
        "heat_flux": means["flux"] - flow * xz,
    }


def slip(flow: np.ndarray, difference, length, force=0.0) -> dict:
    """Shear rate and slip at the walls, of a straight line through the middle half of the profile.

    Arguments: u_x, z along the last axis; the velocity U of the upper wall relative to the lower
    one, half of it either way; L; a force along x, under which the profile is no straight line:
    then all are NaN.
    """
    layers = flow.shape[-1]
    quarter = layers // 4
    middle = slice(quarter, layers - quarter)
    height = (np.arange(layers)[middle] + 0.5) / layers - 0.5
    part = flow[..., middle]
    centre, spread = np.mean(part, axis=-1), np.sum(height**2)
    straight = spread > 0 and force == 0
    rise = np.sum(height * part, axis=-1) / spread if straight else np.full_like(centre, np.nan)
    half = 0.5 * (difference - rise)
    return {
        "shear_rate": rise / length,
        "slip_lower_wall": half + centre,
        "slip_upper_wall": half - centre,
    }
