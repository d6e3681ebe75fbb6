"""The simplest event-driven program there is: all pairs, all images, nothing remembered."""

import numpy as np


def next_collision(position, velocity, side, diameter):
    """Time, pair and unit vector (from the second to the first) of the earliest contact."""
    shifts = side * np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)])
    r = position[:, None, None] - position[None, :, None] + shifts  # (N, N, 9, 2)
    g = np.broadcast_to((velocity[:, None] - velocity[None, :])[:, :, None], r.shape)
    b, square = np.sum(r * g, axis=-1), np.sum(g * g, axis=-1)
    root = b**2 - square * (np.sum(r * r, axis=-1) - diameter**2)
    candidate = (b < 0) & (root > 0)
    candidate &= np.triu(np.ones(b.shape[:2], bool), 1)[:, :, None]
    time = np.full(b.shape, np.inf)
    time[candidate] = (-b[candidate] - np.sqrt(root[candidate])) / square[candidate]
    one, other, image = np.unravel_index(np.argmin(time), time.shape)
    wait = time[one, other, image]
    contact = r[one, other, image] + wait * g[one, other, image]
    return wait, (one, other), contact / np.linalg.norm(contact)


def simulate(position, velocity, side, diameter, restitution, n_collisions):
    """Times and pairs of the first collisions, and the velocities after the last of them."""
    position, velocity = position.copy(), velocity.copy()
    times, pairs, now = [], [], 0.0
    for _ in range(n_collisions):
        wait, (one, other), normal = next_collision(position, velocity, side, diameter)
        now += wait
        position = (position + wait * velocity) % side
        kick = 0.5 * (1 + restitution) * np.dot(velocity[one] - velocity[other], normal) * normal
        velocity[one] -= kick
        velocity[other] += kick
        times.append(now)
        pairs.append((one, other))
    return np.array(times), np.array(pairs), velocity
