"""Advice for a run that holds because no configuration agrees with the world."""

from __future__ import annotations

from smsl_studio.dispatch.execution.status import DispatchStatus

ADVICE = (
    "To read the scene again helps only after somebody has put this right by hand. "
    "In a simulation nobody can: end the run, and play it again from the start."
)


def hold_advice(status: DispatchStatus) -> str:
    """Return an advice for a run that holds because the facts agree with no configuration.

    It is empty for every other run. Such a hold follows a stop in the middle of an operation, for
    example with a disk in the air. The run does not finish that operation. No other operation
    begins, because the check of its state is false.
    """
    if status.phase != "fault_hold" or status.candidates or status.check is None:
        return ""
    return ADVICE if status.check.misses else ""
