"""The bar above the text that finds and replaces."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QPushButton, QToolButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.draw.source.editor import Editor
from smsl_studio.studio.features.draw.source.find import Found, Match, TextSearch, find, replaced

_OURS = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_F3, Qt.Key.Key_Escape)
WAIT = 60
"""Milliseconds after a change of the text before it is searched again."""


class FindBar(QWidget):
    """Finds and replaces in one editor.

    Enter goes to the next match, Shift+Enter back, Esc closes.
    """

    changed = Signal()
    """The matches have changed."""

    def __init__(self, editor: Editor) -> None:
        super().__init__()
        self.setProperty("role", "bar")
        self._editor, self.found = editor, Found()
        self.words, self.other = _field("Find"), _field("Replace with")
        # The fault of an expression can be long; it must not widen the pane.
        self.count = Elided()
        self.count.setProperty("role", "hint")
        self._done = ""
        self.case = self._toggle("Aa", "Match case")
        self.whole = self._toggle("W", "Whole words")
        self.regular = self._toggle(".*", "Regular expression")
        self.back = self._step("chevron-up", "Previous (Shift+F3)", lambda: self.step(-1))
        self.on = self._step("chevron-down", "Next (F3)", lambda: self.step(1))
        self.shut = self._step("close", "Close (Esc)", self.close_bar)
        self.one, self.every = QPushButton("Replace"), QPushButton("All")
        self.every.setToolTip("Replace all, as one step")
        self.every.setAccessibleName("Replace all")
        self._second = QWidget()
        self._build()
        self._again = QTimer(self)
        self._again.setSingleShot(True)
        self._again.setInterval(WAIT)
        self._again.timeout.connect(self.look)
        editor.document().contentsChange.connect(lambda *_: self._text_changed())
        self.words.textChanged.connect(lambda *_: self._ask())
        self.one.clicked.connect(self.replace_one)
        self.every.clicked.connect(self.replace_all)
        self.hide()

    def _build(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 6)
        column.setSpacing(6)
        column.addLayout(row(self.words, self.back, self.on, self.shut, spacing=2))
        column.addLayout(row(self.case, self.whole, self.regular, 2, self.count, spacing=2))
        self._second.setLayout(row(self.other, self.one, self.every, spacing=6))
        column.addWidget(self._second)
        for part in (self.one, self.every):
            part.setProperty("role", "row")
        for field in (self.words, self.other):
            field.installEventFilter(self)
        # Tab goes from the search to the replacement, then to the buttons.
        stops = (self.words, self.other, self.one, self.every, self.back, self.on, self.shut,
                 self.case, self.whole, self.regular)  # fmt: skip
        for before, after in pairwise(stops):
            self.setTabOrder(before, after)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for button, name in ((self.back, "chevron-up"), (self.on, "chevron-down"),
                             (self.shut, "close")):  # fmt: skip
            button.setIcon(icon(name, tokens))

    @property
    def search(self) -> TextSearch:
        """What to search for, as set in the bar."""
        return TextSearch(
            self.words.text(), self.case.isChecked(), self.whole.isChecked(),
            self.regular.isChecked(),
        )  # fmt: skip

    def open_bar(self, replacing: bool) -> None:
        """Show the bar with the selected text as search, and give it the keyboard focus."""
        marked = self._editor.textCursor().selectedText()
        if marked and "\u2029" not in marked:
            self.words.setText(marked)
        self._second.setVisible(replacing and not self._editor.isReadOnly())
        self.show()
        self.words.setFocus()
        self.words.selectAll()
        self.look()

    def close_bar(self) -> None:
        """Close the bar, forget the matches and give the text the keyboard focus."""
        self.hide()
        self.found = Found()
        self.changed.emit()
        self._editor.setFocus()

    def look(self) -> None:
        """Search the whole text."""
        if not self.isHidden():
            self.found = find(self._editor.sheet.text, self.search)
            self._say()
            self.changed.emit()

    def step(self, by: int) -> None:
        """Select the next match (1) or the previous one (-1); after the last comes the first."""
        if self.isHidden() and self.words.text():
            self.show()
        self.look()
        matches = self.found.matches
        if not matches:
            return
        start, end = self._editor.marked
        if by > 0:
            after = (
                one for one in matches if one.start >= end and (one.start, one.end) != (start, end)
            )
            self._go(next(after, matches[0]))
        else:
            before = (one for one in reversed(matches) if one.end <= start)
            self._go(next(before, matches[-1]))

    def replace_one(self) -> None:
        """Replace the selection if it is a match, and go to the next match."""
        match = self._current()
        if match is not None and not self._editor.isReadOnly():
            part = replaced(match, self.other.text(), self.search)
            self._editor.begin_command()
            self._editor.replace(match.start, match.end, part, "Replace", match.start + len(part))
        self.step(1)

    def replace_all(self) -> None:
        """Replace all matches as one step."""
        self.look()
        search, editor = self.search, self._editor
        if not self.found.matches or editor.isReadOnly():
            return
        parts = [(one.start, one.end, replaced(one, self.other.text(), search))
                 for one in self.found.matches]  # fmt: skip
        editor.begin_command()
        editor.apply(parts[::-1])
        editor.typed.emit(f"Replace {counted(len(parts), 'place')}")
        editor.begin_command()
        self._done = f"{len(parts):,} replaced"
        self.look()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Handle Enter, Escape and F3 in both fields."""
        if isinstance(event, QKeyEvent) and event.key() in _OURS:
            if event.type() == QEvent.Type.ShortcutOverride:
                event.accept()
                return True
            if event.type() == QEvent.Type.KeyPress:
                self._answer(event, watched is self.other)
                return True
        return super().eventFilter(watched, event)

    def _answer(self, event: QKeyEvent, replacing: bool) -> None:
        back = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        if event.key() == Qt.Key.Key_Escape:
            self.close_bar()
        elif replacing and event.key() != Qt.Key.Key_F3:
            self.replace_one()
        else:
            self.step(-1 if back else 1)

    def _text_changed(self) -> None:
        if not self.isHidden():
            self._again.start()

    def _ask(self) -> None:
        """Search again, and go to the first match from the caret on."""
        self._done = ""
        self.look()
        matches, start = self.found.matches, self._editor.marked[0]
        if matches:
            self._go(next((one for one in matches if one.start >= start), matches[0]))

    def _current(self) -> Match | None:
        marked = self._editor.marked
        return next((one for one in self.found.matches if (one.start, one.end) == marked), None)

    def _go(self, match: Match) -> None:
        self._editor.set_caret(match.start, match.end)
        self._editor.bring_into_view(self._editor.sheet.where(match.start)[0])
        self._say()

    def _say(self) -> None:
        found = self.found
        current = self._current()
        total = f"{len(found.matches):,}" + (" or more" if found.more else "")
        if found.fault:
            said = found.fault
        elif not self.words.text():
            said = ""
        elif not found.matches:
            said = self._done or "Not found"
        elif current is not None:
            said = f"{found.matches.index(current) + 1:,} of {total}"
        else:
            said = f"{total} found"
        self.count.setText(said)
        self.count.setToolTip(tip_text(said))

    def _toggle(self, words: str, name: str) -> QToolButton:
        made = QToolButton()
        made.setText(words)
        made.setCheckable(True)
        made.setProperty("role", "small")
        made.setFixedSize(28, 24)
        made.setToolTip(tip_text(name))
        made.setAccessibleName(plain_text(name))
        made.toggled.connect(lambda _: self._ask())
        return made

    def _step(self, picture: str, name: str, call: Callable[[], None]) -> QToolButton:
        made = QToolButton()
        made.setProperty("role", "small")
        made.setProperty("picture", picture)
        made.setFixedSize(26, 28)
        made.setToolTip(tip_text(name))
        made.setAccessibleName(plain_text(name.partition(" (")[0]))
        made.clicked.connect(call)
        return made


def _field(words: str) -> QLineEdit:
    made = QLineEdit()
    made.setPlaceholderText(words)
    made.setAccessibleName(plain_text(words))
    return made
