"""The full search: `python -m tests.properties`."""

import os
import sys
from pathlib import Path

import pytest

os.environ["PROPERTIES"] = "full"
sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", str(Path(__file__).parent), *sys.argv[1:]]))
