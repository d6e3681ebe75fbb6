"""What a scene reports: every name carries its meaning, unit and dimensions."""

from typing import NamedTuple


class Observable(NamedTuple):
    """A reported quantity: name in files, meaning for people, unit, dimensions beyond the sweep.

    `symbol` is short, for axes of pictures; the name serves where it is empty. `setting`: chosen by
    the run, not by the gas, so that no run waits for it to be steady.
    """

    name: str
    meaning: str
    unit: str = "1"
    dims: tuple[str, ...] = ()
    symbol: str = ""
    setting: bool = False

    @property
    def short(self) -> str:
        """What stands on an axis or a column."""
        return self.symbol or self.name.replace("_", " ")

    @property
    def axis_label(self) -> str:
        """Symbol and unit."""
        return self.short if self.unit == "1" else f"{self.short} / {self.unit}"


TIME = Observable("time", "time", "τ0", symbol="t")
COLLISIONS = Observable("collisions", "accepted collisions per particle s", symbol="s")
COLLISION_RATIO = Observable(
    "collision_ratio", "collisions over their local-equilibrium number s/s0", symbol="s/s0"
)
CLOCKS = (TIME, COLLISIONS, COLLISION_RATIO)
"""What every run reports against the number of a sample."""
