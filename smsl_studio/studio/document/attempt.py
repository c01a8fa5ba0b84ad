"""One edit from a form, with its refusal shown beside the field."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.document.session import Session


def try_edit(
    session: Session,
    words: str,
    change: Callable[[Blueprint], Blueprint],
    refuse: Callable[[str], None],
) -> bool:
    """Carry out an edit as one step of the history; returns whether it was accepted.

    If the edit is refused, ``refuse`` gets a sentence with the reason and an advice. If it is
    accepted, ``refuse`` gets the empty text, which hides an older sentence.
    """
    # What is still being typed elsewhere is taken over first, because the edit must build on it.
    session.settling.emit()
    try:
        if session.broken is not None:
            raise session.broken.refusal
        after = change(session.blueprint)
    except StudioError as error:
        refuse(" ".join(filter(None, (capital(error.sentence), error.advice))))
        return False
    refuse("")
    return session.edit(words, lambda _: after)
