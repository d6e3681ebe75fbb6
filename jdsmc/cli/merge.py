"""`jdsmc merge`: several result files as one."""

from ..results.result import load
from ..running.merge import merge as merged
from .arguments import Parser, add_classes, add_files, classes_of
from .keep import check_files, keep


def parser() -> Parser:
    """The options of the command."""
    made = Parser(
        prog="jdsmc merge",
        description="Runs of one scene with other seeds as one with more realizations, or runs at "
        "other values of one number as one sweep.",
    )
    made.add_argument("files", metavar="FILE", nargs="+", help="result files, as --out writes them")
    add_classes(made)
    add_files(made)
    return made


def merge(words: list[str]) -> int:
    """Run the command; the exit status. Raises as `jdsmc.merge` and `jdsmc.load` do."""
    if {"-h", "--help"} & set(words):
        print(parser().format_help(), end="")
        return 0
    asked = parser().parse_args(words)
    check_files(asked.out, asked.plot)
    result = merged([load(file) for file in asked.files], classes_of(asked))
    return keep({"": result}, asked.out, asked.plot, join=False, spare="jdsmc-merged")
