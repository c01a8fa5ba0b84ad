"""Copy, cut, paste and duplicate notes, and the states of groups."""

from __future__ import annotations

import json

from PySide6.QtCore import QMimeData
from PySide6.QtGui import QGuiApplication

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import DrawnNote, validated
from smsl_studio.blueprint.editing.pasted_places import ASIDE
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.drawn.drawn_editor import DrawnEditor

KIND = "application/x-smsl-note"
"""What a copied note is on the clipboard, besides its words as text."""
MOST = 200_000
"""In bytes. Nothing larger is a copied note."""


class DrawnCopies:
    """What the verbs of the clipboard mean while a note or group is selected."""

    def __init__(self, session: Session, canvas: Canvas, drawn: DrawnEditor) -> None:
        self._session, self._canvas, self._drawn = session, canvas, drawn

    def can_copy(self) -> bool:
        """Whether a note or group is selected."""
        return self._drawn.chosen is not None

    def act(self, verb: str, at: tuple[float, float] | None = None) -> bool:
        """Copy, cut or duplicate the selected note, or paste a copied one at a scene point.

        False if no note is meant. For a group its states are selected first, because a copy of
        them has the group too.
        """
        if verb == "paste":
            note = _taken()
            if note is not None and at is not None:
                self._drawn.put_copy(note, at)
            return note is not None
        key = self._drawn.chosen
        if key is None:
            return False
        if key.kind == "group":
            branch, states = self._session.branch, self._drawn.drawn.groups[key.key].states
            self._session.select(Address(branch, state) for state in states)
            return False
        note = self._drawn.drawn.notes[key.key]
        if verb == "duplicate":
            self._drawn.put_copy(note, (note.at[0] + ASIDE[0], note.at[1] + ASIDE[1]), note.state)
            return True
        _put(note)
        if verb == "cut":
            self._drawn.delete()
        return True


def _put(note: DrawnNote) -> None:
    words = {"text": note.text, "author": note.author, "date": note.date}
    data = QMimeData()
    data.setText(note.text)
    data.setData(KIND, json.dumps(words).encode())
    QGuiApplication.clipboard().setMimeData(data)


def _taken() -> DrawnNote | None:
    """The note on the clipboard; None if there is none."""
    data = QGuiApplication.clipboard().mimeData()
    raw = bytes(data.data(KIND).data()) if data is not None and data.hasFormat(KIND) else b""
    try:
        words = json.loads(raw) if len(raw) <= MOST else None
    except ValueError:
        return None
    if not isinstance(words, dict):
        return None
    kept = {key: words[key] for key in ("text", "author", "date") if key in words}
    return validated(DrawnNote, {**kept, "at": [0.0, 0.0]}, (), [])
