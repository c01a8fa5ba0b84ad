"""The words for what a run refused: to begin, or to do what was asked."""

from __future__ import annotations

from smsl_studio.errors import RunRefused, StudioError
from smsl_studio.front.approval_badge import refusal_line
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.runlog.events import Commanded, Event, OperationRefused
from smsl_studio.studio.base.words import capital, refusal_words

NOT_APPROVED = "The run does not start, because it is not approved."


def begin_words(error: StudioError) -> str:
    """Why a run does not begin, one reason in each line."""
    codes = error.refusals if isinstance(error, RunRefused) else ()
    lines = [refusal_line(Refusal(*one)) for one in codes]
    return "\n".join([NOT_APPROVED, *lines] if lines else [refusal_words(error)])


def asked_words(event: Event) -> str:
    """Why what was asked for is not done; empty for an event that refuses nothing."""
    if isinstance(event, OperationRefused):
        return "; ".join(map(capital, event.reasons))
    return capital(event.refused) if isinstance(event, Commanded) and event.refused else ""
