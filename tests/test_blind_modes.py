"""The blind test of the modes' estimator on simulated gases; see `blind_modes`."""

import pytest

from .blind_modes import SEEDS, campaign, summary


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["cells", "dynamics"])
def test_blind(kind, tmp_path):
    """20 seeds: mean score within 0.5 (its own error is 0.25), coverage of 2 errors at least 88%.

    All three observables count for the coverage: with 8 blocks each Student's t leaves 8% outside.
    """
    if kind == "dynamics":
        pytest.importorskip("numba")
    found = summary(campaign(tmp_path / "modes.csv", (kind,)))
    for alpha in (0.8, 1.0):
        rows = {where: row for where, row in found.items() if where[1] == alpha}
        assert len(rows) == 3 and all(row[0] == SEEDS for row in rows.values())
        for where, (_, mean, _, _) in rows.items():
            assert abs(mean) < 0.5, where
        assert sum(row[2] for row in rows.values()) / 3 >= 0.88
