"""Devices that are asked for and not there."""

import os
import subprocess
import sys

COMMANDS = (
    "from jdsmc.cli.main import main; raise SystemExit(main(['run', 'uniform-shear']))",
    "import jdsmc; jdsmc.run(jdsmc.scenarios.UniformShear(jdsmc.InelasticHardSpheres(0.9), 1.0))",
)


def test_a_platform_that_is_not_here_is_named():
    """On the command line a sentence and status 2, in Python a ValueError, before anything runs."""
    for code, status in zip(COMMANDS, (2, 1), strict=True):
        done = subprocess.run(
            [sys.executable, "-c", code],
            env=os.environ | {"JAX_PLATFORMS": "nowhere"},
            check=False,
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert done.returncode == status
        assert "JAX_PLATFORMS = 'nowhere': JAX finds no such device here" in done.stderr
        assert ("Traceback" in done.stderr) == (status == 1)
