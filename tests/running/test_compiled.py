"""Compiled programs are kept on disk: found again, the same to the bit, and never in the way."""

import os
import subprocess
import sys
from pathlib import Path

import jax
import pytest

from jdsmc.running import compiled

ROOT = Path(__file__).parents[2]
PROCESS = """
import hashlib, jax, jdsmc
hits = []
jax.monitoring.register_event_listener(
    lambda name, **_: hits.append(name) if name.endswith("/cache_hits") else None
)
gas = jdsmc.InelasticHardSpheres(0.7)
scene = jdsmc.scenarios.UniformShear(gas, 4.0)
result = jdsmc.run(scene, n_particles=64, duration=1.0, progress=False)
print(len(hits), hashlib.sha256(result.series.to_dataframe().to_numpy().tobytes()).hexdigest())
"""


def test_a_second_process_compiles_nothing_and_finds_the_same(tmp_path):
    """The first finds nothing on disk, the second the step at least, and both the same numbers."""
    inherited = {name: x for name, x in os.environ.items() if not name.startswith("JAX_")}
    own = {"JDSMC_COMPILATION_CACHE": str(tmp_path / "programs"), "PYTHONPATH": str(ROOT)}
    found = [
        subprocess.run(
            [sys.executable, "-c", PROCESS],
            env=inherited | own,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.split()
        for _ in range(2)
    ]
    assert int(found[0][0]) == 0 < int(found[1][0])
    assert found[0][1] == found[1][1]


@pytest.fixture
def settings(monkeypatch):
    """A process that has set up nothing: JAX's settings, to be looked at, put back after."""
    before = {name: getattr(jax.config, name) for name in SETTINGS}
    monkeypatch.delenv(compiled.VARIABLE, raising=False)
    jax.config.update(SETTINGS[0], None)
    yield jax.config
    for name, value in before.items():
        jax.config.update(name, value)


SETTINGS = ("jax_compilation_cache_dir", "jax_persistent_cache_min_compile_time_secs")


def test_the_folder_is_in_the_users_cache(settings, monkeypatch, tmp_path):
    """One for each kind of processor: a shared home must not give a program to another one."""
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    compiled.keep_programs()
    folder = Path(settings.jax_compilation_cache_dir)
    assert folder.parent == tmp_path / "jdsmc"
    assert compiled.processor() in folder.name


def test_what_the_user_wants_is_left(settings, monkeypatch, tmp_path):
    """Turned off, in another folder, or JAX's own cache of the user's."""
    monkeypatch.setenv(compiled.VARIABLE, "off")
    compiled.keep_programs()
    assert settings.jax_compilation_cache_dir is None
    monkeypatch.setenv(compiled.VARIABLE, str(tmp_path / "mine"))
    compiled.keep_programs()
    assert settings.jax_compilation_cache_dir == str(tmp_path / "mine")
    settings.update(SETTINGS[0], str(tmp_path / "theirs"))
    compiled.keep_programs()
    assert settings.jax_compilation_cache_dir == str(tmp_path / "theirs")


def test_a_folder_that_cannot_be_made_means_no_cache(settings, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(compiled.VARIABLE, str(tmp_path / "file" / "below"))
    compiled.keep_programs()
    assert settings.jax_compilation_cache_dir is None


def test_room_is_bounded(tmp_path):
    """What was written first goes first; other files stay."""
    for age, name in enumerate(("c-cache", "a-cache", "b-cache", "notes")):
        (tmp_path / name).write_bytes(bytes(100))
        os.utime(tmp_path / name, (age, age))
    compiled.make_room(tmp_path, room=250)
    assert {path.name for path in tmp_path.iterdir()} == {"a-cache", "b-cache", "notes"}
