"""One edit from a form: refusals are said beside the field, not somewhere else."""

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
    """Carry out an edit as one step; where it is refused, ``refuse`` is told why and what to do.

    ``refuse`` is told nothing (the empty text) where it was taken.
    """
    # What is still being typed elsewhere comes first, and the edit is made upon it.
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
