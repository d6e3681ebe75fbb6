"""Every study: its claims are measured, its page is complete, its sizes hold what it needs."""

import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments import claims, paper
from experiments.__main__ import PAPERS, cli, load
from experiments.fourier_flow_gravity import cases as fourier
from experiments.fourier_flow_gravity import effect
from experiments.heat_flux_force import cases as heat
from experiments.uniform_shear_flow import cases as shear

ROOT = Path(__file__).parents[2]

COUNTS = {
    "uniform_shear_flow": (114, 19),
    "heat_flux_force": (21, 12),
    "fourier_flow_gravity": (35, 10),
    "conduction_limits": (0, 0),
    "conduction_limits.convergence": (0, 1),
    "cooling_fluctuations": (21, 7),
    "calibration": (3, 1),
}
"""Claims and figures: none may get lost."""


@pytest.mark.parametrize("name", PAPERS)
def test_nothing_is_lost(name):
    paper = load(name)
    keys = [claim.key for group in paper.claims.values() for claim in group]
    assert (len(keys), len(paper.figures)) == COUNTS[name]
    assert len(set(keys)) == len(keys) and set(keys) <= set(paper.measures)
    asked = set(re.findall(r"\{([^{}\n]+)\}", paper.template)) - {"size", "provenance"}
    assert set(paper.claims) <= asked <= {*paper.claims, *paper.tables}
    assert set(paper.sizes) == {"tiny", "small", "full"}


@pytest.mark.parametrize("name", PAPERS)
def test_figures_of_the_results_are_all_drawn(name):
    """What is committed is what the code makes."""
    paper = load(name)
    kept = {path.stem for path in (paper.folder / "results").glob("*.png")}
    assert set(paper.figures) <= kept


@pytest.mark.parametrize("size", ["small", "full"])
def test_cases_have_names_and_hence_seeds_of_their_own(size):
    found = [
        fourier.cases(load("fourier_flow_gravity").sizes[size]),
        [c for s in heat.studies(load("heat_flux_force").sizes[size]).values() for c in s],
        shear.cases(load("uniform_shear_flow").sizes[size]),
    ]
    for cases in found:
        assert len({case.name for case in cases}) == len(cases)
        assert all(case.options["n_realizations"] >= 8 for case in cases)


@pytest.mark.parametrize("size", ["small", "full"])
def test_sizes_hold_what_the_analysis_needs(size):
    """g = 0 and the states of the figures; the paper's fields, and parts for distributions."""
    amounts = load("fourier_flow_gravity").sizes[size]
    for combination, gravity in fourier.sweeps(amounts).items():
        known = {*effect.table(combination)["gravity"], -0.008}
        assert 0.0 in gravity and set(gravity) <= known and len(gravity) >= 4
    amounts = load("heat_flux_force").sizes[size]
    fields = dict(amounts.fields)
    assert {0.025, 0.05, 0.1} <= set(fields) and {0.3, 0.5, 1.0} <= set(amounts.restitutions)
    assert min(fields.values()) > 1  # errors of a distribution come from the parts
    amounts = load("uniform_shear_flow").sizes[size]
    assert {0.5, 0.7, 0.9} <= set(amounts.transients) and {0.5, 0.9} <= set(amounts.sweep)


def test_full_size_has_every_row_of_the_tables():
    amounts = load("fourier_flow_gravity").sizes["full"]
    rows = {c: effect.table(c)["gravity"] for c in fourier.COMBINATIONS}
    assert sum(map(len, rows.values())) == 51
    for combination, gravity in fourier.sweeps(amounts).items():
        assert set(rows[combination]) <= set(gravity)


def test_commands(capsys):
    """Without a name the studies are listed; a name that is none is refused."""
    for arguments, code in (([], 0), (["no_such_paper"], 2)):
        with pytest.raises(SystemExit) as stopped:
            cli(arguments=arguments)
        assert stopped.value.code == code
    out, err = capsys.readouterr()
    assert all(name in out for name in PAPERS) and "no_such_paper" in err


@pytest.mark.parametrize(
    ("arguments", "size", "made"),
    [
        (["--full"], "full", PAPERS),
        (["all"], "small", PAPERS),
        (["calibration", "--full"], "full", ("calibration",)),
    ],
)
def test_one_command_makes_everything(arguments, size, made, monkeypatch):
    asked = []
    monkeypatch.setattr(
        paper.Paper, "main", lambda own, size, out, fresh: asked.append((own.name, size, fresh))
    )
    cli(arguments=arguments)
    assert asked == [(name, size, False) for name in made]


PROGRAM = """
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from experiments.__main__ import load
paper, folder = load(sys.argv[1]), Path(sys.argv[2])
for path in paper.reproduce("tiny", folder):
    print("made", path)
paper.measure(paper.sizes["tiny"], folder, False)
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", PAPERS)
def test_tiny_reproduction(name, tmp_path):
    """All tables and figures from gases of some hundred particles; a second call simulates nothing.

    In a process of its own, where XLA may compile in haste.
    """
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, name, str(tmp_path)],
        env=os.environ | {"XLA_FLAGS": "--xla_backend_optimization_level=0"},
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    first, *_, again = done.stdout.split("made ")
    assert "running" in first and "running" not in again
    paper = load(name)
    files = [tmp_path / f"{paper.page}.md", *(tmp_path / f"{n}.png" for n in paper.figures)]
    assert all(path.stat().st_size > 500 for path in files)
    text = files[0].read_text()
    assert not re.search(r"^\{.+\}$", text, re.MULTILINE)
    for claim in (claim for group in paper.claims.values() for claim in group):
        assert claim.text.replace("|", "\\|") in text


def test_a_page_from_known_measurements(tmp_path):
    """Claims, tables and versions find their places; a claim is measured once."""
    paper, asked = load("conduction_limits"), []
    found = SimpleNamespace(attrs=_attributes())
    data: Any = SimpleNamespace(verdicts={}, results={"one": found})
    study = type(paper)("conduction_limits", paper.measure)
    study.template = "# T ({size} run)\n\n{provenance}\n\n{Group}\n\n{twice}\n"
    study.claims = {"Group": [claims.Claim("seven", "seven", "1", 7.0, 0.5)]}
    study.measures["seven"] = lambda data: asked.append(1) or np.float64(7.25)
    study.tables["twice"] = lambda data: [str(study.verdicts(data, "Group")[0].measured)] * 2
    text = study.filled(data, "tiny")
    assert text.startswith("# T (tiny run)") and "jdsmc 0.1 at abc" in text
    assert "| seven | 1 | 7 ± 0.5 | 7.25 | agrees |" in text
    assert text.endswith("7.25\n7.25\n") and asked == [1]


def _attributes() -> dict:
    names = ("jdsmc_version", "commit", "jax_version", "backend")
    return dict(zip(names, ("0.1", "abc", "0.9", "cpu"), strict=True)) | {"seconds": 60.0}
