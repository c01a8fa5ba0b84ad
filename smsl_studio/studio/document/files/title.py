"""The words of the title bar, and those that tell two files of one name apart."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session


@dataclass(frozen=True)
class Title:
    """The name of what is open, and words about unsaved changes (empty if there are none)."""

    name: str
    edited: str

    def __str__(self) -> str:
        return f"{self.name} ({self.edited})" if self.edited else self.name


def told_apart(name: str, path: Path | None, session: Session) -> str:
    """Words that tell a file from another one with the same name."""
    if path is not None:
        return f"{name} is in {path.parent}."
    states = sum(len(branch.table) for branch in session.blueprint)
    last = session.history.text(session.history.index() - 1) or "As it was opened"
    return f"{name} was never saved. It has {counted(states, 'state')}; the last step is “{last}”."
