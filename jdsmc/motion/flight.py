"""Free flight between two walls under gravity, and across Lees-Edwards planes."""

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Int32

from ..gases.scatter import root
from ..random import Stream
from ..types import Key, Positions, Scalar, Velocities
from .queue import Queue, places_for
from .walls import Walls

MOST_BOUNCES = 100
"""Wall hits of one particle in one step; a particle still flying then is counted as lost."""


class Exchange(eqx.Module):
    """What the walls at z = 0 and z = L did, and particles that could not finish their flight.

    `lower_energy`, `upper_energy`: energy given to the gas (m v0²); `lower_push`, `upper_push`:
    momentum along x given to it (m v0).
    """

    lower_energy: Scalar
    upper_energy: Scalar
    lower_push: Scalar
    upper_push: Scalar
    lost: Scalar

    @staticmethod
    def none(dtype) -> "Exchange":
        """Nothing happened yet."""
        return Exchange(*(jnp.zeros((), dtype) for _ in range(5)))

    def then(self, later: "Exchange") -> "Exchange":
        """This and what came later."""
        return jax.tree.map(lambda a, b: a + b, self, later)


def fly(
    key: Key,
    walls: Walls,
    position: Positions,
    velocity: Velocities,
    gravity: Scalar,
    length: Scalar,
    duration: Scalar,
) -> tuple[Positions, Velocities, Exchange]:
    """Parabolic flight with acceleration -g ẑ; who hits a wall flies on with what it gives back.

    Nearly all particles hit none. Those who do are gathered, some places at a time, and bounce
    there until they have flown: random numbers, logarithms and roots are theirs alone. Rounds go on
    until all have had a place, whatever their number.
    """
    vx, vy, vz = velocity
    fall = gravity * duration
    end = position + duration * (vz - 0.5 * fall)
    hits = hitting(position, vz, end, gravity, length, duration)
    queue = Queue.of(hits)
    places = places_for(position.shape[0])

    def serve(carry):
        served, there, (wx, wy, wz), exchange = carry
        who, taken = queue.next(served, places)
        start = tuple(x[who] for x in (position, vx, vy, vz))
        (z, *after), now = bounce(key, walls, who, taken, start, gravity, length, duration)
        # an empty place is written past the end, that is nowhere
        to = jnp.where(taken, who, position.shape[0])
        there, *moved = (
            whole.at[to].set(part, mode="drop", unique_indices=True)
            for whole, part in zip((there, wx, wy, wz), (z, *after), strict=True)
        )
        return served + places, there, tuple(moved), exchange.then(now)

    def some_wait(carry):
        return carry[0] < queue.length

    carry = (jnp.asarray(0, jnp.int32), end, (vx, vy, vz - fall), Exchange.none(position.dtype))
    _, there, velocity, exchange = lax.while_loop(some_wait, serve, carry)
    return there, velocity, exchange


def hitting(position, speed, end, gravity, length, duration) -> Bool[Array, " particles"]:
    """Whether a parabola leaves [0, L] within the time: at its end, or where it turns.

    Without roots; derivatives see none of it.
    """
    position, speed, end = lax.stop_gradient((position, speed, end))
    falls = jnp.abs(gravity) > jnp.finfo(position.dtype).tiny
    per_gravity = jnp.where(falls, 1.0 / jnp.where(falls, gravity, 1.0), 0.0)
    turn = jnp.clip(speed * lax.stop_gradient(per_gravity), 0.0, duration)
    extreme = position + turn * (speed - 0.5 * gravity * turn)
    return (jnp.minimum(end, extreme) < 0.0) | (jnp.maximum(end, extreme) > length)


def bounce(
    key: Key,
    walls: Walls,
    who: Int32[Array, " places"],
    taken: Bool[Array, " places"],
    start: tuple,
    gravity: Scalar,
    length: Scalar,
    duration: Scalar,
):
    """Fly the particles of the taken places to the end of the step.

    Arguments: `who`, the number of each particle, that its random numbers follow; `start`, place
    and velocity components. Returns: the same afterwards, and what the walls did.
    """
    position, *velocity = start

    def any_left(carry):
        number, (_, _, remaining, _) = carry
        return (number < MOST_BOUNCES) & jnp.any(remaining > 0)

    def once_more(carry):
        number, flights = carry
        stream = Stream.FLIGHT + 2 * number
        return number + 1, _fly_once(key, stream, walls, who, flights, gravity, length)

    remaining = jnp.where(taken, duration, 0.0)
    flights = (position, tuple(velocity), remaining, Exchange.none(position.dtype))
    first = once_more((jnp.asarray(0, jnp.int32), flights))  # nearly always all there is
    _, (position, velocity, remaining, exchange) = lax.while_loop(any_left, once_more, first)
    lost = jnp.sum((remaining > 0).astype(position.dtype))
    return (position, *velocity), eqx.tree_at(lambda e: e.lost, exchange, lost)


def _fly_once(key: Key, stream, walls: Walls, who, flights, gravity: Scalar, length: Scalar):
    """Fly until a wall is hit, take a new velocity there, and fly on unless a wall is hit again."""
    position, (vx, vy, vz), remaining, exchange = flights
    time, at_top = first_hit(position, vz, gravity, length)
    hit = time < remaining
    time = jnp.minimum(time, remaining)
    flown = position + time * (vz - 0.5 * gravity * time)
    arriving = vz - gravity * time
    place = jnp.where(hit, jnp.where(at_top, length, 0.0), flown)
    rest = remaining - time
    old = (vx, vy, arriving)
    new = lax.optimization_barrier(walls.give_back(key, stream, who, at_top, old))
    gained = 0.5 * sum(v * v - u * u for v, u in zip(new, old, strict=True))
    pushed = new[0] - vx
    vx, vy, vz = (jnp.where(hit, v, u) for v, u in zip(new, old, strict=True))
    again = hit & (first_hit(place, vz, gravity, length)[0] < rest)
    rest_now = jnp.where(again, 0.0, rest)
    # only rounding can carry a flight without a hit past a wall
    place = jnp.clip(place + rest_now * (vz - 0.5 * gravity * rest_now), 0.0, length)
    below, above = hit & ~at_top, hit & at_top

    def given(what, there):
        return jnp.sum(jnp.where(there, what, 0.0))

    now = Exchange(
        *(given(gained, below), given(gained, above)),
        *(given(pushed, below), given(pushed, above)),
        jnp.zeros((), position.dtype),
    )
    velocity = (vx, vy, vz - gravity * rest_now)
    return place, velocity, jnp.where(again, rest, 0.0), exchange.then(now)


def first_hit(position: Positions, speed: Positions, gravity: Scalar, length: Scalar):
    """Time until a wall is hit, and whether it is the upper one."""
    to_bottom = time_to_floor(position, speed, gravity)
    to_top = time_to_floor(length - position, -speed, -gravity)
    return jnp.minimum(to_bottom, to_top), to_top < to_bottom


def time_to_floor(height: Positions, speed: Positions, gravity: Scalar) -> Positions:
    """When h + v t - g t²/2 = 0 for the first t > 0, infinite if never; h >= 0.

    Two forms of the root, each without cancellation: downwards 2h/(|v| + √(v² + 2gh)), upwards
    (v + √(v² + 2gh))/g, which also holds for a start on the floor.
    """
    never = jnp.asarray(jnp.inf, height.dtype)
    discriminant = speed * speed + 2.0 * gravity * height
    root_of_it = root(jnp.maximum(discriminant, 0.0))
    downwards = 2.0 * height / (jnp.maximum(-speed, 0.0) + root_of_it)
    falling_back = (jnp.maximum(speed, 0.0) + root_of_it) / jnp.where(gravity > 0, gravity, 1.0)
    down = jnp.where((speed < 0) & (discriminant >= 0), downwards, never)
    return jnp.where((speed >= 0) & (gravity > 0), falling_back, down)


def cross_planes(
    position: Positions, velocity: Velocities, shear_rate: Scalar, length: Scalar, duration: Scalar
) -> tuple[Positions, Velocities]:
    """Flight along y through Lees-Edwards planes: v_x jumps by ∓aL at each image passed."""
    vx, vy, vz = velocity
    flown = position + vy * duration
    images = jnp.floor(flown / length)
    # rounding can leave a particle on the upper edge: it belongs to the lower one of the next image
    inside = flown - images * length
    over: Bool[Array, " particles"] = inside >= length
    inside = jnp.where(over, 0.0, jnp.maximum(inside, 0.0))
    images = images + over.astype(vx.dtype)
    return inside, (vx - images * (shear_rate * length), vy, vz)
