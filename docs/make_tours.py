"""Write the tours from the notebooks, with the outputs that are stored in these."""

import base64
import json
import re
from pathlib import Path

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"

NOTE = """\
:::{note}
Made from `notebooks/%s`, run as a whole. Open it in Jupyter to change things:
`pip install "jdsmc[notebooks]" jupyterlab`, `jupyter lab notebooks`.
:::"""


def write(folder: Path) -> None:
    """One page a notebook, and the pictures of it, into a folder."""
    folder.mkdir(exist_ok=True)
    for notebook in sorted(NOTEBOOKS.glob("*.ipynb")):
        name = f"tour_{notebook.stem}"
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        parts, pictures = [], 0
        for cell in cells:
            source = "".join(cell["source"]).strip()
            if cell["cell_type"] == "markdown":
                parts.append(linked(source))
                continue
            parts.append(f"```python\n{source}\n```")
            for output in cell["outputs"]:
                found = output.get("data", {})
                if "image/png" in found:
                    pictures += 1
                    picture = f"{name}_{pictures}.png"
                    (folder / picture).write_bytes(base64.b64decode(found["image/png"]))
                    parts.append(f"![Output of the code above]({picture})")
                else:
                    parts.append(text_of("".join(output.get("text", found.get("text/plain", "")))))
        title, *rest = "\n\n".join(parts).split("\n", 1)
        page = "\n\n".join([title, NOTE % notebook.name, *rest])
        (folder / f"{name}.md").write_text(page + "\n", encoding="utf-8")


def text_of(output: str) -> str:
    """What a cell printed."""
    return f":::{{code-block}} text\n:class: made-output\n\n{output.rstrip()}\n:::"


def linked(source: str) -> str:
    """Markdown of a notebook, whose mentions of notebooks and pages lead to pages of the site."""
    source = re.sub(r"`(?:notebooks/)?(\d\d_\w+)\.ipynb`", r"[](tour_\1.md)", source)
    return re.sub(r"`?docs/(\w+\.md)`?", r"[](../\1)", source)
