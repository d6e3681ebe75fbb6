"""A gas that white noise keeps warm: the usual thermostat of granular gases.

Van Noije and Ernst, "Velocity distributions in homogeneous granular fluids: the free and the heated
case", Granular Matter 1, 57 (1998). Kicks of variance ξ² dt a component make up for the energy lost
in collisions: dT/dt = ξ² - ζT. The steady distribution does not depend on ξ for gases without a
speed of their own, and falls as exp(-A C^{3/2}) at high speeds, where a particle is kicked between
two collisions and none is thrown in.
"""

from typing import Any, ClassVar

import jax.numpy as jnp
import numpy as np
import scipy

from .. import random
from ..collisions.meet import Collisions
from ..fields import number
from ..gases import AbstractGas
from ..gases.hard_spheres import loses_energy
from ..measure.observable import Observable
from ..types import Key, Scalar, Velocity
from ..units import INITIAL_TEMPERATURE
from .approach import Approach, of_velocities
from .homogeneous import AbstractHomogeneous, homogeneous_observables
from .options import Options


class WhiteNoiseThermostat(AbstractHomogeneous):
    """A homogeneous gas under white noise, started from a Maxwellian at T0.

    Arguments:
        gas: any without drag, of two or three velocity components.
        noise: ξ² > 0 in v0²/τ0, a number or a 1-D array.
    Raises ValueError for other values. A steady state needs a gas that loses energy.
    """

    command: ClassVar[str] = "thermostat"
    dimensions: ClassVar[tuple[int, ...]] = (2, 3)
    reports: ClassVar[tuple[Observable, ...]] = homogeneous_observables("a2", "temperature")
    monitored: ClassVar[tuple[str, ...]] = ("temperature", "fourth")

    gas: AbstractGas
    noise: Any = number(
        "strength ξ² of the noise",
        "v0²/τ0",
        low=0.0,
        low_included=False,
        high_included=False,
        example=0.2,
    )

    def step(
        self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options: Options
    ) -> tuple[Velocity, Collisions]:
        """Half of the kicks, collisions, half of the kicks ("strang"); or all of them first."""
        before, after = options.halves
        velocity = self.kicked(key, velocity, before * duration, 0)
        velocity, tally = self.collide(key, velocity, majorant, duration, options)
        return (self.kicked(key, velocity, after * duration, 2) if after else velocity), tally

    def kicked(self, key: Key, velocity: Velocity, duration: Scalar, stream: int) -> Velocity:
        """Velocities after the kicks of a time; two streams of random numbers from `stream` on."""
        kicks = random.normals(key, velocity, random.Stream.OWN + stream)
        width = jnp.sqrt(self.noise * duration)
        return tuple(v + width * kick for v, kick in zip(velocity, kicks, strict=True))

    def rate(self) -> Any:
        """ξ^{2/3}: the noise alone takes a gas at rest to this speed while it flies one λ0."""
        return jnp.cbrt(self.noise)

    def has_steady_state(self) -> bool:
        """True if the gas loses energy."""
        return loses_energy(self.gas)

    def no_steady_state(self) -> str:
        """What a steady state needs."""
        return "noise heats it for ever: it needs a gas that loses energy; else give duration"

    def approach(self, options: Options) -> Approach:
        """Of T to T_s, with p = d ln(ζT)/d ln T (3/2 of hard spheres): p ζ(T_s).

        From a hotter start T falls with ζ of its own, which is as many collisions: p ln(T0/T_s).
        """
        heating, dimension = float(self.noise), self.gas.dimension
        velocities = of_velocities(self.gas, 0, fed=True)

        def excess(log_temperature: float) -> float:
            loss = 2.0 / dimension * float(self.gas.energy_loss_rate(np.exp(log_temperature)))
            return np.log(max(loss, 1e-300) / heating)

        low, high = -60.0, 60.0
        if excess(low) > 0.0 or excess(high) < 0.0:
            return velocities._replace(certain=False)
        steady = float(scipy.optimize.brentq(excess, low, high, xtol=1e-6))
        power = (excess(steady + 0.01) - excess(steady - 0.01)) / 0.02
        temperature = np.exp(steady)
        slow = float(self.gas.collision_rate(temperature)) * temperature / (power * heating)
        hotter = np.log(INITIAL_TEMPERATURE) - steady
        distance = power * max(0.0, hotter)
        return Approach(max(velocities.collisions, slow), distance, velocities.certain)
