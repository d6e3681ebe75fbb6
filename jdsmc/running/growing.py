"""Arrays that grow along their third axis, at a cost in proportion to their length."""

import numpy as np


class Growing:
    """Named arrays (points, realizations, length, ...) whose room doubles when it is full."""

    def __init__(self):
        self.length = 0
        self._room: dict[str, np.ndarray] = {}

    def append(self, new: dict[str, np.ndarray]) -> None:
        """Add arrays of one length to all of them."""
        last = self.length
        for name, values in new.items():
            last = self.length + values.shape[2]
            room = self._room.get(name)
            if room is None or last > room.shape[2]:
                larger = np.empty((*values.shape[:2], 2 * last, *values.shape[3:]), values.dtype)
                if room is not None:
                    larger[:, :, : self.length] = room[:, :, : self.length]
                self._room[name] = room = larger
            room[:, :, self.length : last] = values
        self.length = last

    def __getitem__(self, name: str) -> np.ndarray:
        return self._room[name][:, :, : self.length]

    def __contains__(self, name: str) -> bool:
        return name in self._room

    def __iter__(self):
        return iter(self._room)

    def state(self) -> dict:
        """All of it as a pytree of arrays and numbers; `take` puts it back."""
        return {"length": self.length, "arrays": {name: self[name] for name in self}}

    def take(self, state: dict) -> None:
        """Become what gave this `state`."""
        self.length = int(state["length"])
        self._room = {name: np.array(values) for name, values in state["arrays"].items()}
