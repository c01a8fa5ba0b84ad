"""Copy, cut, paste and duplicate elements, as SMSL text on the system's clipboard.

Elements can be pasted in another window, another process or a text editor, and any SMSL text can be
pasted into the drawing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from PySide6.QtCore import QMimeData, QPointF, QRectF
from PySide6.QtGui import QCursor, QGuiApplication
from PySide6.QtWidgets import QApplication, QLineEdit, QPlainTextEdit, QTextEdit, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.pasted_table import is_table
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.errors import EditRefused, StudioError
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted, series
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.free_places import beside_all, on_grid
from smsl_studio.studio.features.draw.canvas.state_copy import StateCopy
from smsl_studio.studio.features.draw.canvas.table_card import TableCard, TablePaste, table_paste

KIND = "text/x-smsl"
MOST = 1_000_000
"""In characters. A longer text is not pasted; it has to be opened as a file."""

LONG = 50_000
"""In characters. A longer table is pasted in the background, and can be called off."""
NO_STATES = StateBranch("SB1", {})
"""The SB that a table makes in a file without SBs."""

Put = tuple[Blueprint, tuple[Address, ...]]
"""The blueprint after an edit, and the addresses of the elements that were put in."""


class NoteCopies(Protocol):
    """The clipboard of notes and groups."""

    def can_copy(self) -> bool:
        """Whether a note or group is selected."""

    def act(self, verb: str, at: tuple[float, float] | None = None) -> bool:
        """Copy, cut, duplicate or paste a note; False if none is meant."""


Texts = QLineEdit | QPlainTextEdit | QTextEdit


class ClipboardVerbs:
    """Copy, cut, paste and duplicate the selection; in a text field they act on its text.

    ``say`` shows what was copied. A refusal is emitted as ``Session.refused``. ``one_state``
    proposes the copy of a single state.
    """

    def __init__(
        self,
        session: Session,
        canvas: Canvas,
        say: Callable[[str], object],
        one_state: StateCopy,
    ) -> None:
        self._session, self._canvas, self._say = session, canvas, say
        self._one_state = one_state
        self.drawn: NoteCopies | None = None
        self.table_card = TableCard(canvas)
        """What a pasted table brings."""
        self.table_card.agreed.connect(self._paste_table)
        self.table_card.closed.connect(self._call_off)
        self._beside = Beside(session)
        self._pasting: TablePaste | None = None
        # What it tells is no longer true then.
        session.blueprint_changed.connect(lambda *_: self.table_card.close_card())
        session.branch_changed.connect(lambda _: self.table_card.close_card())

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def finish(self) -> None:
        """Wait until the work in the background is done."""
        self._beside.wait()

    def can_copy(self) -> bool:
        """Whether an element is selected or a text field has the keyboard focus."""
        return self.can_duplicate() or _text_focus() is not None

    def can_duplicate(self) -> bool:
        """Whether an element is selected."""
        return bool(self._session.selection) or (self.drawn is not None and self.drawn.can_copy())

    def copy(self) -> None:
        """Copy the selection to the clipboard."""
        field = _text_focus()
        if field is not None:
            field.copy()
        elif not self._act("copy"):
            self._copy(self._session.selection)

    def cut(self) -> None:
        """Copy the selection to the clipboard and delete it, as one step."""
        field = _text_focus()
        if field is not None:
            field.cut()
        elif not self._act("cut"):
            self._cut(self._session.selection)

    def paste(self, at: QPointF | None = None) -> None:
        """Paste the clipboard at a scene point.

        Without one at the pointer, or in the middle of the view if the pointer is not over the
        canvas.
        """
        field = _text_focus()
        if field is not None and at is None:
            field.paste()
        else:
            self._paste(at)

    def duplicate(self) -> None:
        """Add a copy of the selection next to it. Of a single state it is proposed first."""
        if self._act("duplicate"):
            return
        if self._one_state.can_ask():
            self._one_state.ask()
        else:
            self._duplicate(self._session.selection)

    def _act(self, verb: str, at: tuple[float, float] | None = None) -> bool:
        """Whether a note was meant, and the verb is done."""
        return self.drawn is not None and self.drawn.act(verb, at)

    def on_branch(self, verb: str, name: str) -> None:
        """Copy, cut or duplicate a whole SB, or paste. ``verb`` is the name of one of these."""
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
        if self._act("paste", place):
            return
        session, branch = self._session, self._session.branch
        session.settling.emit()
        try:
            text = _taken()
        except StudioError as error:
            session.refused.emit(error)
            return
        if is_table(text):
            shown = session.blueprint.branches.get(branch, NO_STATES)
            self.table_card.show_paste(table_paste(shown, text))
        else:
            self._put_in("Paste", lambda bp: _pasted(bp, branch, text, place))

    def _paste_table(self, paste: TablePaste) -> None:
        """Put the states and operations of a table in, after the person said yes."""
        branch = self._session.branch
        self._canvas.setFocus()

        def change(blueprint: Blueprint) -> Put:
            """Paste into the SB that is shown; if there is none, into a new one."""
            if branch in blueprint.branches:
                return editing.paste_states(blueprint, branch, paste.text)
            added = editing.add_branch(blueprint, NO_STATES.name)
            return editing.paste_states(added, NO_STATES.name, paste.text)

        if len(paste.text) > LONG:
            self._paste_beside(paste.begun(), change)
        else:
            self._put_in("Paste", change)

    def _paste_beside(self, paste: TablePaste, change: Callable[[Blueprint], Put]) -> None:
        """Compute the edit in the background, as long as the card stays open."""
        before = self._session.blueprint
        self._pasting = paste
        self.table_card.show_paste(paste)

        def come(put: Put | StudioError) -> None:
            """Make the edit, unless it was called off or something else was typed meanwhile."""
            if self._pasting is not paste:
                return
            self.table_card.close_card()
            if isinstance(put, StudioError):
                self._session.refused.emit(put)
            else:
                self._put_in("Paste", lambda now: put if now is before else change(now))

        self._beside.do(lambda: _tried(lambda: change(before)), come)

    def _call_off(self) -> None:
        if self._pasting is not None:
            self._pasting = None
            self._beside.drop()

    def _duplicate(self, chosen: Sequence[Address]) -> None:
        offset = beside_all(self._canvas, [one.state for one in chosen if not one.operation])
        if offset is None:
            self._put_in("Duplicate", lambda bp: editing.duplicate(bp, chosen))
        else:
            self._put_in("Duplicate", lambda bp: editing.duplicate(bp, chosen, offset))

    def _put_in(self, verb: str, change: Callable[[Blueprint], Put]) -> None:
        """Make the edit as one step, then show and select the elements that were put in."""
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
        states = [address for address in made if address.state and not address.operation]
        session.select(states or (address for address in made if address.operation))
        self._canvas.reveal(made[0])
        self._bring_into_view(states)
        self._canvas.setFocus()

    def _bring_into_view(self, states: Sequence[Address]) -> None:
        """Scroll to new states, or show the whole SB if they need more room than the view has."""
        canvas, rect = self._canvas, QRectF()
        room = canvas.clear_view
        for address in states:
            rect = rect.united(canvas.rect_of(address) or rect)
            if rect.width() > room.width() or rect.height() > room.height():
                canvas.fit()
                return
        if not canvas.seen.contains(rect):
            canvas.camera.keep("")
            canvas.camera.go(rect.center(), canvas.zoom)

    def _excerpt(self, chosen: Sequence[Address]) -> str:
        if not chosen:
            return ""
        try:
            return editing.excerpt(self._session.blueprint, chosen)
        except StudioError as error:
            self._session.refused.emit(error)
            return ""

    def _place(self) -> QPointF:
        """The scene point under the pointer if it is over the canvas, else the middle of the
        view."""
        view = self._canvas.viewport()
        at = view.mapFromGlobal(QCursor.pos())
        over = view.rect().contains(at) and self._canvas.isActiveWindow()
        return self._canvas.mapToScene(at if over else view.rect().center())


def _pasted(
    blueprint: Blueprint, branch: str, text: str, at: tuple[float, float]
) -> tuple[Blueprint, tuple[Address, ...]]:
    """Paste into the SB; if there is none, states are pasted into a new SB."""
    if branch in blueprint.branches:
        return editing.paste(blueprint, branch, text, at)
    name = fresh_branch_name(blueprint)
    after, made = editing.paste(editing.add_branch(blueprint, name), name, text, at)
    if any(address.branch == name for address in made):
        return after, made
    return editing.paste(blueprint, branch, text, at)


def _tried(change: Callable[[], Put]) -> Put | StudioError:
    try:
        return change()
    except StudioError as error:
        return error


def _put(text: str) -> None:
    data = QMimeData()
    data.setText(text)
    data.setData(KIND, text.encode())
    QGuiApplication.clipboard().setMimeData(data)


def _taken() -> str:
    """The text on the clipboard. EditRefused if there is none or too much."""
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
    """The text field with the keyboard focus, or None. In it, these verbs act on its text."""
    field: QWidget | None = QApplication.focusWidget()
    return field if isinstance(field, QLineEdit | QPlainTextEdit | QTextEdit) else None


def _what(chosen: Sequence[Address]) -> str:
    """What is chosen, in the words of an undo step: a name or a count."""
    if len(chosen) == 1:
        return chosen[0].path[-1]
    states = sum(1 for address in chosen if address.state and not address.operation)
    operations = sum(1 for address in chosen if address.operation)
    if states + operations < len(chosen):
        return counted(len(chosen), "element")
    words = [counted(states, "state")] if states else []
    return series([*words, *([counted(operations, "operation")] if operations else [])])
