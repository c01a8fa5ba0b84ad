"""The run pane: canvas, world, facts, what is possible now, and the timeline of one run."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QMenu,
    QSplitter,
    QTabWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.errors import StudioError
from smsl_studio.studio.controls import label
from smsl_studio.studio.icons import icon
from smsl_studio.studio.run import view
from smsl_studio.studio.run.camera import VIEWS
from smsl_studio.studio.run.event_list import EventList
from smsl_studio.studio.run.facts_table import FactsTable
from smsl_studio.studio.run.possible_list import PossibleList
from smsl_studio.studio.run.run_canvas import RunCanvas
from smsl_studio.studio.run.run_session import RunChoice, RunSession
from smsl_studio.studio.run.state_check import StateCheckView
from smsl_studio.studio.run.timeline import Timeline
from smsl_studio.studio.run.transport import Transport
from smsl_studio.studio.run.world_view import WorldView
from smsl_studio.studio.session import Session
from smsl_studio.studio.theme import Tokens

FRAME = 33
"""Milliseconds between two pictures of the world."""


class RunPane(QWidget):
    """The body of Run mode. ``transport`` is a row for the mode bar.

    ``play``, ``pause``, ``step`` and ``stop`` are what the keys F5, F6, F10 and F8 call; they work
    in every mode.
    """

    run_exists = Signal(bool)
    """Whether there is a run that can be stopped."""
    said = Signal(str)
    """One line for the status line: how the run stands."""
    moved = Signal(object)
    """The active state of every SB, as a mapping; empty where there is no run."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._tokens = tokens
        self.run = RunSession(self)
        self.transport = Transport(tokens)
        self.canvas = RunCanvas(session, self.run, tokens)
        self.world = WorldView(tokens)
        self.facts = FactsTable(tokens)
        self.check = StateCheckView(tokens)
        self.possible = PossibleList(tokens)
        self.timeline = Timeline(tokens)
        self.events = EventList()
        self._build()
        self._connect()
        self._frames = QTimer(self)
        self._frames.setInterval(FRAME)
        self._frames.timeout.connect(self._draw_world)
        self._offer()
        self._refresh()

    def play(self) -> None:
        """Start a run, or go on with the one that is paused or held."""
        if self.run.exists:
            self.run.play()
        else:
            self._begin(stepping=False)

    def pause(self) -> None:
        self.run.pause()

    def step(self) -> None:
        """One operation, then pause; starts the run where there is none."""
        if not self.run.exists:
            self._begin(stepping=True)
        else:
            self.run.step()

    def stop(self) -> None:
        """A controlled stop, from anywhere."""
        self.run.stop()

    def shut(self) -> None:
        """End the run and free what it holds; for closing the window."""
        self._frames.stop()
        self.run.close()
        self.world.close_graphics()

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        for part in (self.transport, self.canvas, self.world, self.facts, self.check):
            part.set_tokens(tokens)
        self.possible.set_tokens(tokens)
        self.timeline.set_tokens(tokens)
        self._views.setIcon(icon("camera", tokens))
        self._refresh()

    def _begin(self, stepping: bool) -> None:
        transport = self.transport
        choice = RunChoice(
            world=transport.world.currentData() or "table",
            start=transport.start.currentData() or "",
            goal=transport.goal.currentData() or "",
            seed=int(transport.seed.text() or 0),
            by_hand=transport.by_hand.isChecked(),
        )
        self.events.clear()
        self.world.clear()
        self.run.begin(self._session.blueprint, choice, transport.speed.currentData())
        if stepping:
            self.run.step()
        self._frames.start()

    def _offer(self) -> None:
        """Fill the transport's choices from the blueprint that is drawn now."""
        blueprint = self._session.blueprint
        states = []
        roots = [blueprint[name] for name in blueprint.roots]
        for root in roots:
            prefix = f"{root.name}/" if len(roots) > 1 else ""
            for state in root.table:
                shown = prefix + view.short_name(root, state)
                states.append((shown, str(Address(root.name, state))))
        first = roots[0] if roots else None
        initial = str(Address(first.name, first.initial)) if first and first.table else ""
        activating = str(Address(first.name, first.activating)) if first and first.table else ""
        self.transport.offer(front.world_names(blueprint), states, initial, activating)
        self.canvas.drawing_changed()

    def _build(self) -> None:
        self._views = QToolButton()
        self._views.setProperty("role", "tool")
        self._views.setText("Front right")
        self._views.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self._views.setIcon(icon("camera", self._tokens))
        self._views.setIconSize(QSize(16, 16))
        self._views.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._views.setToolTip("Where the world is looked at from")
        menu = QMenu(self._views)
        for name in VIEWS:
            menu.addAction(name, lambda name=name: self._look(name))
        self._views.setMenu(menu)
        self._world_name = label("", "small")
        world = _panel(_head("World", self._world_name, self._views), self.world)
        self._facts_note = label("", "small")
        facts = _panel(_head("Facts", self._facts_note), self.facts, self.check)
        self._possible_note = label("cost", "small")
        possible = _panel(_head("Possible now", None, self._possible_note), self.possible)
        below = QSplitter(Qt.Orientation.Horizontal)
        below.addWidget(facts)
        below.addWidget(possible)
        below.setSizes([428, 384])
        right = QSplitter(Qt.Orientation.Vertical)
        right.addWidget(world)
        right.addWidget(below)
        right.setSizes([300, 326])
        across = QSplitter(Qt.Orientation.Horizontal)
        across.addWidget(self.canvas)
        across.addWidget(right)
        across.setSizes([628, 812])
        across.setStretchFactor(0, 1)
        self._tabs = QTabWidget()
        self._tabs.setDocumentMode(True)
        self._tabs.addTab(self.timeline, "Timeline")
        self._tabs.addTab(self.events, "Events")
        whole = QSplitter(Qt.Orientation.Vertical)
        whole.addWidget(across)
        whole.addWidget(self._tabs)
        whole.setSizes([626, 160])
        whole.setStretchFactor(0, 1)
        for splitter in (below, right, across, whole):
            splitter.setHandleWidth(1)
            splitter.setChildrenCollapsible(False)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(whole)

    def _connect(self) -> None:
        transport = self.transport
        transport.play_wanted.connect(self.play)
        transport.pause_wanted.connect(self.pause)
        transport.step_wanted.connect(self.step)
        transport.stop_wanted.connect(self.stop)
        transport.speed_changed.connect(self.run.set_speed)
        transport.by_hand_changed.connect(lambda on: self.run.set_automatic(not on))
        self.run.changed.connect(self._refresh)
        self.run.opened.connect(self._show_world)
        self.run.events_told.connect(self.events.add_events)
        self.run.exists_changed.connect(self.run_exists)
        self.run.refused.connect(self._say_refused)
        self.possible.chosen.connect(self.run.ask)
        self.possible.restore_wanted.connect(self.run.restore)
        self.canvas.chosen.connect(self._choose_edge)
        self.events.jump_wanted.connect(self.canvas.jump)
        self._session.blueprint_changed.connect(self._offer)

    def _refresh(self) -> None:
        run, status, blueprint = self.run, self.run.status, self.run.blueprint
        self.transport.show_phase(run.phase, run.exists, run.sentence)
        self.transport.lock(run.exists)
        self.canvas.refresh()
        if status is None or blueprint is None:
            self.facts.show_rows(())
            self.possible.show_rows((), False, "Starts with the run")
            self.timeline.show_lanes((), 0.0)
            self.check.show_check(None, None, waiting=False)
            self.moved.emit({})
            return
        self.facts.show_rows(view.fact_rows(blueprint, status))
        by_hand = self.transport.by_hand.isChecked() and run.exists
        rows = view.possible_rows(blueprint, status) if run.exists else ()
        empty = run.sentence or "Nothing is possible"
        self.possible.show_rows(rows, by_hand, empty)
        self.timeline.show_lanes(view.lanes(blueprint, run.story), run.story.time)
        self.check.show_check(blueprint, status.check, waiting=status.running is not None)
        running = status.running
        self._facts_note.setText(f"{running.operation} in transit" if running else "")
        self.moved.emit(dict(status.configuration))
        self.said.emit(self._line())

    def _line(self) -> str:
        choice, status = self.run.choice, self.run.status
        if choice is None or status is None:
            return ""
        words = f"World {choice.world} · Seed {choice.seed} · Simulated {status.time:.1f} s"
        return f"{words} · {self.run.sentence}" if self.run.sentence else words

    def _show_world(self) -> None:
        name = self.run.choice.world if self.run.choice else ""
        self._world_name.setText(f"{name}, from poses" if self.run.shapes else name)
        self.world.load(self.run.shapes, name)
        self._draw_world()

    def _draw_world(self) -> None:
        if self.isVisible():
            self.world.show_poses(self.run.poses(), self.run.words())
        if not self.run.exists:
            self._frames.stop()

    def _look(self, name: str) -> None:
        self._views.setText(name)
        self.world.set_view(name)

    def _choose_edge(self, address: Address) -> None:
        if self.run.exists and self.transport.by_hand.isChecked():
            self.run.ask(address)

    def _say_refused(self, error: StudioError) -> None:
        self._frames.stop()
        self.canvas.show_banner(f"{error.sentence}. {error.advice}".strip())
        self.said.emit(str(error))


def _head(title: str, note: QWidget | None, *tools: QWidget) -> QWidget:
    head = QWidget()
    head.setFixedHeight(40)
    across = QHBoxLayout(head)
    across.setContentsMargins(12, 0, 8, 0)
    across.setSpacing(8)
    across.addWidget(label(title, "heading"))
    if note is not None:
        across.addWidget(note)
    across.addStretch(1)
    for tool in tools:
        across.addWidget(tool)
    return head


def _panel(*parts: QWidget) -> QWidget:
    panel = QWidget()
    panel.setProperty("role", "panel")
    panel.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
    column = QVBoxLayout(panel)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(0)
    for part in parts:
        column.addWidget(part)
    return panel
