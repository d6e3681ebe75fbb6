"""The fault campaign in small: a process killed, bytes flipped; nothing lost, nothing silent."""

from . import faults


def test_nothing_is_lost_and_nothing_silent(tmp_path, monkeypatch):
    monkeypatch.setattr(faults, "SCENES", {"shear": faults.SCENES["shear"]})
    rows = faults.campaign(tmp_path, kills=1, step=1009)
    kinds = {row["fault"] for row in rows}
    assert kinds == {"SIGKILL", "byte flipped", "cut"}
    assert {row["outcome"] for row in rows} <= set(faults.OUTCOMES[:2])
    flipped = [row for row in rows if row["fault"] == "byte flipped"]
    assert len(flipped) > 30 and all(row["outcome"] == faults.OUTCOMES[1] for row in flipped)
    assert len(faults.campaign(tmp_path, kills=1, step=1009)) == len(rows)  # goes on, repeats none
