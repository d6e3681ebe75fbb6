"""The map of where jdsmc is right, refuses or warns: `python -m tests.stability --out FOLDER`."""
