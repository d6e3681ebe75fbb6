"""Faults on the device: a scene of its own spoils its state, or what it tells the collisions."""

from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar
from unittest import mock

import equinox as eqx
import jax.numpy as jnp
import numpy as np

import jdsmc
from jdsmc import sweep
from jdsmc.scenarios import FourierFlow, HeatFluxForce, ShearedSlab, SlabState, UniformShear
from jdsmc.scenarios.homogeneous import HomogeneousState
from jdsmc.scenarios.walled import WalledState
from jdsmc.types import Scalar

from .table import LOST, SILENT, TOLD, Table

IN_CHUNK = 8
"""Records of a chunk, of 8 steps each."""

OPTIONS = {"steps_per_record": 8, "seed": 5, "progress": False}


class Counting(HomogeneousState):
    """A gas, and how many records it has made."""

    records: Scalar


class SpoiledShear(UniformShear):
    """A sheared gas with which something goes wrong from a record on.

    `spoil`: 0 for nothing; 1 and 2, one velocity is NaN, or infinite; 3, collisions are told of a
    majorant four times as high, so that there are more candidates than slots; 4, of one four times
    as low for a step four times as long, so that probabilities are above one.
    """

    command: ClassVar[str] = "spoiled-shear"
    spoil: Any = jdsmc.number("what goes wrong", low=0.0, high=4.0, default=0.0)
    after: Any = jdsmc.number("records before that", low=0.0, default=0.0)
    told: Any = jdsmc.number("factor of the majorant that collisions are told of", default=1.0)

    def initial(self, key, options):
        state = super().initial(key, options)
        return Counting(state.velocity, state.majorant, jnp.zeros((), options.dtype))

    def advance(self, key, state, options):
        now = state.records >= self.after
        told = jnp.where(self.spoil == 3, 4.0, jnp.where(self.spoil == 4, 0.25, 1.0))
        scene = eqx.tree_at(lambda s: s.told, self, jnp.where(now, told, 1.0).astype(options.dtype))
        wrong = jnp.where(self.spoil == 1, jnp.nan, jnp.where(self.spoil == 2, jnp.inf, 0.0))
        x, *others = state.velocity
        x = x.at[0, 0].add(jnp.where(now, wrong, 0.0).astype(x.dtype))
        one = HomogeneousState((x, *others), state.majorant)
        new, record = super(SpoiledShear, scene).advance(key, one, options)
        return Counting(new.velocity, new.majorant, state.records + 1), record

    def collide(self, key, velocity, majorant, duration, options):
        longer = jnp.maximum(1.0 / self.told, 1.0) * duration
        return super().collide(key, velocity, self.told * majorant, longer, options)

    def finish_chunk(self, state):
        new, sample = super().finish_chunk(state)
        return Counting(new.velocity, new.majorant, state.records), sample


class SpoiledHeatFlux(HeatFluxForce):
    """A gas under the heat-flux force all of whose velocities are NaN from a record on."""

    command: ClassVar[str] = "spoiled-heat-flux"
    spoil: Any = jdsmc.number("what goes wrong", low=0.0, high=1.0, default=0.0)
    after: Any = jdsmc.number("records before that", low=0.0, default=0.0)

    def __init__(self, gas, field, scheme="exact", spoil=0.0, after=0.0):
        super().__init__(gas, field, scheme)
        self.spoil, self.after = spoil, after

    def initial(self, key, options):
        state = super().initial(key, options)
        return Counting(state.velocity, state.majorant, jnp.zeros((), options.dtype))

    def advance(self, key, state, options):
        spoilt = (state.records >= self.after) & (self.spoil > 0)
        velocity = tuple(jnp.where(spoilt, jnp.nan, v) for v in state.velocity)
        new, record = super().advance(key, HomogeneousState(velocity, state.majorant), options)
        return Counting(new.velocity, new.majorant, state.records + 1), record

    def finish_chunk(self, state):
        new, sample = super().finish_chunk(state)
        return Counting(new.velocity, new.majorant, state.records), sample


class CountingSlab(SlabState):
    """A gas in a slab, and how many records it has made."""

    records: Scalar


class SpoiledSlab(ShearedSlab):
    """A sheared slab one of whose particles flies past the planes at a record."""

    command: ClassVar[str] = "spoiled-slab"
    spoil: Any = jdsmc.number("what goes wrong", low=0.0, high=1.0, default=0.0)
    after: Any = jdsmc.number("records before that", low=0.0, default=0.0)

    def initial(self, key, options):
        state = super().initial(key, options)
        return CountingSlab(**vars(state), records=jnp.zeros((), options.dtype))

    def advance(self, key, state, options):
        away = (state.records == self.after) & (self.spoil > 0)
        place = jnp.where(away, 1.5 * self.length, state.position[7]).astype(options.dtype)
        state = replace(state, position=state.position.at[7].set(place))
        new, record = super().advance(key, state, options)
        return replace(new, records=state.records + 1), record


class CountingWalls(WalledState):
    """A gas between walls, and how many records it has made."""

    records: Scalar


class SpoiledFourier(FourierFlow):
    """A gas between walls with which something goes wrong at a record.

    `spoil`: 0 for nothing; 1, the hot wall emits particles so fast that they never come to rest
    within a step; 2 and 3, one particle is far below, or above, the slab; 4, its place is NaN.
    """

    command: ClassVar[str] = "spoiled-fourier"
    spoil: Any = jdsmc.number("what goes wrong", low=0.0, high=4.0, default=0.0)
    after: Any = jdsmc.number("records before that", low=0.0, default=0.0)

    def initial(self, key, options):
        state = super().initial(key, options)
        return CountingWalls(**vars(state), records=jnp.zeros((), options.dtype))

    def advance(self, key, state, options):
        now = state.records == self.after
        hot = jnp.where(now & (self.spoil == 1), 1e6, 1.0).astype(options.dtype)
        walls = eqx.tree_at(lambda w: w.speed, state.walls, hot * state.walls.speed)
        place = jnp.where(self.spoil == 2, -10.0, jnp.where(self.spoil == 3, 10.0, jnp.nan))
        away = now & (self.spoil > 1)
        position = state.position.at[7].set(
            jnp.where(away, place, state.position[7]).astype(options.dtype)
        )
        new, record = super().advance(key, replace(state, walls=walls, position=position), options)
        return replace(new, walls=state.walls, records=state.records + 1), record


GAS = jdsmc.InelasticHardSpheres
SHEAR = SpoiledShear(GAS(0.7), 4.0), {"collisions": 60.0, "n_particles": 256, **OPTIONS}
FOURIER = (
    SpoiledFourier(GAS(1.0), 0.5, length=2.0, layers=4),
    {"duration": 30.0, "n_particles": 400, "time_step": 0.1, **OPTIONS, "steps_per_record": 1},
)
HEAT = SpoiledHeatFlux(GAS(0.9), 0.05), {"collisions": 20.0, "n_particles": 256, **OPTIONS}
SLAB = (
    SpoiledSlab(GAS(0.7), 4.0, 2.5, layers=10),
    {"collisions": 20.0, "n_particles": 200, **OPTIONS},
)
KINDS = {
    "a chunk that returns NaN": (SHEAR, 1),
    "a velocity that is infinite": (SHEAR, 2),
    "candidates overflow": (SHEAR, 3),
    "probabilities above one": (SHEAR, 4),
    "a chunk that returns nothing but NaN": (HEAT, 1),
    "a particle past the planes": (SLAB, 1),
    "particles lost at a wall": (FOURIER, 1),
    "a particle far below the slab": (FOURIER, 2),
    "a particle far above the slab": (FOURIER, 3),
    "a particle whose place is NaN": (FOURIER, 4),
}
"""What is injected, in which scene, by which number of its `spoil`."""


def spoiled(scene, spoil: float, after: float):
    """The scene with which this goes wrong after so many records."""
    return eqx.tree_at(lambda s: (s.spoil, s.after), scene, (np.float64(spoil), np.float64(after)))


@contextmanager
def same_random_numbers():
    """Random numbers depend on all numbers of a scene; here not on what goes wrong with it."""
    usual = sweep.fingerprint
    with mock.patch.object(sweep, "fingerprint", lambda scene: usual(spoiled(scene, 0.0, 0.0))):
        yield


def injected(kind: str, after: int, whole: jdsmc.Result, folder: Path) -> str:
    """Run until the fault is raised; resume what was kept, which must end in the same way."""
    (scene, options), spoil = KINDS[kind]
    scene = spoiled(scene, spoil, after)
    for old in folder.glob("spoiled*"):
        old.unlink()
    path = folder / "spoiled.h5"
    ends = []
    for go in (
        lambda: jdsmc.run(scene, checkpoint=path, every=1e-9, **options),
        lambda: jdsmc.resume(path, progress=False, classes=(type(scene), GAS)),
    ):
        try:
            go()
        except jdsmc.FaultError as error:
            ends.append(error)
        else:
            return f"{SILENT}: no error"
    error, again = ends
    if not str(error).endswith(".") or str(again) != str(error):
        return f"{SILENT}: {error} {again}"
    for one in ends:
        if one.result is None or not begins(whole, one.result, after):
            return f"{LOST}: {error}"
    return f"{TOLD}: {error}"


def begins(whole: jdsmc.Result, part: jdsmc.Result, records: int) -> bool:
    """True if a series is the beginning of another, and made of all whole chunks of the records."""
    made = part.attrs["n_records"] == IN_CHUNK * (records // IN_CHUNK)
    length = part.series.sizes["sample"]  # less than that: clocks of realizations differ
    return made and part.series.equals(whole.series.isel(sample=slice(0, length)))


def inject(table: Table, instants: int) -> None:
    """Each kind after other numbers of records, from the second chunk to the last but one."""
    with same_random_numbers():
        _inject(table, instants)


def _inject(table: Table, instants: int) -> None:
    settings = {id(setting): setting for setting, _ in KINDS.values()}
    wholes = {key: jdsmc.run(scene, **own) for key, (scene, own) in settings.items()}
    for kind, (setting, _) in KINDS.items():
        whole = wholes[id(setting)]
        for number in range(instants):
            last = whole.attrs["n_records"] - 2 * IN_CHUNK
            after = IN_CHUNK + 3 + (last - IN_CHUNK) * number // instants
            table.note(
                kind,
                type(setting[0]).__bases__[0].__name__,
                after,
                lambda k=kind, a=after, w=whole: injected(k, a, w, table.folder),
            )
