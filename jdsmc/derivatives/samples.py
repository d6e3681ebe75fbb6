"""The sums of a run, chunk after chunk, on the host in float64."""

import numpy as np

from .sampling import Sampler

MOST, MOST_RECORDS = 256, 1024
"""Blocks kept of chunks, and of records; beyond, neighbours are added up."""

POINTWISE = {
    **{"moments": 1, "second": 2, "source": 1, "response": 2},
    **{"cubed": 0, "cubed_response": 1, "tangents": 2},
}
"""What is averaged, and how many axes each has of its own, which come last."""


class Samples:
    """Averages over blocks of chunks: arrays (points, realizations, blocks, ...), and the share of
    time (τ0) and the first record of each.

    Arguments: what is sampled.
    """

    def __init__(self, sampler: Sampler):
        self.sampler = sampler
        self._means: list[dict[str, np.ndarray]] = []
        self._weights: list[np.ndarray] = []
        self._first: list[int] = []
        self._chunks = 1  # in a whole block
        self._in_last = 0

    def extend(self, sums: dict, elapsed: np.ndarray, first_record: int) -> None:
        """Add a chunk: arrays (points, realizations, parts, ...), one part or one a record.

        Arguments: as `Sampler.sample` gave them; how long each record lasted, (points,
        realizations, records); the first record.
        """
        parts = sums["reference"].shape[2]
        lasted = np.split(elapsed, parts, axis=2)
        for k, own in enumerate(lasted):
            part = {name: x[:, :, k] for name, x in sums.items()}
            self.append(part, np.sum(own, axis=2), first_record + k * own.shape[2])

    def append(self, sums: dict, elapsed: np.ndarray, first_record: int) -> None:
        """Add averages (points, realizations, ...) over so much time, from a record on."""
        new = absolute(self.sampler, sums)
        if 0 < self._in_last < self._chunks:
            last = self._means[-1], self._weights[-1]
            self._means[-1], self._weights[-1] = _joined(last, (new, elapsed))
            self._in_last += 1
        else:
            self._means.append(new)
            self._weights.append(elapsed)
            self._first.append(first_record)
            self._in_last = 1
        most = MOST_RECORDS if self.sampler.each else MOST
        if len(self._means) > most and self._in_last == self._chunks:
            self._halve()

    def _halve(self) -> None:
        blocks = list(zip(self._means, self._weights, strict=True))
        last = blocks.pop() if len(blocks) % 2 else None
        joined = [_joined(a, b) for a, b in zip(blocks[::2], blocks[1::2], strict=True)]
        self._first = self._first[: 2 * len(joined) : 2] + self._first[2 * len(joined) :]
        self._in_last = self._chunks if last else 2 * self._chunks
        self._chunks *= 2
        joined += [last] if last else []
        self._means, self._weights = map(list, zip(*joined, strict=True))

    def point(self, point: int, first: int) -> tuple[dict[str, np.ndarray], np.ndarray, np.ndarray]:
        """Blocks of one point that start at record `first` or later.

        Returns: averages (realizations, blocks, ...), time in each (realizations, blocks), and the
        record at which each starts.
        """
        keep = [k for k, start in enumerate(self._first) if start >= first]
        means = {
            name: np.stack([self._means[k][name][point] for k in keep], axis=1)
            for name in POINTWISE
        }
        weights = np.stack([self._weights[k][point] for k in keep], axis=1)
        return means, weights, np.array([self._first[k] for k in keep])

    def has(self, first: int) -> bool:
        """True if a block starts at that record or later."""
        return bool(self._first) and self._first[-1] >= first

    def state(self) -> dict:
        """All of it as a pytree; `take` puts it back."""
        return {
            "means": list(self._means),
            "weights": list(self._weights),
            "first": list(self._first),
            "chunks": self._chunks,
            "in_last": self._in_last,
        }

    def take(self, state: dict) -> None:
        """Become the samples that gave this `state`."""
        self._means, self._weights = list(state["means"]), list(state["weights"])
        self._first = [int(first) for first in state["first"]]
        self._chunks, self._in_last = int(state["chunks"]), int(state["in_last"])


def _joined(one: tuple, other: tuple) -> tuple:
    """Two blocks as one: averages weighted with their time."""
    (a, wa), (b, wb) = one, other
    whole = wa + wb

    def mean(x, y):
        share = (wb / whole).reshape(whole.shape + (1,) * (x.ndim - 2))
        return x + share * (y - x)

    return {name: mean(a[name], b[name]) for name in a}, whole


def absolute(sampler: Sampler, sums: dict) -> dict[str, np.ndarray]:
    """Sums of a chunk with the powers of the thermal speed multiplied back."""
    degree = sampler.symmetry.degree
    rows = np.array([degree(powers) for powers in sampler.rows])
    trial = rows[: len(sampler.basis)]
    changed = np.array([*trial, 0])
    root = np.asarray(sums["reference"], dtype=float)
    powers = {
        "moments": rows,
        "second": rows[:, None] + trial,
        "source": changed,
        "response": changed[:, None] + trial,
        "cubed": np.array(3),
        "cubed_response": 3 + trial,
        "tangents": np.broadcast_to(changed, np.shape(sums["tangents"])[-2:]),
    }
    return {
        name: sums[name] * root.reshape(root.shape + (1,) * power.ndim) ** power
        for name, power in powers.items()
    }


def leading_last(averages: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The same averages with their own axes first."""
    found = {}
    for name, values in averages.items():
        further = range(np.ndim(values) - POINTWISE[name])
        found[name] = np.moveaxis(values, further, [-1 - k for k in reversed(further)])
    return found
