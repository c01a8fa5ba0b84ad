"""Shows a configuration: a column of states for each SB, and a line through the active states."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QFontMetrics, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.features.inspection.column_rows import BranchColumn, ColumnState

WIDE, PADDING, GAP = 96, 18, 14
"""The width of a column, the space beside a button's words, and the space between columns
(pixels)."""


class BranchColumns(QScrollArea):
    """The columns of a configuration. A click or Enter on a state lets its SB go there."""

    picked = Signal(str, str)
    """(SB, state): the person wants this SB to be in this state."""
    list_wanted = Signal(str)
    """str: the person wants a list of all states of this SB."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._columns: tuple[BranchColumn, ...] = ()
        self._hidden = 0
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAccessibleName("Where each State Branch stands")
        self.show_columns((), 0)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.show_columns(self._columns, self._hidden)

    def show_columns(self, columns: Sequence[BranchColumn], hidden: int) -> None:
        """Show columns. ``hidden`` is the number of SBs without a column."""
        self._columns, self._hidden = tuple(columns), hidden
        at, focused = self.horizontalScrollBar().value(), self._focused()
        inner = _JoinedColumns(self._tokens)
        across = QHBoxLayout(inner)
        across.setContentsMargins(12, 2, 12, 6)
        across.setSpacing(GAP)
        for column in columns:
            across.addLayout(self._column(column, inner))
        if hidden:
            more = label(f"{hidden:,} more State Branches do not move now", "hint")
            more.setFixedWidth(WIDE)
            across.addWidget(more, 0, Qt.AlignmentFlag.AlignTop)
        across.addStretch(1)
        self.setWidget(inner)
        self.horizontalScrollBar().setValue(at)
        across.activate()
        self._reveal()
        for button in self.buttons() if focused else ():
            if _place(button) == focused:
                button.setFocus()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the active states in view, also in a low page."""
        super().resizeEvent(event)
        self._reveal()

    def _reveal(self) -> None:
        """Scroll up or down so that the active states are in view, at least the highest."""
        inner = self.widget()
        lit = inner.lit if isinstance(inner, _JoinedColumns) else ()
        if lit:
            top = min(one.geometry().top() for one in lit) - GAP // 2
            low = max(one.geometry().bottom() for one in lit) + GAP // 2
            high = self.viewport().height()
            bar = self.verticalScrollBar()
            bar.setValue(0 if low <= high else min(low - high, top))

    def buttons(self) -> Iterator[QPushButton]:
        """The buttons of all states, column by column."""
        inner = self.widget()
        yield from inner.findChildren(QPushButton, "place") if inner else ()

    def _focused(self) -> str:
        """The SB and state of the button with the keyboard focus. Empty if none has it."""
        focus, inner = QApplication.focusWidget(), self.widget()
        if focus is None or inner is None or not inner.isAncestorOf(focus):
            return ""
        return _place(focus)

    def _column(self, column: BranchColumn, inner: _JoinedColumns) -> QVBoxLayout:
        down = QVBoxLayout()
        down.setContentsMargins(0, 0, 0, 0)
        down.setSpacing(5)
        head = Elided(column.branch)
        head.setProperty("role", "small")
        head.setFixedWidth(WIDE)
        down.addWidget(head)
        for state in column.states:
            button = self._state(column.branch, state)
            if state.here:
                inner.lit.append(button)
            down.addWidget(button)
        if column.more:
            more = QPushButton(f"{column.more:,} more…")
            more.setProperty("role", "link")
            more.setAccessibleName(plain_text(f"{column.more:,} more states of {column.branch}"))
            more.setToolTip(tip_text(f"Choose one of all states of {column.branch}"))
            more.clicked.connect(lambda _=False, name=column.branch: self.list_wanted.emit(name))
            down.addWidget(more)
        down.addStretch(1)
        return down

    def _state(self, branch: str, state: ColumnState) -> QPushButton:
        metrics = QFontMetrics(mono_font(12))
        middle = Qt.TextElideMode.ElideMiddle
        button = QPushButton(
            as_it_is(metrics.elidedText(plain_text(state.words), middle, WIDE - PADDING))
        )
        button.setObjectName("place")
        button.setProperty("role", "place")
        button.setProperty("place", f"{branch}\n{state.name}")
        button.setProperty("here", state.here)
        button.setProperty("near", state.near and not state.here)
        button.setFixedWidth(WIDE)
        what = "it stands here" if state.here else "one step away" if state.near else ""
        if state.hazard:
            what = "one step away, which meets a hazard"
            button.setIcon(icon("error", self._tokens, 14, self._tokens.bad))
        words = ", ".join(filter(None, (f"{branch} {state.name}", what)))
        button.setAccessibleName(plain_text(words))
        button.setToolTip(tip_text(words))
        button.clicked.connect(lambda _=False: self.picked.emit(branch, state.name))
        return button


def _place(button: QWidget) -> str:
    """The SB and the state of a button, as one text."""
    return str(button.property("place"))


class _JoinedColumns(QWidget):
    """The background of the columns. It has the line that joins the active states."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.setProperty("role", "panel")
        self._ink = tokens.acc
        self.lit: list[QPushButton] = []

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the line through the active states."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self._ink, 2))
        for one, other in zip(self.lit, self.lit[1:], strict=False):
            left, right = one.geometry(), other.geometry()
            painter.drawLine(
                QPointF(left.right(), left.center().y()), QPointF(right.left(), right.center().y())
            )
        painter.end()
