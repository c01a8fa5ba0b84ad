"""The mode bar: which mode, what can be drawn, search and Run; or the transport of a run."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QAction, QPainter, QPaintEvent, QPalette, QPen, QShowEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QSizePolicy,
    QStackedWidget,
    QToolBar,
    QToolButton,
    QWidget,
)

from smsl_studio.studio.actions import Actions
from smsl_studio.studio.controls import row, rule
from smsl_studio.studio.frame.key_button import KeyButton
from smsl_studio.studio.icons import draw, icon
from smsl_studio.studio.theme import MODE_BAR, MODE_BAR_RUN, Tokens, text_font

DRAW_TOOLS = (
    ("undo", "redo"),
    ("add_state", "connect", "sub_sb"),
    ("tidy",),
)
SEARCH = 248
"""Pixels of the search field; it gives way where the bar is narrow."""
MODES = ("mode_draw", "mode_run", "mode_supervise", "mode_replay")
PASSING = ("mode_replay",)
"""Modes that are offered only while there is something to show in them."""


class ModeBar(QToolBar):
    """One bar, fixed; its middle follows the mode."""

    search_wanted = Signal()

    def __init__(self, actions: Actions, tokens: Tokens) -> None:
        super().__init__("Modes and tools")
        self.setObjectName("mode_bar")
        self.setMovable(False)
        self.setFloatable(False)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self._actions = actions
        self.left_button = _tool(actions["left_panel"], icon_only=True)
        self.left_button.hide()
        self.segments = Segments(
            [(name, actions[name], actions.table[name].short) for name in MODES]
        )
        self.search = SearchBox(tokens)
        self.search.clicked.connect(self.search_wanted)
        self.run = QPushButton(" Run")
        self.run.setProperty("role", "primary")
        self.run.setAccessibleName("Run")
        self.run.setFixedHeight(32)
        self.run.setToolTip(actions.table["run_play"].hint)
        self.run.clicked.connect(actions["run_play"].trigger)
        self.stop = KeyButton("Stop", "F8", "stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.setToolTip(actions.table["run_stop"].hint)
        self.stop.clicked.connect(actions["run_stop"].trigger)
        self.stop.hide()
        self._draw_tools = self._make_draw_tools(actions)
        self._middle = QStackedWidget()
        self._rows: dict[str, QWidget] = {}
        self._middle.addWidget(self._draw_tools)
        inner = QWidget()
        layout = QHBoxLayout(inner)
        layout.setContentsMargins(12, 0, 12, 0)
        layout.setSpacing(12)
        layout.addWidget(self.left_button)
        layout.addWidget(self.segments)
        layout.addWidget(rule(vertical=True, length=24))
        layout.addWidget(self._middle, 1)
        self.addWidget(inner)
        self.setFixedHeight(MODE_BAR)
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        self.run.setIcon(icon("play", tokens, 14, tokens.onacc))
        self.stop.set_tokens(tokens)
        self.search.set_tokens(tokens)
        self._no_margins()

    def showEvent(self, event: QShowEvent) -> None:
        """A tool bar takes its margins from the style when it is shown; ours are our own."""
        super().showEvent(event)
        self._no_margins()

    def _no_margins(self) -> None:
        layout = self.layout()
        if layout is not None:
            layout.setContentsMargins(0, 0, 0, 0)
            layout.setSpacing(0)

    def add_row(self, mode: str, row: QWidget) -> None:
        """What a mode shows in place of the drawing tools."""
        self._rows[mode] = row
        self._middle.addWidget(row)

    def show_stop(self, shown: bool) -> None:
        """Stop stays visible beside the drawing tools while a run exists."""
        self.stop.setVisible(shown)
        self.run.setVisible(not shown)

    def show_mode(self, mode: str) -> None:
        self._middle.setCurrentWidget(self._rows.get(mode, self._draw_tools))
        self.setFixedHeight(MODE_BAR_RUN if mode in self._rows else MODE_BAR)

    def below(self, name: str) -> QPoint:
        """The point of the screen below an action's button."""
        for button in self._draw_tools.findChildren(QToolButton):
            if button.defaultAction() is self._actions[name]:
                return button.mapToGlobal(QPoint(0, button.height() + 4))
        return self.mapToGlobal(self.rect().center())

    def _make_draw_tools(self, actions: Actions) -> QWidget:
        tools = QWidget()
        layout = row(spacing=4)
        for at, group in enumerate(DRAW_TOOLS):
            if at:
                layout.addSpacing(8)
                layout.addWidget(rule(vertical=True, length=24))
                layout.addSpacing(8)
            for name in group:
                layout.addWidget(_tool(actions[name], icon_only=not actions.table[name].short))
        layout.addStretch(1)
        layout.addWidget(self.search)
        layout.addSpacing(4)
        layout.addWidget(self.run)
        layout.addWidget(self.stop)
        tools.setLayout(layout)
        return tools


class Segments(QFrame):
    """The modes side by side, exactly one of them chosen."""

    def __init__(self, modes: list[tuple[str, QAction, str]]) -> None:
        super().__init__()
        self.setObjectName("segments")
        self.setAccessibleName("Mode")
        layout = row(spacing=0)
        layout.setContentsMargins(2, 2, 2, 2)
        self._buttons: dict[str, QToolButton] = {}
        for name, action, words in modes:
            button = QToolButton()
            self._buttons[name] = button
            if name in PASSING:
                button.hide()
            button.setDefaultAction(action)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
            button.setFixedHeight(30)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.setAccessibleName(f"{words} mode")
            layout.addWidget(button)
        self.setLayout(layout)
        self.setFixedHeight(34)

    def show_segment(self, name: str, shown: bool) -> None:
        """Offer a mode, or no longer."""
        self._buttons[name].setVisible(shown)


class SearchBox(QAbstractButton):
    """Looks like a field and opens the command palette."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.setFixedHeight(32)
        self.setMinimumWidth(44)
        self.setMaximumWidth(SEARCH)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.setText("Find or run a command")
        self.setAccessibleName("Find or run a command")
        self.setToolTip("Find a state or operation, or run a command (Ctrl+K)")
        self.setCursor(Qt.CursorShape.IBeamCursor)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)

    def sizeHint(self) -> QSize:
        return QSize(SEARCH, 32)

    def minimumSizeHint(self) -> QSize:
        return QSize(44, 32)

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        tokens, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge = self.palette().color(QPalette.ColorRole.Accent) if self.hasFocus() else tokens.nl
        painter.setPen(QPen(edge, 2 if self.hasFocus() else 1))
        painter.setBrush(tokens.surf)
        box = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        painter.drawRoundedRect(box, 6, 6)
        draw(painter, "search", QRectF(10, 9, 14, 14), tokens.tx2, tokens.surf)
        painter.setPen(tokens.tx2)
        painter.setFont(text_font(13))
        roomy = self.width() > SEARCH - 40
        words = self.rect().adjusted(33, 0, -60 if roomy else -8, 0)
        right = Qt.TextElideMode.ElideRight
        shown = painter.fontMetrics().elidedText(self.text(), right, words.width() + 1)
        painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, shown)
        if not roomy:
            painter.end()
            return
        key = QRectF(self.width() - 51, 7, 42, 18)
        painter.setPen(QPen(tokens.line, 1))
        painter.setBrush(tokens.win)
        painter.drawRoundedRect(key, 4, 4)
        painter.setPen(tokens.tx2)
        painter.setFont(text_font(11, 500))
        painter.drawText(key, Qt.AlignmentFlag.AlignCenter, "Ctrl K")


def _tool(action: QAction, icon_only: bool = False) -> QToolButton:
    button = QToolButton()
    button.setDefaultAction(action)
    button.setProperty("role", "small" if icon_only else "tool")
    style = Qt.ToolButtonStyle
    button.setToolButtonStyle(
        style.ToolButtonIconOnly if icon_only else style.ToolButtonTextBesideIcon
    )
    button.setAccessibleName(action.text().rstrip("…"))
    button.setFixedHeight(32)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    if icon_only:
        button.setFixedWidth(36)
    return button
