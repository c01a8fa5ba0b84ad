"""Advice for a run that holds: what would help, and what is possible now."""

from __future__ import annotations

from smsl_studio.dispatch.execution.status import DispatchStatus, Possible

ADVICE = (
    "To read the scene again helps only if it has changed: somebody has put this right by hand, "
    "or gives another answer. Else end the run, and play it again from the start."
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


WORDS = {"adopt": "adopt where it stands", "resume": "resume", "take_over": "take over"}
"""Offers of a run that holds, as parts of a sentence, in their order."""


def ways_out(status: DispatchStatus) -> str:
    """Return a sentence with what a person can do now about a run that holds.

    An operation is named as a way out only if one may be chosen, or one can be restored.
    """
    excluded = [one for one in status.possible if one.pruned or one.risky]
    offered = {offer.command for offer in status.offers}
    ways = [
        *(["choose an operation"] if any(map(_is_open, status.possible)) else ()),
        *(["restore an operation"] if excluded or "restore" in offered else ()),
        *(words for command, words in WORDS.items() if command in offered),
        "end the run",
    ]
    said = f"{', '.join(ways[:-1])} or {ways[-1]}" if ways[1:] else ways[0]
    return f"{said[0].upper()}{said[1:]}."


def _is_open(item: Possible) -> bool:
    return item.permitted and not item.pruned and not item.risky
