"""Copy, cut, paste, duplicate: elements travel as SMSL text on the system's clipboard.

So they go to another window, another process or an editor, and any SMSL text comes in from there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QMimeData, QPointF
from PySide6.QtGui import QCursor, QGuiApplication
from PySide6.QtWidgets import QApplication, QLineEdit, QPlainTextEdit, QTextEdit, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.errors import EditRefused, StudioError
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.free_places import on_grid

KIND = "text/x-smsl"
MOST = 64 * 2**20
"""Bytes: who pastes more than this means a file."""

Put = tuple[Blueprint, tuple[Address, ...]]
"""A blueprint with something put in, and where that stands."""

Texts = QLineEdit | QPlainTextEdit | QTextEdit


class ClipboardVerbs:
    """The verbs on the selection; where a text is being edited they are the text's own.

    ``say`` tells what was copied; what is refused is told by the session.
    """

    def __init__(self, session: Session, canvas: Canvas, say: Callable[[str], object]) -> None:
        self._session, self._canvas, self._say = session, canvas, say

    def can_copy(self) -> bool:
        """Whether something is selected, or a text is being edited."""
        return bool(self._session.selection) or _text_focus() is not None

    def can_duplicate(self) -> bool:
        """Whether something is selected."""
        return bool(self._session.selection)

    def copy(self) -> None:
        """Put the selection onto the clipboard."""
        field = _text_focus()
        if field is not None:
            field.copy()
        else:
            self._copy(self._session.selection)

    def cut(self) -> None:
        """Copy the selection and take it away, as one step."""
        field = _text_focus()
        if field is not None:
            field.cut()
        else:
            self._cut(self._session.selection)

    def paste(self, at: QPointF | None = None) -> None:
        """Put in what is on the clipboard: at a scene point, else at the pointer, else in the
        middle of what is seen.
        """
        field = _text_focus()
        if field is not None and at is None:
            field.paste()
        else:
            self._paste(at)

    def duplicate(self) -> None:
        """A copy of the selection beside it."""
        self._duplicate(self._session.selection)

    def on_branch(self, verb: str, name: str) -> None:
        """Copy, cut or duplicate a whole SB, or paste beside it."""
        chosen = (Address(name),)
        if verb == "paste" or name not in self._session.blueprint.branches:
            self._paste(None)
        else:
            {"copy": self._copy, "cut": self._cut, "duplicate": self._duplicate}[verb](chosen)

    def _copy(self, chosen: Sequence[Address]) -> None:
        text = self._excerpt(chosen)
        if text:
            _put(text)
            self._say(f"Copied {_what(chosen)}.")

    def _cut(self, chosen: Sequence[Address]) -> None:
        text = self._excerpt(chosen)
        if text and self._session.edit(
            f"Cut {_what(chosen)}", lambda bp: editing.delete(bp, chosen)
        ):
            _put(text)

    def _paste(self, at: QPointF | None) -> None:
        place = on_grid(at if at is not None else self._place())
        branch = self._session.branch
        self._put_in("Paste", lambda bp: _pasted(bp, branch, _taken(), place))

    def _duplicate(self, chosen: Sequence[Address]) -> None:
        self._put_in("Duplicate", lambda bp: editing.duplicate(bp, chosen))

    def _put_in(self, verb: str, change: Callable[[Blueprint], Put]) -> None:
        """One step; what came in is shown and selected."""
        session = self._session
        session.settling.emit()
        try:
            after, made = change(session.blueprint)
        except StudioError as error:
            session.refused.emit(error)
            return
        if not session.edit(f"{verb} {_what(made)}", lambda _: after):
            return
        session.show_branch(made[0].branch)
        session.select(address for address in made if address.state)
        self._canvas.reveal(made[0])
        self._canvas.setFocus()

    def _excerpt(self, chosen: Sequence[Address]) -> str:
        if not chosen:
            return ""
        try:
            return editing.excerpt(self._session.blueprint, chosen)
        except StudioError as error:
            self._session.refused.emit(error)
            return ""

    def _place(self) -> QPointF:
        """The pointer, where it is over the canvas; else the middle of the view."""
        view = self._canvas.viewport()
        at = view.mapFromGlobal(QCursor.pos())
        over = view.rect().contains(at) and self._canvas.isActiveWindow()
        return self._canvas.mapToScene(at if over else view.rect().center())


def _pasted(
    blueprint: Blueprint, branch: str, text: str, at: tuple[float, float]
) -> tuple[Blueprint, tuple[Address, ...]]:
    """States that are pasted where there is no SB bring one along."""
    if branch in blueprint.branches:
        return editing.paste(blueprint, branch, text, at)
    name = fresh_branch_name(blueprint)
    after, made = editing.paste(editing.add_branch(blueprint, name), name, text, at)
    if any(address.branch == name for address in made):
        return after, made
    return editing.paste(blueprint, branch, text, at)


def _put(text: str) -> None:
    data = QMimeData()
    data.setText(text)
    data.setData(KIND, text.encode())
    QGuiApplication.clipboard().setMimeData(data)


def _taken() -> str:
    """The text on the clipboard; EditRefused where there is none."""
    data = QGuiApplication.clipboard().mimeData()
    raw = bytes(data.data(KIND).data()) if data is not None and data.hasFormat(KIND) else b""
    text = raw.decode("utf-8", "replace") if raw else (data.text() if data is not None else "")
    if not text.strip():
        raise EditRefused(
            "the clipboard holds no text",
            advice="Copy states, operations or State Branches, or the text of an SMSL file.",
        )
    if len(text) > MOST:
        raise EditRefused(
            "the clipboard holds more text than is pasted at once",
            advice="Save it as a file and open or import that.",
        )
    return text


def _text_focus() -> Texts | None:
    """The text field that has the focus: there the keys and menus mean its own text."""
    field: QWidget | None = QApplication.focusWidget()
    return field if isinstance(field, QLineEdit | QPlainTextEdit | QTextEdit) else None


def _what(chosen: Sequence[Address]) -> str:
    """What is chosen, as a step names it."""
    if len(chosen) == 1:
        return chosen[0].path[-1]
    states = sum(1 for address in chosen if address.state and not address.operation)
    if states == len(chosen):
        return counted(states, "state")
    return counted(len(chosen), "element" if states else "operation")
