"""A reproduction at its tiny size, in a process of its own, where XLA may compile in haste."""

import os
import subprocess
import sys
from pathlib import Path

PROGRAM = """
import sys
from importlib import import_module
from pathlib import Path
main, data, systems = (
    import_module(f"experiments.{sys.argv[1]}.{name}") for name in ("__main__", "data", "systems")
)
folder = Path(sys.argv[2])
for path in main.reproduce(systems.TINY, folder, fresh=False):
    print("made", path)
data.measure(systems.TINY, folder, fresh=False)
"""


def reproduce(experiment: str, folder: Path) -> None:
    """Make every file; assert that simulations were run, and that a second call runs none."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, experiment, str(folder)],
        env=os.environ | {"XLA_FLAGS": "--xla_backend_optimization_level=0"},
        cwd=Path(__file__).parent.parent,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    first, *_, again = done.stdout.split("made ")
    assert "running" in first and "running" not in again
