"""The table of the Boltzmann equation."""

import csv

import pytest

from jdsmc.theory import boltzmann


def test_table_and_file(folder, status, capsys):
    """The numbers of `theory.boltzmann`, and in the table only digits that are known."""
    assert status("theory --restitution 0.5,1 --order 12 --out table.csv") == 0
    head, first, second, where = capsys.readouterr().out.splitlines()
    assert "κ/κ0" in head and first.split()[0] == "0.5" and where == "Table: table.csv"
    assert "1.0252(" in second and "1.0160(" in second  # elastic limits 1.025218, 1.016034
    assert "-0.0" not in second
    with (folder / "table.csv").open() as file:
        rows = list(csv.DictReader(file))
    known = boltzmann.navier_stokes(0.5, order=12)
    assert float(rows[0]["conductivity"]) == known.conductivity
    assert float(rows[0]["sonine_2"]) == known.sonine[1]
    assert float(rows[0]["a2_truncation"]) == known.truncation["a2"]


@pytest.mark.parametrize(
    "line, words",
    [
        ("theory --restitution 0.2", "0.3"),
        ("theory --restitution much", "range"),
        ("theory --order 100", "48"),
        ("theory --out /nowhere/table.csv", "does not exist"),
    ],
)
def test_bad_input(status, capsys, line, words):
    assert status(line) == 2
    assert words in capsys.readouterr().err


def test_help(status, capsys):
    assert status("theory --help") == 0
    assert "--restitution" in capsys.readouterr().out
    assert status("") == 0
    assert "jdsmc theory" in capsys.readouterr().out
