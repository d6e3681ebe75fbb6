"""What was injected, and what became of it."""

import csv
from collections.abc import Callable
from pathlib import Path

SAME, TOLD, LOST, SILENT = "same to the bit", "told, nothing lost", "lost", "silent"
"""The result is that of an undisturbed run; a sentence says what is wrong, and what was measured,
or was there before, is still there; it is not; something is wrong and nobody says so."""

OUTCOMES = (SAME, TOLD, LOST, SILENT)
COLUMNS = ("fault", "where", "number", "outcome")

PAGE = """\
# Faults injected

Made by `python -m tests.faults FOLDER --out FILE`; do not edit. Each fault is injected on purpose
(`tests/faults`). Caught: the result is to the bit that of a run that nobody disturbed, or a
sentence says what is wrong and all that was measured is still there. Lost: something that was
measured is gone. Silent: something is wrong, and nobody says so.

"""


class Table:
    """A file of rows, one an injected fault; what it has is not injected again.

    Arguments: the folder; whether each row is printed.
    """

    def __init__(self, folder: Path, say: bool = False):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.say = folder, say
        self.path = folder / "faults.csv"
        if not self.path.exists():
            self.path.write_text(",".join(COLUMNS) + "\n")
        self._done = {(row["fault"], row["where"], int(row["number"])) for row in self.rows()}

    def has(self, fault: str, where: str, number: int) -> bool:
        """True if that was injected before."""
        return (fault, where, number) in self._done

    def note(self, fault: str, where: str, number: int, inject: Callable[[], str]) -> None:
        """Inject a fault unless that was done before; its outcome begins with one of `OUTCOMES`."""
        if self.has(fault, where, number):
            return
        outcome = " ".join(inject().split())
        with self.path.open("a", newline="") as file:
            csv.writer(file).writerow((fault, where, number, outcome))
        self._done.add((fault, where, number))
        if (self.say and number % 100 == 0) or not outcome.startswith(OUTCOMES[:2]):
            print(f"{fault}, {where}, {number}: {outcome}", flush=True)

    def rows(self) -> list[dict]:
        """What was injected so far."""
        with self.path.open(newline="") as file:
            return list(csv.DictReader(file))


def summary(rows: list[dict]) -> str:
    """Faults by kind: where they were injected, how many, and what became of them."""
    kinds = list(dict.fromkeys(row["fault"] for row in rows))
    head = "| fault | injected | caught: same to the bit | caught: told | lost | silent |"
    lines = [head, "|---" * 6 + "|"]
    for kind in kinds:
        lines.append(line(kind, [row for row in rows if row["fault"] == kind]))
    lines.append(line("all", rows))
    return "\n".join(lines)


def line(kind: str, rows: list[dict]) -> str:
    """A line of the table."""
    counts = [sum(row["outcome"].startswith(one) for row in rows) for one in OUTCOMES]
    return f"| {kind} | {len(rows)} | " + " | ".join(map(str, counts)) + " |"


def page(rows: list[dict]) -> str:
    """The table with what it means."""
    within = sum("within a write" in row["outcome"] for row in rows)
    where = len({row["where"] for row in rows if row["fault"] == "SIGKILL"})
    told = (
        f"Processes of {where} scenes were ended, {within} of them while they wrote a checkpoint."
    )
    return f"{PAGE}{summary(rows)}\n\n{told}\n"
