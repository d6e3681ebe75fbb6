"""The fault campaign in small: nothing lost, nothing silent."""

import pytest

from jdsmc.cli import catalogue

from . import damage, device, disk, kills
from .__main__ import campaign
from .table import LOST, OUTCOMES, SILENT, Table, summary

DEVICE = {kind: found for kind, found in device.KINDS.items() if found[0] is device.SHEAR}
DEVICE |= {kind: device.KINDS[kind] for kind in ("particles lost at a wall",)}
KINDS = {*DEVICE, "disk full during a checkpoint", "disk full during a save", "SIGKILL"}
KINDS |= {"read-only folder", "folder that becomes read-only", "checkpoint cut", "result cut"}
KINDS |= {"byte of a checkpoint flipped", "byte of a result flipped"}


def test_nothing_is_lost_and_nothing_silent(tmp_path, monkeypatch):
    """One fault of most kinds, a part of the bytes; a second call repeats none."""
    monkeypatch.setattr(kills, "SCENES", {"shear": kills.SCENES["shear"]})
    monkeypatch.setattr(damage, "CUTS", 10)
    monkeypatch.setattr(device, "KINDS", DEVICE)
    numbers = {"killed": 1, "ended": 0, "step": 499, "times": 1}
    rows = campaign(Table(tmp_path), **numbers)
    assert {row["fault"] for row in rows} == KINDS
    assert all(row["outcome"].startswith(OUTCOMES[:2]) for row in rows), summary(rows)
    assert len([row for row in rows if row["fault"].startswith("byte")]) > 30
    assert campaign(Table(tmp_path), **numbers) == rows


def test_every_scene_is_killed():
    assert kills.SCENES.keys() == catalogue.scenes().keys()


def test_what_is_wrong_is_seen(tmp_path, monkeypatch):
    """Else the test above could not fail: a run that ends well, and one whose result is another."""
    whole = disk.Place(tmp_path / "place")
    assert whole.judged(None) == LOST
    monkeypatch.setattr(disk, "ALL", disk.PART)
    assert whole.judged(disk.Place(tmp_path / "other").whole).startswith(SILENT)


@pytest.mark.parametrize("data", [b"", b"x"])
def test_files_that_are_none(tmp_path, data):
    """Refused with the name of the file, or it counts as silent."""
    path = tmp_path / "x.h5"

    def fail(_):
        raise ValueError("no.")

    assert damage.injected(path, data, None, fail).startswith(SILENT)
