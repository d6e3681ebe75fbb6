"""All faults: `python -m tests.faults FOLDER [--out PAGE]`.

Processes of every scene are killed at random instants and resumed; every byte of a small checkpoint
and of a small result is flipped, and both are cut at a hundred lengths; disks fill, folders are
read-only, two runs want one file; and scenes of its own spoil what is on the device. FOLDER keeps
the table, and a second call goes on where the first was ended. The exit status is 1 if anything is
lost or silent.
"""

import argparse
import os
import sys
from pathlib import Path

from . import damage, device, disk, kills
from .table import OUTCOMES, Table, page, summary


def campaign(table: Table, *, killed: int, ended: int, step: int, times: int) -> list[dict]:
    """Inject what a table lacks; its rows.

    Arguments: processes to end by SIGKILL and by SIGTERM; every so many bytes are flipped; how
    often each of the other faults is injected.
    """
    device.inject(table, times)
    kills.inject(table, killed, ended)
    damage.inject(table, step)
    disk.inject(table, times, times // 4)
    return table.rows()


def main() -> int:
    """Inject what is missing; print the table, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="where the table is kept")
    parser.add_argument("--out", type=Path, help="page to write")
    parser.add_argument("--kills", type=int, default=200, help="processes to end by SIGKILL")
    parser.add_argument("--terms", type=int, default=50, help="processes to end by SIGTERM")
    parser.add_argument("--step", type=int, default=1, help="flip every so many bytes")
    parser.add_argument("--times", type=int, default=20, help="how often others are injected")
    given = parser.parse_args()
    # the processes share compiled programs
    os.environ.setdefault("JDSMC_COMPILATION_CACHE", str(given.folder.resolve() / "programs"))
    numbers = {"killed": given.kills, "ended": given.terms, "step": given.step}
    table = Table(given.folder, say=True)
    rows = campaign(table, **numbers, times=given.times)
    print(summary(rows))
    if given.out is not None:
        given.out.write_text(page(rows), encoding="utf-8")
    return int(any(not row["outcome"].startswith(OUTCOMES[:2]) for row in rows))


if __name__ == "__main__":
    sys.exit(main())
