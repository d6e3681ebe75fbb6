"""What a run raises."""

from typing import Any


class FaultError(RuntimeError):
    """A run that cannot be trusted. `result` holds what was measured before, if anything."""

    result: Any = None


class NotSteadyError(FaultError):
    """No steady state was found within the budget."""
