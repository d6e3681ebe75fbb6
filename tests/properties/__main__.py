"""The full search: `python -m tests.properties [--page FILE] [options of pytest]`."""

import os
import sys
import time
from pathlib import Path

import pytest

os.environ["PROPERTIES"] = "full"


def main(words: list[str]) -> int:
    """Search; write the page if every property held. The exit status is that of pytest."""
    path = None
    if "--page" in words:
        place = words.index("--page")
        path = Path(words[place + 1])
        words = words[:place] + words[place + 2 :]
    status = pytest.main(["-q", "-p", "no:cacheprovider", str(Path(__file__).parent), *words])
    if status == 0 and path is not None:
        from . import effort  # noqa: PLC0415 - as the tests imported it, under PROPERTIES

        path.write_text(effort.page(time.process_time()), encoding="utf-8")
    return int(status)


sys.exit(main(sys.argv[1:]))
