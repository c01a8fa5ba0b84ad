"""The command palette: type a few letters, run a command or go to a state or operation."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import QEvent, QModelIndex, QObject, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QLineEdit, QVBoxLayout, QWidget
from shiboken6 import isValid

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.actions import Action, Actions, key_words
from smsl_studio.studio.controls import label, rule
from smsl_studio.studio.icons import icon
from smsl_studio.studio.rows import LINE, Row, RowsView
from smsl_studio.studio.session import Session
from smsl_studio.studio.theme import Tokens

WIDTH, MOST_PLACES, MOST_HEIGHT = 420, 40, 392


class Palette(QFrame):
    """A field over a list; Enter runs what is marked, Escape closes."""

    def __init__(self, session: Session, actions: Actions, tokens: Tokens, window: QWidget) -> None:
        super().__init__(window)
        self._session, self._actions = session, actions
        self._before: QWidget | None = None
        self.setProperty("role", "float")
        self.setAccessibleName("Commands")
        self.setFixedWidth(WIDTH)
        self.field = QLineEdit()
        self.field.setPlaceholderText("Find or run a command")
        self.field.setAccessibleName("Find or run a command")
        self._glass = self.field.addAction(
            icon("search", tokens), QLineEdit.ActionPosition.LeadingPosition
        )
        self.list = RowsView(tokens, self)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setAccessibleName("What was found")
        self._none = label("Nothing has this in its name.", "hint")
        self._none.setContentsMargins(12, 8, 12, 8)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(1, 8, 1, 6)
        layout.setSpacing(6)
        top = QVBoxLayout()
        top.setContentsMargins(8, 0, 8, 0)
        top.addWidget(self.field)
        layout.addLayout(top)
        layout.addWidget(rule())
        layout.addWidget(self.list)
        layout.addWidget(self._none)
        self.field.textChanged.connect(lambda *_: self._show())
        self.field.installEventFilter(self)
        self.list.clicked.connect(self._run)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        self._glass.setIcon(icon("search", tokens))
        self.list.set_tokens(tokens)

    def open(self, corner: QPoint) -> None:
        """Open with the upper right corner at ``corner`` (in the window's coordinates)."""
        self._before = self.window().focusWidget()
        self._actions.refresh()
        self.field.clear()
        self._show()
        self.move(max(8, corner.x() - WIDTH), corner.y())
        self.show()
        self.raise_()
        self.field.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def close_palette(self) -> None:
        """Close, and give the focus back to where it was."""
        if self.isVisible():
            self.hide()
            # A field that was open on the canvas has gone when it lost the focus.
            if self._before is not None and isValid(self._before):
                self._before.setFocus()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self.field:
            if event.type() == QEvent.Type.FocusOut and self.isVisible():
                self.hide()
            elif isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
                return self._key(event.key())
        return super().eventFilter(watched, event)

    def _key(self, key: int) -> bool:
        steps = {
            Qt.Key.Key_Down: 1,
            Qt.Key.Key_Up: -1,
            Qt.Key.Key_PageDown: 8,
            Qt.Key.Key_PageUp: -8,
        }
        if key in steps:
            self._step(steps[Qt.Key(key)])
            return True
        if key in {Qt.Key.Key_Return, Qt.Key.Key_Enter}:
            self._run(self.list.currentIndex())
            return True
        if key == Qt.Key.Key_Escape:
            self.close_palette()
            return True
        return False

    def _step(self, by: int) -> None:
        rows = self.list.rows.rows
        lines = [at for at, row in enumerate(rows) if row.kind == LINE]
        if lines:
            at = self.list.currentIndex().row()
            place = lines.index(at) if at in lines else -1
            to = max(0, min(len(lines) - 1, place + by))
            self.list.setCurrentIndex(self.list.rows.index(lines[to]))

    def _run(self, index: QModelIndex) -> None:
        if not index.isValid():
            return
        payload = index.data(Qt.ItemDataRole.UserRole).payload
        self.close_palette()
        if isinstance(payload, Address):
            self._session.jump(payload)
        else:
            self._actions[payload].trigger()

    def _show(self) -> None:
        words = self.field.text().casefold().split()
        fitting = [action for action in self._actions if self._fits(action, words)]
        # What has the words in its own name stands before what only its menu is called.
        fitting.sort(key=lambda action: not all(w in action.words.casefold() for w in words))
        commands = [_command(action) for action in fitting]
        places = list(self._places(words)) if words else []
        rows: list[Row] = []
        if places:
            rows += [Row("In this blueprint", kind="section"), *places]
        if commands:
            rows += [Row("Commands", kind="section"), *commands] if places else commands
        self.list.rows.show(rows)
        self._none.setVisible(not rows)
        self.list.setVisible(bool(rows))
        self.list.setFixedHeight(min(MOST_HEIGHT, self.list.height_of_all()))
        self.adjustSize()
        self._step(1)

    def _fits(self, action: Action, words: list[str]) -> bool:
        said = f"{action.words} {action.menu}".casefold()
        enabled = self._actions[action.id].isEnabled() and action.id != "palette"
        # What is in no menu is found by name, and does not fill the list before that.
        return enabled and bool(words or action.menu) and all(word in said for word in words)

    def _places(self, words: list[str]) -> Iterator[Row]:
        found = 0
        for address, right in self._addresses():
            name = address.path[-1].casefold()
            if all(word in name for word in words):
                yield Row(address.path[-1], address, _icon(address), right=right, tip=str(address))
                found += 1
                if found >= MOST_PLACES:
                    return

    def _addresses(self) -> Iterator[tuple[Address, str]]:
        blueprint = self._session.blueprint
        for branch in blueprint:
            yield branch.address, "State Branch"
        for branch in blueprint:
            for state in branch.table:
                yield Address(branch.name, state), branch.name
        seen = set()
        for branch in blueprint:
            for edge in branch.edges():
                if edge.name not in seen:
                    seen.add(edge.name)
                    yield edge.address, f"{branch.name} / {edge.source}"


def _icon(address: Address) -> str:
    if not address.state:
        return "layers"
    return "arrow" if address.operation else "dot"


def _command(action: Action) -> Row:
    keys = key_words(action.keys[0]) if action.keys else ""
    return Row(action.words.rstrip("…"), action.id, action.icon, right=keys, tip=action.hint)
