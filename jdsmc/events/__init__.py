"""Event-driven molecular dynamics of inelastic hard disks in a periodic square.

Needs numba (`pip install "jdsmc[md]"`), which is imported at the first use only. Units: m = λ0 =
v0 = τ0 = 1 with λ0 = 1/(2√2 nσ) and T0 = 1/2; a gas is given by its number of disks and nσ².

    system = events.start(1000, density=0.01, seed=1)
    system = events.advance(system, restitution=0.8, duration=10.0)  # free cooling
    system, samples = events.advance_scaled(system, 0.8, growth_rate=0.079, n_samples=100)
"""

from .simulate import advance, advance_scaled, faults, phase_space, place, start
from .system import Samples, System

__all__ = [
    "Samples",
    "System",
    "advance",
    "advance_scaled",
    "faults",
    "phase_space",
    "place",
    "start",
]
