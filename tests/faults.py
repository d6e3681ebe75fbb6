"""Runs killed, damaged and starved: `python -m tests.faults FOLDER [--kills N]`.

Every scene runs in a process of its own that keeps a checkpoint as often as it can. SIGKILL, or
SIGTERM, comes at a random instant, the run is resumed, and its result must be to the bit that of a
run that nobody disturbed. Then a small checkpoint has every byte flipped and is cut at a hundred
lengths: each must be refused, or give the same numbers. A table tells what was injected, caught,
lost and silent; a second call goes on where the first was ended.
"""

import argparse
import csv
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import jdsmc

from .helpers import differences

SCENES = {
    "shear": "sweep shear --restitution 0.6,0.8 --particles 256 --collisions 300",
    "cooling": "run cooling --restitution 0.8 --particles 256 --collisions 200",
    "heat-flux": "run heat-flux --restitution 0.8 --particles 256 --collisions 150",
    "fourier": "run fourier --length 5 --particles 500 --duration 60",
    "sheared-slab": "run sheared-slab --restitution 0.9 --particles 500 --layers 10 --duration 40",
    "cooling-disks": "run cooling-disks --particles 200 --density 0.05 --copies 2 "
    "--real-per-cell 2 --duration 100",
    "molecular-dynamics": "run molecular-dynamics --particles 160 --density 0.05 --duration 300",
}
SIGNALS = {"SIGKILL": signal.SIGKILL, "SIGTERM": signal.SIGTERM}
COLUMNS = ("fault", "scene", "number", "outcome")
OUTCOMES = ("same to the bit", "refused with a sentence", "lost", "silent")


def jdsmc_process(words: str, folder: Path) -> subprocess.Popen:
    """`jdsmc WORDS` in a process of its own."""
    command = [sys.executable, "-m", "jdsmc", *words.split()]
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(command, cwd=folder, **pipes)


def finished(words: str, folder: Path) -> tuple[float, str]:
    """Seconds it took, and what it said on stderr if it failed."""
    began = time.monotonic()
    process = jdsmc_process(words, folder)
    said = process.communicate()[1]
    return time.monotonic() - began, said if process.returncode else ""


def killed(scene: str, number: int, folder: Path, kind: str) -> str:
    """Kill a run at a random instant, resume it, compare."""
    whole, result = folder / f"{scene}.h5", folder / "resumed.h5"
    clock = folder / f"{scene}.seconds"
    if not whole.exists():
        took, _ = finished(f"{SCENES[scene]} --out {whole.name} --no-progress", folder)
        clock.write_text(str(took))
    for old in folder.glob("*kept*"):
        old.unlink()
    result.unlink(missing_ok=True)
    kept = f"--checkpoint kept.h5 --every 0.001 --out {result.name} --no-progress"
    process = jdsmc_process(f"{SCENES[scene]} {kept}", folder)
    rng = np.random.default_rng((len(scene), number))
    while not (folder / "kept.h5").exists() and process.poll() is None:
        time.sleep(0.01)
    time.sleep(rng.uniform(0.0, 0.5 * float(clock.read_text())))
    process.send_signal(SIGNALS[kind])
    process.wait()
    result.unlink(missing_ok=True)  # what was measured until SIGTERM
    _, said = finished(f"resume kept.h5 --out {result.name} --no-progress", folder)
    if said:
        return f"lost: {said.strip()}"
    # the code may be committed meanwhile
    same = not differences(jdsmc.load(whole), jdsmc.load(result), besides=("commit",))
    return OUTCOMES[0] if same else "silent"


def damaged(data: bytes, whole: jdsmc.Result, folder: Path) -> str:
    """Resume from bytes that are not as written."""
    path = folder / "damaged.h5"
    path.write_bytes(data)
    try:
        found = jdsmc.resume(path, progress=False)
    except ValueError:
        return OUTCOMES[1]
    return OUTCOMES[0] if found.series.identical(whole.series) else "silent"


def campaign(folder: Path, kills: int, step: int = 1) -> list[dict]:
    """Inject what the table of a folder lacks; its rows. `step`: only every so many bytes."""
    folder.mkdir(parents=True, exist_ok=True)
    table = folder / "faults.csv"
    if not table.exists():
        table.write_text(",".join(COLUMNS) + "\n")
    done = {(row["fault"], row["scene"], int(row["number"])) for row in rows_of(table)}

    def note(fault: str, scene: str, number: int, outcome) -> None:
        if (fault, scene, number) not in done:
            with table.open("a", newline="") as file:
                csv.writer(file).writerow((fault, scene, number, outcome()))

    for number in range(kills):
        kind = "SIGTERM" if number % 4 == 3 else "SIGKILL"
        scene = list(SCENES)[number % len(SCENES)]
        note(kind, scene, number, lambda s=scene, n=number, k=kind: killed(s, n, folder, k))
    small = jdsmc.scenarios.UniformShear(jdsmc.InelasticHardSpheres(0.7), 4.0)
    path = folder / "small.h5"
    path.unlink(missing_ok=True)
    options = {"n_particles": 64, "collisions": 2.0, "progress": False}
    whole, data = jdsmc.run(small, checkpoint=path, **options), path.read_bytes()
    for place in range(0, len(data), step):
        flipped = data[:place] + bytes([data[place] ^ 0x10]) + data[place + 1 :]
        note("byte flipped", "shear", place, lambda d=flipped: damaged(d, whole, folder))
    for part in range(100):
        cut = data[: len(data) * part // 100]
        note("cut", "shear", part, lambda d=cut: damaged(d, whole, folder))
    return rows_of(table)


def rows_of(table: Path) -> list[dict]:
    """What a table holds."""
    with table.open() as file:
        return list(csv.DictReader(file))


def summary(rows: list[dict]) -> str:
    """Faults by kind: injected, and what became of them."""
    kinds = list(dict.fromkeys(row["fault"] for row in rows))
    lines = ["| fault | injected | same to the bit | refused | lost | silent |", "|---" * 6 + "|"]
    for kind in kinds:
        own = [row["outcome"] for row in rows if row["fault"] == kind]
        counts = [sum(one.startswith(outcome) for one in own) for outcome in OUTCOMES]
        lines.append(f"| {kind} | {len(own)} | " + " | ".join(map(str, counts)) + " |")
    return "\n".join(lines)


def main() -> None:
    """Inject what is missing; print the table."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path, help="where the table is kept")
    parser.add_argument("--kills", type=int, default=200, help="processes to kill")
    parser.add_argument("--step", type=int, default=1, help="flip every so many bytes")
    given = parser.parse_args()
    print(summary(campaign(given.folder, given.kills, given.step)))


if __name__ == "__main__":
    main()
