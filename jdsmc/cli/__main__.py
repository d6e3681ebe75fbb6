"""`python -m jdsmc.cli` is `jdsmc`."""

import sys

from .main import main

if __name__ == "__main__":
    sys.exit(main())
