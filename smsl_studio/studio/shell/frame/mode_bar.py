"""The mode bar: the modes, and at their right the drawing tools or the controls of a run."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QAction, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QPushButton,
    QStackedWidget,
    QToolBar,
    QToolButton,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.controls import name_parts, row, rule
from smsl_studio.studio.base.feature import Control, whole
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.key_button import command_button
from smsl_studio.studio.base.precedence import Precedence
from smsl_studio.studio.base.theme import MODE_BAR, MODE_BAR_RUN, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.phase_badge import PhaseBadge
from smsl_studio.studio.shell.frame.more_tools import MoreTools
from smsl_studio.studio.shell.frame.search_box import SearchBox

DRAW_TOOLS = (
    ("undo", "redo"),
    ("add_state", "connect", "sub_sb"),
    ("tidy", "align"),
)
TIGHT = 760
"""Below this width of the bar, the buttons of four modes leave room for the word of the run."""
SNUG = 1360
"""Below this width of the bar, the buttons of the modes leave room for the choices of a run."""
WORDS = 560
"""The width of the drawing tools from which their buttons have words (pixels)."""
MODES = ("mode_draw", "mode_run", "mode_supervise", "mode_review", "mode_replay")
NAMED = 1100
"""Below this width of the bar the word of the run leaves the name of its file to the tooltip."""
NO_TOOLS = ("start",)
PAGES = ("merge", "rules", "physics", "cycle")
"""Pages of Draw on which nothing is drawn."""
PASSING = ("mode_replay",)
"""Modes that are offered only while they have something to show."""
QWIDGETSIZE_MAX = (1 << 24) - 1
"""Qt's value for no maximum width."""
COMMANDING = ("run", "supervise")
"""Modes whose rows have a Stop button of their own, at the same place."""


class ModeBar(QToolBar):
    """The bar below the menus. Its middle part changes with the mode."""

    search_wanted = Signal()

    def __init__(self, actions: Actions, tokens: Tokens) -> None:
        super().__init__("Modes and tools")
        self.setObjectName("mode_bar")
        self.setMovable(False)
        self.setFloatable(False)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self._actions = actions
        name_parts(self)
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
        self.run.setToolTip(tip_text(actions.table["run_play"].hint))
        self.run.clicked.connect(actions["run_play"].trigger)
        self.stop = command_button("stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.setToolTip(tip_text(actions.table["run_stop"].hint))
        self.stop.clicked.connect(actions["run_stop"].trigger)
        self.stop.hide()
        self.phase = PhaseBadge()
        self.phase.hide()
        self._run_exists, self._mode, self._waits = False, "draw", ""
        self._draw_tools = _DrawTools(actions, self.search, self.run)
        self._middle = QStackedWidget()
        # The middle part can shrink by itself. Otherwise the tool bar would hide all of it, and
        # Stop too.
        self._middle.setMinimumWidth(1)
        self._rows: dict[str, QWidget] = {}
        self._middle.addWidget(self._draw_tools)
        inner = _Whole(self.segments, self.phase)
        layout = QHBoxLayout(inner)
        layout.setContentsMargins(12, 0, 12, 0)
        layout.setSpacing(12)
        layout.addWidget(self.left_button)
        layout.addWidget(self.segments)
        self._rule = rule(vertical=True, length=24)
        layout.addWidget(self._rule)
        layout.addWidget(self._middle, 1)
        layout.addWidget(self.phase)
        layout.addWidget(self.stop)
        self._precedence = inner.precedence = Precedence(inner, self.phase)
        self._precedence.want(self.phase, False)
        self.addWidget(inner)
        self.setFixedHeight(MODE_BAR)
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.run.setIcon(icon("play", tokens, 14, tokens.onacc))
        self.stop.set_tokens(tokens)
        self.search.set_tokens(tokens)
        self._no_margins()

    def showEvent(self, event: QShowEvent) -> None:
        """Remove the margins that the style sets when a tool bar is shown."""
        super().showEvent(event)
        self._no_margins()

    def _no_margins(self) -> None:
        layout = self.layout()
        if layout is not None:
            layout.setContentsMargins(0, 0, 0, 0)
            layout.setSpacing(0)

    def control(self, name: str) -> Control | None:
        """The button of an action, or of a mode; None if the bar has none."""
        own = {"run_play": self.run, "run_stop": self.stop, **self.segments.buttons}
        return whole(own[name]) if name in own else None

    def add_row(self, mode: str, row: QWidget) -> None:
        """Set the row that a mode shows instead of the drawing tools."""
        self._rows[mode] = row
        self._middle.addWidget(row)

    def show_stop(self, shown: bool) -> None:
        """Show Stop while a run exists, unless the row of the mode has its own Stop."""
        self._run_exists = shown
        self._show_stop()
        self._draw_tools.show_run(not shown)

    def show_phase(self, words: str, kind: str, tip: str, file: str = "") -> None:
        """Show the word for the run's phase beside Stop, so that a person sees the effect of
        Stop.

        ``file`` is the file of the run if it is another one than the drawing.
        """
        before = self.phase.text()
        self.phase.show_file(file)
        self.phase.show_phase(words, kind, tip)
        if self.phase.text() != before:
            self._precedence.fit()

    def show_mode(self, mode: str) -> None:
        """Show the row of a mode, with the height that it needs."""
        self._mode = mode
        self._middle.setCurrentWidget(self._rows.get(mode, self._draw_tools))
        self.setFixedHeight(MODE_BAR_RUN if mode in self._rows else MODE_BAR)
        self._rule.setVisible(mode != "start")
        self._draw_tools.show_tools(mode)
        self._show_run()
        self._show_stop()

    def hold_run(self, reason: str) -> None:
        """Let Run wait, for a reason in words; empty text lets it go on."""
        self._waits = reason
        self._show_run()

    def _show_run(self) -> None:
        self.run.setEnabled(self._mode != "start" and not self._waits)
        self.run.setToolTip(tip_text(self._waits or self._actions.table["run_play"].hint))

    def _show_stop(self) -> None:
        shown = self._run_exists and self._mode not in COMMANDING
        self.stop.setVisible(shown)
        self._precedence.want(self.phase, shown)
        self._precedence.fit()

    def below(self, name: str) -> QPoint:
        """The point of the screen below the button of an action."""
        for button in self._draw_tools.findChildren(QToolButton):
            if button.defaultAction() is self._actions[name]:
                return button.mapToGlobal(QPoint(0, button.height() + 4))
        return self.mapToGlobal(self.rect().center())


class _Whole(QWidget):
    """The content of the bar. If it is narrow, the word for the phase is hidden before Stop."""

    precedence: Precedence

    def __init__(self, segments: Segments, phase: PhaseBadge) -> None:
        super().__init__()
        self._segments, self._phase = segments, phase

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Decide again which parts are hidden."""
        super().resizeEvent(event)
        self._segments.fit(self.width())
        self._phase.set_named(self.width() >= NAMED)
        self.precedence.fit()


class _DrawTools(QWidget):
    """The drawing buttons, search and Run. In a narrow row first words are hidden, then buttons,
    which a menu has then.
    """

    def __init__(self, actions: Actions, search: SearchBox, run: QPushButton) -> None:
        super().__init__()
        self._run = run
        self._worded: list[QToolButton] = []
        buttons: dict[str, QToolButton] = {}
        rules = []
        layout = row(spacing=4)
        for at, group in enumerate(DRAW_TOOLS):
            if at:
                rules.append(rule(vertical=True, length=24))
                layout.addWidget(rules[-1])
            for name in group:
                short = actions.table[name].short
                buttons[name] = _tool(actions[name], icon_only=not short)
                if short:
                    self._worded.append(buttons[name])
                layout.addWidget(buttons[name])
        self.more = MoreTools(tuple(buttons.values()))
        layout.addWidget(self.more)
        layout.addStretch(1)
        layout.addWidget(search)
        layout.addSpacing(4)
        layout.addWidget(run)
        self.setLayout(layout)
        last = [buttons[name] for name in ("undo", "redo", "sub_sb", "connect", "add_state")]
        self._tools = (*rules, *buttons.values())
        self._steps = (buttons["undo"], buttons["redo"])
        self._precedence = Precedence(
            self, rules[1], buttons["align"], buttons["tidy"], rules[0], *last, search, run, gaps=4
        )

    def show_tools(self, mode: str) -> None:
        """Show the tools for drawing in Draw, and on its other pages undo and redo alone."""
        for tool in self._tools:
            wanted = mode not in NO_TOOLS and (mode not in PAGES or tool in self._steps)
            self._precedence.want(tool, wanted)
        self._fit()

    def show_run(self, shown: bool) -> None:
        """Show or hide Run. While a run exists Stop takes its place."""
        self._precedence.want(self._run, shown)
        self._fit()

    def _fit(self) -> None:
        """Hide what has no room; the menu of these tools needs room, too."""
        self.more.hide()
        self._precedence.fit()
        if self._precedence.lacking & set(self._tools):
            self.more.show()
            self._precedence.fit()
        self.more.tools = [tool for tool in self.more.every if tool in self._precedence.lacking]

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide words first, then buttons, if the row is narrow."""
        super().resizeEvent(event)
        for button in self._worded:
            _set_worded(button, self.width() >= WORDS)
        self._fit()
        layout = self.layout()
        assert layout is not None
        layout.activate()


class Segments(QFrame):
    """The buttons of the modes; exactly one is checked."""

    def __init__(self, modes: list[tuple[str, QAction, str]]) -> None:
        super().__init__()
        self.setObjectName("segments")
        self.setAccessibleName("Mode")
        self._room, self._tight = QWIDGETSIZE_MAX, ""
        layout = row(spacing=0)
        layout.setContentsMargins(2, 2, 2, 2)
        self.buttons: dict[str, QToolButton] = {}
        for name, action, words in modes:
            button = QToolButton()
            self.buttons[name] = button
            if name in PASSING:
                button.hide()
            button.setDefaultAction(action)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
            button.setFixedHeight(30)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.setAccessibleName(plain_text(f"{words} mode"))
            layout.addWidget(button)
        self.setLayout(layout)
        self.setFixedHeight(34)

    def show_segment(self, name: str, shown: bool) -> None:
        """Show or hide the button of a mode."""
        self.buttons[name].setVisible(shown)
        self.fit(self._room)

    def fit(self, room: int) -> None:
        """Take less space beside the words in a narrow bar (pixels), and least
        if all modes are shown in a very narrow one.

        There Review, which is read at leisure, is in the menu View alone. So Stop stays whole.
        """
        self._room = room
        review = self.buttons.get("mode_review")
        if review is not None:
            review.setHidden(room < TIGHT and not review.isChecked())
        shown = [one for one in self.buttons.values() if one is not review]
        every = not any(button.isHidden() for button in shown)
        snug = "snug" if room < SNUG else ""
        tight = "tight" if every and room < TIGHT else snug
        if tight != self._tight:
            self._tight = tight
            self.setProperty("tight", tight)
            for part in (self, *self.buttons.values()):
                part.style().unpolish(part)
                part.style().polish(part)
                part.updateGeometry()


def _tool(action: QAction, icon_only: bool = False) -> QToolButton:
    button = QToolButton()
    button.setDefaultAction(action)
    button.setAccessibleName(plain_text(action.text().rstrip("…")))
    button.setFixedHeight(32)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    _set_worded(button, not icon_only)
    return button


def _set_worded(button: QToolButton, worded: bool) -> None:
    """Show words beside the icon, or the icon alone."""
    style = Qt.ToolButtonStyle
    wanted = style.ToolButtonTextBesideIcon if worded else style.ToolButtonIconOnly
    role = "tool" if worded else "small"
    button.setToolButtonStyle(wanted)
    button.setMinimumWidth(0 if worded else 36)
    button.setMaximumWidth(QWIDGETSIZE_MAX if worded else 36)
    if button.property("role") != role:
        button.setProperty("role", role)
        button.style().unpolish(button)
        button.style().polish(button)
