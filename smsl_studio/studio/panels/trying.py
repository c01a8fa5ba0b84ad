"""One edit from a form: refusals are said beside the field, not somewhere else."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtWidgets import QLabel

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.session import Session
from smsl_studio.studio.words import capital


def try_edit(
    session: Session, words: str, change: Callable[[Blueprint], Blueprint], said: QLabel
) -> bool:
    """Carry out an edit; where it is refused, ``said`` shows why and what to do."""
    try:
        after = change(session.blueprint)
    except StudioError as error:
        said.setText(" ".join(filter(None, (capital(error.sentence), error.advice))))
        said.show()
        return False
    said.hide()
    return session.edit(words, lambda _: after)
