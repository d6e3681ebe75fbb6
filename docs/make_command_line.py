"""Write the page of the command line: what `jdsmc` and its commands say of themselves."""

import contextlib
import io
import os
from pathlib import Path

from jdsmc.cli import main
from jdsmc.cli.catalogue import scenes

HEAD = """\
# Command line

Made from what `jdsmc` prints. Options are the fields of scenes and gases and the arguments of
`jdsmc.run`. Numbers of `jdsmc sweep` may be ranges, `first:last:step`, and lists with commas. Exit
status: 0; 1 for a run that cannot be trusted; 2, with one sentence, for bad input; 130 after Ctrl-C
outside a run."""


def write(folder: Path) -> None:
    """The page, into a folder."""
    folder.mkdir(exist_ok=True)
    parts = [HEAD, said(), "## Other commands"]
    parts += [said(name, "--help") for name in ("resume", "merge", "show", "plot", "theory")]
    parts += [said("fit", "beta", "--help")]
    for name in scenes():
        parts += [f"## `jdsmc run {name}`", said("run", name, "--help")]
    (folder / "command_line.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")


def said(*words: str) -> str:
    """What a command prints."""
    os.environ["COLUMNS"] = "92"
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        assert main(list(words)) == 0
    return f"```text\n$ {' '.join(('jdsmc', *words))}\n{out.getvalue().rstrip()}\n```"
