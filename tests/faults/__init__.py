"""What clusters, disks and bugs do to a run, done on purpose: `python -m tests.faults`."""
