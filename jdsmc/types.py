"""Shapes of the arrays that pass between modules, named once."""

from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Array, Float, Int32, UInt32

Physical = Any
"""A physical number of a gas or scene: a float64 array on the host, traced in a step."""

Whole = int | float | np.number
"""A number that must be whole, however it is given: 10000, 1e4, np.int32(3)."""

Scalar = Float[Array, ""]
"""One physical number; always traced, never static."""

Rows = Float[Array, "rows lanes"]
"""One velocity component of all particles, laid out as rows of neighbours in memory."""

Velocity = tuple[Rows, ...]
"""Velocity components in units of v0, one array each (two or three)."""

Copies = tuple[Float[Array, "copies rows lanes"], ...]
"""Velocity components of several copies of a gas."""

TakenRows = tuple[Float[Array, "_ lanes"], ...]
"""Velocity components of some of the rows."""

Particles = tuple[Float[Array, "*shape"], ...]
"""Velocity components of any particles, in arrays of any shape."""

Pairs = tuple[Particles, Particles]
"""Velocities of the first and of the second particle of pairs."""

Positions = Float[Array, " particles"]
"""Positions in units of λ0, of a gas in space."""

Velocities = tuple[Float[Array, " particles"], ...]
"""Velocity components of a gas in space."""

Layer = Int32[Array, " particles"]
"""The layer every particle is in."""

Profile = Float[Array, " layers"]
"""One number for every layer."""

Word = UInt32[Array, "..."]


class Key(NamedTuple):
    """A random key: two 32-bit words (see `jdsmc.random`)."""

    high: UInt32[Array, ""]
    low: UInt32[Array, ""]
