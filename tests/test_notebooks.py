"""The notebooks run, and what is committed of them is clean."""

import json
import re
import sys
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
manager = pytest.importorskip("jupyter_client.manager")
kernelspec = pytest.importorskip("jupyter_client.kernelspec")
pytest.importorskip("ipykernel")

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))
ABSOLUTE_PATH = re.compile(
    r"(?<![\w.:/~-])/(home|root|work|tmp|Users|usr|opt|var|private|mnt)/|\b[A-Z]:\\\\?\w"
)
notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)

SLOW = {"02_fourier_flow", "04_cooling_fluctuations", "05_sensitivities_and_calibration"}
"""Two minutes of CPU time even when small: heat diffuses across five slabs, modes decay slowly."""
executed = pytest.mark.parametrize(
    "path",
    [
        pytest.param(p, id=p.stem, marks=pytest.mark.slow if p.stem in SLOW else ())
        for p in NOTEBOOKS
    ],
)


def kernel_of_this_interpreter(folder: Path):
    """A kernel manager for `sys.executable`, whatever kernels are installed."""
    (folder / "kernels" / "this").mkdir(parents=True)
    command = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    spec = {"argv": command, "display_name": "this", "language": "python"}
    (folder / "kernels" / "this" / "kernel.json").write_text(json.dumps(spec))
    specs = kernelspec.KernelSpecManager(
        kernel_dirs=[str(folder / "kernels")], ensure_native_kernel=False
    )
    return manager.AsyncKernelManager(kernel_name="this", kernel_spec_manager=specs)


def text_outputs(book):
    """Text of all outputs, pictures left out."""
    for cell in book.cells:
        for output in cell.get("outputs", []):
            yield output.get("text", "")
            for kind, data in output.get("data", {}).items():
                if not kind.startswith("image/"):
                    yield data


def test_there_are_notebooks():
    assert NOTEBOOKS


@executed
def test_notebook_runs(path, tmp_path, monkeypatch):
    """All cells, at the small size, in an empty folder; an error in a cell is raised here."""
    for name in ("IPYTHONDIR", "JUPYTER_RUNTIME_DIR", "JUPYTER_CONFIG_DIR", "MPLCONFIGDIR"):
        monkeypatch.setenv(name, str(tmp_path / name))
    monkeypatch.setenv("JDSMC_NOTEBOOK_SIZE", "small")
    monkeypatch.setenv("XLA_FLAGS", "--xla_backend_optimization_level=0")  # compiles faster
    work = tmp_path / "work"
    work.mkdir()
    book = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(
        book,
        km=kernel_of_this_interpreter(tmp_path),
        timeout=300,
        resources={"metadata": {"path": str(work)}},
    ).execute()
    assert not list(work.iterdir()), "the notebook left files behind"


@notebook
def test_committed_outputs(path):
    """Every code cell was executed, in order, without errors; no folder of its author is shown."""
    book = nbformat.read(path, as_version=4)
    nbformat.validate(book)
    code = [cell for cell in book.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    outputs = [output for cell in code for output in cell.outputs]
    assert outputs
    assert not [o for o in outputs if o.output_type == "error" or o.get("name") == "stderr"]
    for text in text_outputs(book):
        assert not ABSOLUTE_PATH.search(text)
        assert str(Path.home()) not in text
    assert path.stat().st_size < 600_000
