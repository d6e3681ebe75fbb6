"""What a run raises."""

from typing import Any


class FaultError(RuntimeError):
    """A run that cannot be trusted. `result` holds what was measured before, if anything."""

    result: Any = None


class NotSteadyError(FaultError):
    """No steady state was found within the budget."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C or SIGTERM, within what takes several runs. `result` is that of the run it ended."""

    result: Any = None


def unbroken(result: Any) -> Any:
    """The result of one of several runs; Interrupted if a signal ended it."""
    if result.interrupted:
        error = Interrupted(f"{result.attrs['scene']}: {result.attrs['stopped']}")
        error.result = result
        raise error
    return result
