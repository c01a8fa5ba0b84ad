"""The panel Facts: the facts of the SB that is shown, as a table that is edited in place."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from PySide6.QtCore import QPoint, QRectF, Qt, Signal
from PySide6.QtGui import (
    QGuiApplication,
    QKeyEvent,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QShowEvent,
)
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.editing import change_notes
from smsl_studio.blueprint.editing.digits import count_of
from smsl_studio.blueprint.editing.fact_table import table_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.errors import EditRefused
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.overlays.change_card import AskedValue, ChangeCard
from smsl_studio.studio.base.passing_menu import passing_menu
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.fact_changes import (
    FactChange,
    addition,
    deletion,
    move,
    paste,
    renaming,
)
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.facts.cells import COLUMNS, MARGIN, WIDE
from smsl_studio.studio.features.draw.facts.fact_lines import (
    MOST,
    PLAIN,
    fact_lines,
)
from smsl_studio.studio.features.draw.facts.view import FactView
from smsl_studio.studio.features.draw.panels.fact_name import fact_name_step
from smsl_studio.studio.features.draw.panels.frame import Panel

HINT = "One sensor or one sub-SB reads a fact. Click a cell to change it."
NONE = "No facts yet."
LOW = 190
"""In a panel lower than this the words below the facts are hidden, so that the facts have more
space (pixels). The button at the tab also adds a fact."""
NEW_VALUE = AskedValue("Its value in them", "Value of the new fact in all states", "0")


class ColumnWords(QWidget):
    """The words above the columns."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.tokens = tokens
        self.setFixedHeight(26)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the words, and a line below them."""
        painter, ink = QPainter(self), TextInk(self.tokens.tx2, 12)
        room = QRectF(MARGIN, 0, self.width() - 2 * MARGIN, self.height() - 1)
        if self.width() < WIDE:
            paint_text(painter, room, "Digit, name, values", ink)
            paint_text(painter, room, "Unit", ink, right=True)
        else:
            for words, share in COLUMNS:
                paint_text(painter, room.adjusted(share * room.width(), 0, 0, 0), words, ink)
        painter.fillRect(0, self.height() - 1, self.width(), 1, self.tokens.line)


class Facts(Panel):
    """The facts of the SB that is shown."""

    fact_wanted = Signal(str, int)
    """(SB, digit): the person wants the form of this fact."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Facts", parent)
        self._session = session
        self.loaded = Loaded()
        """The plugins whose sensors may read the facts."""
        self._shown: StateBranch | None = None
        self._next_row = 0
        self.add_button = SmallButton("Add a fact", "plus", tokens)
        self.words, self.view = ColumnWords(tokens), FactView(tokens)
        self.setFocusProxy(self.view)
        self.none: QLabel = label(NONE, "hint")
        self.first = QPushButton("Add the first fact")
        self.first.setProperty("role", "link")
        self.card = ChangeCard("Change of the facts")
        self.add = QPushButton("Add fact")
        self.hint: QLabel = label(HINT, "hint")
        below = QVBoxLayout()
        below.setContentsMargins(12, 10, 12, 10)
        below.setSpacing(6)
        for widget in (self.none, self.first, self.card):
            below.addWidget(widget)
        below.addLayout(row(self.add, None))
        below.addWidget(self.hint)
        self.column.addWidget(self.words)
        self.column.addWidget(self.view, 1)
        self.column.addLayout(below)
        self.column.addStretch(0)
        for button in (self.add_button, self.first, self.add):
            button.clicked.connect(self.propose_addition)
        # Enter presses the button with the focus.
        self.first.setAutoDefault(True)
        self.add.setAutoDefault(True)
        self.view.typed.connect(self._typed)
        self.view.pressed_cell.connect(self._pressed)
        self.view.moved.connect(self._propose_move)
        self.view.unwanted.connect(self._propose_deletion)
        self.view.menu_wanted.connect(self._open_menu)
        self.card.agreed.connect(self._carry_out)
        self.card.shown.connect(self._make_room)
        self.card.closed.connect(self.view.setFocus)
        session.settling.connect(self.view.settle)
        changed = session.blueprint_changed, session.branch_changed
        session.afterwards.follow(self._show, *changed)
        session.afterwards.follow(self._mark, session.selection_changed)
        self._show()

    @property
    def tools(self) -> QWidget:
        """The button at the tab."""
        return self.add_button

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.words.tokens = tokens
        self.words.update()
        self.view.set_tokens(tokens)
        self.add_button.set_tokens(tokens)

    def showEvent(self, event: QShowEvent) -> None:
        """Show what changed while the panel was hidden."""
        super().showEvent(event)
        self._show()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the words below the facts if the panel is low."""
        super().resizeEvent(event)
        self._make_room(self.card.isVisible())

    def propose_addition(self) -> None:
        """Tell how many states one more fact changes. Without states it is added at once."""
        branch = self._branch
        if branch is None:
            return
        proposal = addition(branch, "")
        if proposal.count or proposal.fault:
            self.card.propose(proposal, lambda value: addition(branch, value), NEW_VALUE)
        else:
            self._carry_out(proposal)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Copy all facts as a table, or paste one."""
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy()
        elif event.matches(QKeySequence.StandardKey.Paste):
            self.propose_paste()
        else:
            super().keyPressEvent(event)

    def copy(self) -> None:
        """Put all facts into the clipboard, as a table for a spreadsheet."""
        if self._shown is not None:
            QGuiApplication.clipboard().setText(table_of(self._shown))

    def propose_paste(self) -> None:
        """Fill the facts from the table in the clipboard. New ones are told first."""
        if self._shown is not None:
            self._ask(paste(self._shown, QGuiApplication.clipboard().text()))

    @property
    def _branch(self) -> StateBranch | None:
        return self._session.blueprint.branches.get(self._session.branch)

    def _show(self) -> None:
        branch = self._branch
        if branch is self._shown or not self.isVisible():
            return
        if branch is None or self._shown is None or branch.name != self._shown.name:
            self.view.settle()
        self._shown = branch
        self.card.close_card()
        lines = fact_lines(branch) if branch is not None else ()
        self.view.show_lines(lines)
        self.words.setVisible(bool(lines))
        self.view.setVisible(bool(lines))
        self.setFocusProxy(self.view if lines else self.first)
        self._make_room(False)
        for widget in (self.none, self.first):
            widget.setVisible(not lines)
        self.none.setText(_none(branch))
        for button in (self.first, self.add_button):
            button.setEnabled(branch is not None)
        count = told_facts(branch) if branch is not None else 0
        rest = f" The first {MOST} of {count:,} facts." if count > MOST else ""
        self.hint.setText(HINT + rest)
        self._mark()

    def _make_room(self, card: bool) -> None:
        """Give the space below the facts to the card while it is open.

        Else give it to facts that need it.
        """
        some = bool(self.view.facts.lines) and self.height() >= LOW
        for widget in (self.add, self.hint):
            widget.setVisible(some and not card)

    def _mark(self) -> None:
        fact = self._session.fact
        if fact is not None and self._shown is not None and fact[0] == self._shown.name:
            if fact[1] < len(self.view.facts.lines):
                self.view.setCurrentIndex(self.view.facts.index(fact[1]))
        elif not self.view.hasFocus() and self.view.looks.edited is None:
            self.view.clearSelection()

    # Changes

    def _typed(self, digit: int, kind: str, value: str, text: str) -> None:
        branch = self._shown
        if branch is None:
            return
        note = branch.fact_note(digit) or PLAIN
        what = f"digit {digit}"
        if kind == "name":
            self._session.edit(*fact_name_step(branch.name, digit, text))
        elif kind == "meaning":
            meanings = {k: v for k, v in note.values.items() if k != value}
            if text:
                meanings = {**note.values, value: text}
            words = f"to “{text}”" if text else "away"
            self._write(digit, {"values": meanings or None},
                        f"Set the meaning of {value} in {what} {words}")  # fmt: skip
        elif kind == "unit":
            self._write(digit, {"unit": text or None}, f"Set the unit of {what}")
        elif kind == "source":
            names = [name for part in text.split(",") if (name := part.strip())]
            self._write(digit, {"sensors": names or None}, f"Set the sensors of {what}")
        elif kind == "age":
            self._write(digit, {"max_age": _seconds(text)}, f"Set the maximum age of {what}")
        # The next cell is looked for among the new ones.
        self._session.afterwards.catch_up()

    def _write(self, digit: int, words: Mapping[str, Any], step: str) -> None:
        if self._shown is None:
            return
        changes = {(self._shown.name, str(digit)): words}

        def change(blueprint: Blueprint) -> Blueprint:
            """The blueprint with the changed entry; refused for an age that is no number."""
            if isinstance(words.get("max_age"), str):
                raise EditRefused(f"{words['max_age']!r} is no number of seconds",
                                  advice="Write a number above 0, such as 0.5.")  # fmt: skip
            return change_notes(blueprint, "_facts", changes)

        self._session.edit(step, change)

    def _pressed(self, digit: int, kind: str, value: str, at: QPoint) -> None:
        branch = self._shown
        if branch is None:
            return
        note = branch.fact_note(digit) or PLAIN
        if kind in ("digit", "more"):
            self.fact_wanted.emit(branch.name, digit)
        elif kind == "rename":
            self._propose_value(digit, value)
        elif kind == "sub":
            self._session.show_branch(branch.subs.get(digit, ""))
        elif kind == "critical":
            words = f"Let digit {digit} be critical" if not note.critical else (
                f"Let digit {digit} be not critical")  # fmt: skip
            self._write(digit, {"critical": None if note.critical else True}, words)
        else:
            self._open_value_menu(branch, digit, value, at)

    def _open_value_menu(self, branch: StateBranch, digit: int, value: str, at: QPoint) -> None:
        menu = passing_menu(self.window(), f"Value {value} of digit {digit}")
        note, on = branch.fact_note(digit) or PLAIN, branch.on_value(digit) == value
        default = branch.default_on_value(digit) == value
        chosen = None if note.on == value or default else value
        failing = value in note.failure
        left = [one for one in note.failure if one != value] + ([] if failing else [value])
        for words, checked, change, step in (
            ("counts as on", on, {"on": chosen}, "counts as on"),
            ("means failure", failing, {"failure": left or None}, "means failure"),
        ):
            entry = menu.addAction(as_it_is(f"{value} {words}"))
            entry.setCheckable(True)
            entry.setChecked(checked)
            entry.triggered.connect(
                lambda _, change=change, step=step: self._write(
                    digit, change, f"Set what {step} in digit {digit}"
                )
            )
        menu.addSeparator()
        again = menu.addAction(as_it_is(f"Rename {value}…\tF2"))
        again.triggered.connect(lambda: self._propose_value(digit, value))
        menu.popup(at)

    def _propose_value(self, digit: int, value: str) -> None:
        """Ask for another name of a value, and tell which states it changes."""
        from smsl_studio.library.by_name import sensors_by_name

        branch = self._shown
        if branch is not None:
            asked = AskedValue("New value", f"New value for {value}", value)
            blueprint = self._session.blueprint
            sensors = sensors_by_name(self.loaded, blueprint, branch, digit)
            again = partial(renaming, branch, digit, sensors, value)
            self.card.propose(again(""), again, asked)

    def _open_menu(self, digit: int, at: QPoint) -> None:
        branch = self._shown
        if branch is None:
            return
        name, last = branch.fact_name(digit), count_of(branch) - 1
        menu = passing_menu(self.window(), f"Digit {digit}")
        form = menu.addAction(as_it_is(f"Form of {name}"))
        form.triggered.connect(lambda: self.fact_wanted.emit(branch.name, digit))
        critical = menu.addAction("Critical")
        critical.setCheckable(True)
        critical.setChecked((branch.fact_note(digit) or PLAIN).critical)
        critical.triggered.connect(lambda: self._pressed(digit, "critical", "", at))
        up, down = menu.addAction("Move up\tAlt+Up"), menu.addAction("Move down\tAlt+Down")
        up.setEnabled(digit > 0)
        down.setEnabled(digit < last)
        up.triggered.connect(lambda: self._propose_move(digit, digit - 1))
        down.triggered.connect(lambda: self._propose_move(digit, digit + 1))
        menu.addAction("Copy all as a table\tCtrl+C").triggered.connect(self.copy)
        menu.addAction("Paste a table\tCtrl+V").triggered.connect(self.propose_paste)
        away = menu.addAction(as_it_is(f"Delete {name}\tDel"))
        away.triggered.connect(lambda: self._propose_deletion(digit))
        menu.popup(at)

    def _propose_move(self, digit: int, place: int) -> None:
        branch = self._shown
        if branch is not None and 0 <= place < count_of(branch) and digit < count_of(branch):
            self._ask(move(branch, digit, place))
            self._next_row = place

    def _propose_deletion(self, digit: int) -> None:
        branch = self._shown
        if branch is not None and digit < count_of(branch):
            self._ask(deletion(branch, digit))

    def _ask(self, proposal: FactChange) -> None:
        if proposal.count or proposal.fault:
            self.card.propose(proposal)
        else:
            self._carry_out(proposal)

    def _carry_out(self, proposal: FactChange) -> None:
        before = len(self.view.facts.lines)
        done = self._session.edit(proposal.step, proposal.change)
        self._session.afterwards.catch_up()
        self.view.setFocus(Qt.FocusReason.OtherFocusReason)
        if done and proposal.verb == "Move fact":
            self.view.setCurrentIndex(self.view.facts.index(self._next_row))
        if done and len(self.view.facts.lines) == before + 1 and proposal.verb == "Add fact":
            self.view.edit_cell(before, "name")


def _none(branch: StateBranch | None) -> str:
    if branch is not None and branch.table and branch.header.num_facts is not None:
        odd = next(iter(branch.shape.misfits), "")
        if odd:
            return f"The names of the states cannot be cut into facts: {odd} does not fit."
    return NONE


def _seconds(text: str) -> float | int | str | None:
    """The number in an age such as ``0.5 s``, None for an empty text, else the text itself."""
    number = text.removesuffix("s").strip()
    try:
        seconds = float(number) if number else None
    except ValueError:
        return text
    return int(seconds) if seconds is not None and seconds == seconds // 1 else seconds
