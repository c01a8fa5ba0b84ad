"""The search box: type a few letters, then go to a place or run a command."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QModelIndex, QObject, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QLineEdit, QVBoxLayout, QWidget
from shiboken6 import isValid

from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.controls import label, rule
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.rows import LINE, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.draw.find.finder import Finder

WIDTH, MOST_HEIGHT = 460, 420
HINT = "States, operations, facts, hazards, findings, files and commands are found by any part."


class Palette(QFrame):
    """A text field above a list. Enter runs the marked row, Escape closes."""

    def __init__(self, finder: Finder, tokens: Tokens, window: QWidget) -> None:
        super().__init__(window)
        self._finder = finder
        self._before: QWidget | None = None
        self.setProperty("role", "float")
        self.setAccessibleName("Commands")
        self.setFixedWidth(WIDTH)
        self.field = QLineEdit()
        self.field.setPlaceholderText("Find anything, or run a command")
        self.field.setAccessibleName("Find anything, or run a command")
        self._glass = self.field.addAction(
            icon("search", tokens), QLineEdit.ActionPosition.LeadingPosition
        )
        self._glass.setText("Find")
        self.list = RowsView(tokens, self)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setAccessibleName("What was found")
        self.empty = label("", "hint")
        self.empty.setContentsMargins(12, 8, 12, 8)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(1, 8, 1, 6)
        layout.setSpacing(6)
        top = QVBoxLayout()
        top.setContentsMargins(8, 0, 8, 0)
        top.addWidget(self.field)
        layout.addLayout(top)
        layout.addWidget(rule())
        layout.addWidget(self.list)
        layout.addWidget(self.empty)
        self.field.textChanged.connect(lambda *_: self._show())
        self.field.installEventFilter(self)
        self.list.clicked.connect(self._run)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._glass.setIcon(icon("search", tokens))
        self.list.set_tokens(tokens)

    def open(self, corner: QPoint) -> None:
        """Open with the upper right corner at ``corner`` (pixels of the window)."""
        self._before = self.window().focusWidget()
        self._finder.refresh()
        self.field.clear()
        self._show()
        self.move(max(8, corner.x() - WIDTH), corner.y())
        self.show()
        self.raise_()
        self.field.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self._tell()

    def close_palette(self) -> None:
        """Close, and return the keyboard focus to the widget that had it."""
        if self.isVisible():
            # First the focus and then the list: Qt would give the focus to the next part in the
            # order of Tab for a moment, and a reader would read it. A field on the canvas closes
            # when it loses the focus; it may be gone.
            if self._before is not None and isValid(self._before):
                self._before.setFocus()
            self.hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Close when the field loses the keyboard focus.

        Pass the arrow keys and Enter to the list.
        """
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
            self._tell()
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

    def _tell(self) -> None:
        """Let a screen reader read the marked row. The keyboard focus stays in the field, so a
        reader would not notice that another row is marked."""
        lines = [at for at, row in enumerate(self.list.rows.rows) if row.kind == LINE]
        index = self.list.currentIndex()
        if self.isVisible() and index.row() in lines:
            words = index.data(Qt.ItemDataRole.AccessibleTextRole)
            announce(self.field, f"{words}, {lines.index(index.row()) + 1:,} of {len(lines):,}")

    def _run(self, index: QModelIndex) -> None:
        if not index.isValid():
            return
        row = index.data(Qt.ItemDataRole.UserRole)
        self.close_palette()
        self._finder.choose(row)

    def _show(self) -> None:
        rows = self._finder.rows(self.field.text())
        self.list.rows.show(rows)
        nothing = f"Nothing is called “{self.field.text().strip()[:40]}”. {HINT}"
        # A hidden label with words would be read out although something is found.
        self.empty.setText("" if rows else nothing)
        self.empty.setVisible(not rows)
        if not rows and self.isVisible():
            announce(self.field, nothing)
        self.list.setVisible(bool(rows))
        self.list.setFixedHeight(min(MOST_HEIGHT, self.list.height_of_all()))
        self.adjustSize()
        self.list.scrollToTop()
        self.list.setCurrentIndex(QModelIndex())
        self._step(1)
        self._tell()
