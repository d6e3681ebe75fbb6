"""How Sphinx makes the site: `python3 tools/dev.py docs`.

Pages are Markdown. Those in `made/` are written here, before Sphinx reads anything: the reference
from docstrings, the tours from notebooks, the gallery from the results of the experiments. Nothing
is fetched from a network, neither now nor by a reader: formulas become MathML.
"""

import sys
from pathlib import Path

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import make_api  # noqa: E402
import make_command_line  # noqa: E402
import make_gallery  # noqa: E402
import make_tours  # noqa: E402

import jdsmc  # noqa: E402

for maker in (make_api, make_command_line, make_gallery, make_tours):
    maker.write(HERE / "made")

project = "jdsmc"
author = "the jdsmc authors"
copyright = f"2026, {author}"  # the name that Sphinx asks for
release = jdsmc.__version__

extensions = ["myst_parser"]
exclude_patterns = ["made/parts", "*.template.md"]
source_suffix = {".md": "markdown"}
myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 3
suppress_warnings = ["ref.python"]  # two classes of one name in the types of signatures

html_theme = "furo"
html_title = f"jdsmc {release}"
html_static_path = ["static"]
html_css_files = ["jdsmc.css"]
html_show_sphinx = False
html_copy_source = False
html_math_renderer = "mathml"
python_maximum_signature_line_length = 80
pygments_style, pygments_dark_style = "friendly", "native"


def visit_math(translator, node) -> None:
    """A formula as MathML, which browsers draw without a script."""
    block = isinstance(node, nodes.math_block)
    translator.body.append(tex2mathml(node.astext(), as_block=block))
    raise nodes.SkipNode


def setup(app) -> None:
    """Called by Sphinx."""
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_math, None))
