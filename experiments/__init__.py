"""Reproductions of published results, one folder a paper: `python -m experiments.<name>`."""
