"""`jdsmc merge`: several result files as one."""

from ..results.result import load
from ..running.merge import merge as merged
from .arguments import Parser
from .catalogue import find_class
from .keep import check_files, keep


def parser() -> Parser:
    """The options of the command."""
    made = Parser(
        prog="jdsmc merge",
        description="Runs of one scene with other seeds as one with more realizations, or runs at "
        "other values of one number as one sweep.",
    )
    made.add_argument("files", metavar="FILE", nargs="+", help="result files, as --out writes them")
    made.add_argument("--out", metavar="FILE", help="result file to write (HDF5)")
    made.add_argument("--plot", metavar="PICTURE", help="picture to write (PNG, PDF or SVG)")
    made.add_argument(
        "--class",
        dest="classes",
        metavar="module:Class",
        action="append",
        default=[],
        help="a scene or gas of your own that the runs were made with",
    )
    return made


def merge(words: list[str]) -> int:
    """Run the command; the exit status. Raises as `jdsmc.merge` and `jdsmc.load` do."""
    if {"-h", "--help"} & set(words):
        print(parser().format_help(), end="")
        return 0
    asked = parser().parse_args(words)
    check_files(asked.out, asked.plot)
    classes = tuple(find_class(name) for name in asked.classes)
    result = merged([load(file) for file in asked.files], classes)
    return keep({"": result}, asked.out, asked.plot, join=False, spare="jdsmc-merged")
