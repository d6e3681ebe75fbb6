"""Files that are not as written: every byte of a checkpoint flipped in turn, ends cut off."""

from pathlib import Path

import jdsmc

from ..helpers import differences
from .table import SAME, SILENT, TOLD, Table

CUTS = 100

SMALLEST = {"n_particles": 64, "steps_per_record": 64, "collisions": 0.5, "progress": False}
"""One chunk of one record, so that the files have few bytes."""

OF_A_RESULT = 7
"""Of a result only every seventh byte is flipped: it has more, and the same digest."""


def injected(path: Path, data: bytes, whole: jdsmc.Result, read) -> str:
    """Read bytes that are not as written: they must be refused in a sentence, or be harmless."""
    path.write_bytes(data)
    try:
        found = read(path)
    except ValueError as error:
        return TOLD if str(path) in str(error) else f"{SILENT}: {error}"
    other = differences(whole, found)
    return f"{SILENT}: {other} differ" if other else SAME


def inject(table: Table, step: int) -> None:
    """Flip every so many bytes of a checkpoint, fewer of a result, and cut both."""
    gas = jdsmc.InelasticHardSpheres(0.7)
    checkpoint, result = (table.folder / f"small_{name}.h5" for name in ("kept", "result"))
    for old in table.folder.glob("small_*"):
        old.unlink()
    scene = jdsmc.scenarios.ShearedSlab(gas, 4.0, 2.5, layers=2)
    whole = jdsmc.run(scene, checkpoint=checkpoint, **SMALLEST)
    whole.save(result)
    for path, read in (
        (checkpoint, lambda file: jdsmc.resume(file, progress=False)),
        (result, jdsmc.load),
    ):
        data, what = path.read_bytes(), path.stem.removeprefix("small_")
        kind = {"kept": "checkpoint", "result": "result"}[what]
        damaged = table.folder / f"damaged_{what}.h5"
        for place in range(0, len(data), step * (1 if path == checkpoint else OF_A_RESULT)):
            flipped = data[:place] + bytes([data[place] ^ 1 << place % 8]) + data[place + 1 :]
            table.note(
                f"byte of a {kind} flipped",
                f"{len(data)} bytes",
                place,
                lambda d=flipped, p=damaged, r=read: injected(p, d, whole, r),
            )
        for part in range(CUTS):
            cut = data[: len(data) * part // CUTS]
            table.note(
                f"{kind} cut",
                "",
                part,
                lambda d=cut, p=damaged, r=read: injected(p, d, whole, r),
            )
