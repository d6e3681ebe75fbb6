"""Several processes, and several devices, give the numbers of one, to the bit."""

import os
import socket
import subprocess
import sys

import jax
import numpy as np
import pytest

import jdsmc
from jdsmc.running import hosts

from ..helpers import differences

SHEAR = "shear --particles 256 --restitution 0.6,0.8 --collisions 20"
DISKS = "molecular-dynamics --particles 160 --density 0.05 --restitution 0.9 --duration 10"


def start(words: str, folder, **environment) -> subprocess.Popen:
    """A process of its own that runs `jdsmc WORDS`."""
    command = [sys.executable, "-m", "jdsmc", *words.split(), "--no-progress"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(command, cwd=folder, env=os.environ | environment, **pipes)


def ended(process: subprocess.Popen) -> str:
    """What a process printed; it must have succeeded."""
    out, err = process.communicate(timeout=500)
    assert process.returncode == 0, err
    return out


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def together(words: str, folder, count: int) -> list[str]:
    """What each of several processes printed that share a run."""
    address = f"127.0.0.1:{free_port()}"
    told = [(address, str(count), str(rank)) for rank in range(count)]
    processes = [start(words, folder, **dict(zip(hosts.BY_HAND, one, strict=True))) for one in told]
    return [ended(process) for process in processes]


@pytest.mark.parametrize(
    "scene", [SHEAR, pytest.param(DISKS, marks=pytest.mark.slow)], ids=["traced", "on the host"]
)
def test_two_processes_are_one(scene, tmp_path):
    """One of them writes; the checkpoint of two goes on with one."""
    verb = "sweep" if "," in scene else "run"
    out, silent = together(
        f"{verb} {scene} --out two.h5 --checkpoint kept.h5 --every 0.01", tmp_path, 2
    )
    assert "two.h5" in out and "two.h5" not in silent  # there the library that connects them speaks
    ended(start(f"{verb} {scene} --out one.h5", tmp_path))
    one, two = (jdsmc.load(tmp_path / f"{name}.h5") for name in ("one", "two"))
    assert not differences(one, two)
    assert not differences(one, jdsmc.resume(tmp_path / "kept.previous.h5", progress=False))


def test_eight_devices_are_one(tmp_path):
    """Forced devices of one processor: all are used, and the numbers are those of one."""
    flags = os.environ.get("XLA_FLAGS", "") + " --xla_force_host_platform_device_count=8"
    scene = SHEAR.replace("0.6,0.8", "0.6")
    both = [
        start(f"run {scene} --out {name}.h5", tmp_path, XLA_FLAGS=flags if name == "eight" else "")
        for name in ("one", "eight")
    ]
    for process in both:
        ended(process)
    assert not differences(*(jdsmc.load(tmp_path / f"{name}.h5") for name in ("one", "eight")))


@pytest.mark.parametrize("total, count", [(5, 1), (5, 2), (5, 3), (2, 4), (8, 8)])
def test_parts_come_back_in_order(total, count, monkeypatch):
    """Whatever their number and that of the processes; float64 to the bit without x64 mode."""
    parts = [
        {"a": np.array([n + 1 / 3, -0.0]), "b": np.uint32(n), "c": np.ones(3, "?")}
        for n in range(total)
    ]
    packed = []
    monkeypatch.setattr(jax, "process_count", lambda: count)
    for rank in range(count):
        monkeypatch.setattr(jax, "process_index", lambda rank=rank: rank)
        monkeypatch.setattr(hosts, "_gathered", lambda text: packed.append(text) or [text] * count)
        hosts.everywhere([parts[n] for n in hosts.own(total)], total)
    monkeypatch.setattr(hosts, "_gathered", lambda text: packed)
    found = hosts.everywhere([parts[n] for n in hosts.own(total)], total)
    assert len(found) == total
    for one, other in zip(parts, found, strict=True):
        assert all(np.array_equal(one[name], other[name]) for name in one)
        assert other["a"].dtype == np.float64


def test_half_an_environment_is_refused(monkeypatch):
    monkeypatch.setenv(hosts.BY_HAND[0], "127.0.0.1:1")
    with pytest.raises(ValueError, match=f"{hosts.BY_HAND[1]} is not set"):
        hosts.join_hosts()
