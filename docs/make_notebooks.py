"""Run the notebooks, all or those named, and keep what they show: `python docs/make_notebooks.py`.

Half an hour on two cores.
"""

import base64
import io
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import nbformat
from nbclient import NotebookClient
from PIL import Image

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"
OF_THIS_RUN = ("execution", "collapsed", "scrolled")
"""Metadata of cells that say when or how they were run."""


def run(path: Path) -> None:
    """One notebook, its outputs put in the place of the old ones."""
    book = nbformat.read(path, as_version=4)
    with TemporaryDirectory() as empty:
        NotebookClient(book, timeout=3600, resources={"metadata": {"path": empty}}).execute()
    for cell in book.cells:
        for name in OF_THIS_RUN:
            cell.metadata.pop(name, None)
        if cell.cell_type == "code":  # progress and warnings are no result
            cell.outputs = [one for one in cell.outputs if one.get("name") != "stderr"]
            for output in cell.outputs:
                if "image/png" in output.get("data", {}):
                    output.data["image/png"] = in_few_colours(output.data["image/png"])
    nbformat.write(book, path)


def in_few_colours(picture: str) -> str:
    """A third of the size, for the repository; lines and bands look the same in 256 colours."""
    raw = Image.open(io.BytesIO(base64.b64decode(picture))).convert("RGB")
    small = io.BytesIO()
    raw.quantize(256, dither=Image.Dither.NONE).save(small, format="PNG", optimize=True)
    return base64.b64encode(small.getvalue()).decode()


def main() -> None:
    """Those whose names contain one of the words given."""
    words = sys.argv[1:] or [""]
    for path in sorted(NOTEBOOKS.glob("*.ipynb")):
        if any(word in path.name for word in words):
            print(path.name, flush=True)
            run(path)


if __name__ == "__main__":
    main()
