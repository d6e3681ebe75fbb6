"""Flow between walls: profiles between them, and the stresses and heat that they tell."""

from . import common, generic, pictures, velocities

PROFILES = ("velocity_x", "temperature", "density", "pressure_xz", "heat_flux")
STRESSES = ("shear_stress_lower_wall", "shear_stress_upper_wall", "shear_stress")
HEAT = ("heat_flux_lower_wall", "heat_flux_upper_wall")
NEEDS = {*PROFILES, *STRESSES, *HEAT, "mean_velocity"}
SIDES = ("at the lower wall", "at the upper wall", "mean over the slab")

page = generic.page


def draw(result):
    """Profiles; stresses against time, or what flows against what was swept."""
    if not result.is_steady:
        return generic.draw(result)
    steady, dims = result.steady, common.dimensions(result)
    x = pictures.across(steady, dims)
    sampled = velocities.sampled(result) is not None
    figure, panels = pictures.grid((8 if x else 7) + sampled, 5 if x else 4, 3.7)
    for panel, name in zip(panels, PROFILES, strict=False):
        pictures.profile(panel, steady, dims, name)
    pictures.walls(panels[0], result, dims, "wall_velocity", lambda u: [-0.5 * u, 0.5 * u])
    pictures.walls(panels[1], result, dims, "cold_temperature", lambda cold: [cold, 1.0])
    rest = panels[len(PROFILES) : len(panels) - sampled]
    if x:
        names = ("shear_stress", "mean_velocity", "heat_flux_lower_wall")
        for panel, name in zip(rest, names, strict=True):
            pictures.against_sweep(panel, steady, dims, x, name)
    else:
        pictures.together(rest[0], result, STRESSES, SIDES, "-P_xz")
        pictures.together(rest[1], result, HEAT, SIDES[:2], "q_z")
    if sampled:
        velocities.draw(panels[-1], result, "velocity")
    return pictures.finish(figure, panels, common.title(result, "Flow between walls"))
