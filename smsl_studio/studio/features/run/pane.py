"""The body of Run mode: canvas, world, facts, possible operations and timeline of one run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent, QShowEvent
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.merge.choice import refusal_of_open
from smsl_studio.errors import StudioError
from smsl_studio.front.script.lines import script_of
from smsl_studio.front.script.script import Script
from smsl_studio.front.views.fact_rows import as_they_were, fact_rows, last_check, rate_words
from smsl_studio.front.views.possible_rows import CHOOSABLE, possible_rows
from smsl_studio.front.views.timeline_lanes import lanes
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.events import Event
from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.tabs import Tabs
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.run.event_list import EventList
from smsl_studio.studio.features.run.facts_place import FactsPlace
from smsl_studio.studio.features.run.low_page import LowPage
from smsl_studio.studio.features.run.next_run import NextRun
from smsl_studio.studio.features.run.possible_panel import PossiblePanel
from smsl_studio.studio.features.run.refused_words import asked_words, begin_words
from smsl_studio.studio.features.run.transport import Transport
from smsl_studio.studio.running import decisions
from smsl_studio.studio.running.facts_table import FactsTable
from smsl_studio.studio.running.frames import head, split, tool
from smsl_studio.studio.running.next_levels import NextLevels
from smsl_studio.studio.running.run_canvas import RunCanvas
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.state_check import StateCheckView
from smsl_studio.studio.running.status_words import Words, status_words
from smsl_studio.studio.running.timeline import Timeline
from smsl_studio.studio.running.world_pane import WorldPane

FRAME = 33
"""Milliseconds between two pictures of the world."""


class RunPane(QWidget):
    """The body of Run mode. ``transport`` is its row of the mode bar.

    The keys F5, F6, F10 and F8 call ``play``, ``pause``, ``step`` and ``stop`` in every mode.
    """

    run_exists = Signal(bool)
    """bool: whether there is a run that can be stopped."""
    said = Signal()
    """The result of ``words`` changed."""
    reset_wanted = Signal()
    """The person wants to reset a stopped run while this pane is hidden, so the visible page
    must ask."""
    monitor_wanted = Signal()
    """Show or hide the monitor page."""
    named = Signal()
    """The result of ``other`` may have changed."""
    moved = Signal(object, str)
    """(active state of every SB, SB in which an operation runs); empty without a run."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._tokens = tokens
        self.run = RunSession(self)
        self.levels = NextLevels(session)
        # With a parent it is freed with the pane, also if no mode ever shows it.
        self.transport = Transport(tokens, self)
        self.transport.hide()
        self.canvas = RunCanvas(session, self.run, tokens)
        self.scene = WorldPane(self.run, tokens)
        self.world = self.scene.view
        self.facts = FactsTable(tokens)
        self.check = StateCheckView(tokens)
        self.possible = PossiblePanel(self.run, tokens)
        self.timeline = Timeline(tokens)
        self.events = EventList()
        self.next = NextRun(session, self.run, self.transport, self.levels)
        self._asked = False
        self._begin_later: bool | None = None
        self.recordings: Callable[[], Path | None] = lambda: None
        """Returns the folder for recordings; None if runs are not recorded."""
        self.policy: Callable[[], Path | None] = lambda: None
        """Returns the trust policy for the drawing; None if a run needs no approval."""
        self._build()
        self._connect()
        self._frames = QTimer(self)
        self._frames.setInterval(FRAME)
        self._frames.timeout.connect(self._draw_world)
        self._refresh()

    @property
    def words(self) -> Words:
        """The texts of the status line, for the left and the right side."""
        return status_words(self.run, self.transport.speed.currentData(), self.canvas.moved_on)

    # What is asked of the run.

    def play(self) -> None:
        """Start a run, or continue one that is paused, holds, or waits for a choice by hand.

        A run that is about to pause continues from there. For a stopped run the person is asked
        whether to reset it.
        """
        if self.run.phase == "stopped" and self.run.exists:
            self._ask_reset()
        elif not self.run.exists:
            self._begin(stepping=False)
        elif self.run.pausing:
            self.transport.by_hand.setChecked(False)
            self.run.play_on()
        elif self.run.phase != "running":
            self.transport.by_hand.setChecked(False)
            self.run.resume()

    def _ask_reset(self) -> None:
        if self.isVisible():
            self._lists.show_page("Possible now")
            self.possible.ask(decisions.way_out("reset"))
        else:
            self.reset_wanted.emit()

    def pause(self) -> None:
        """Pause the run."""
        self.run.pause()

    def step(self) -> None:
        """Carry out one operation, then pause; without a run, begin one."""
        if self.run.exists:
            self.run.step()
        else:
            self._begin(stepping=True)

    def stop(self) -> None:
        """Stop the run under control."""
        self.run.stop()

    def ask(self, address: Address) -> None:
        """Have one operation carried out by hand. If it is refused, the canvas shows why."""
        if self.run.exists:
            self.run.ask(address)
        else:
            self.canvas.say("Nothing runs. Play or Step starts a run")

    def show_monitor(self) -> None:
        """Show the monitor page; close it if it is in front already."""
        self.monitor_wanted.emit()

    def shut(self) -> None:
        """End the run and free what it holds, because the window closes."""
        self._frames.stop()
        self.run.shut()
        self.world.close_graphics()

    def set_plugins(self, loaded: Loaded) -> None:
        """Offer the worlds of the plugins, and begin a run that waited for them."""
        self.next.loaded = loaded
        self.next.forget_offer()
        if self.isVisible() or self._begin_later is not None:
            self.next.offer()
        stepping, self._begin_later = self._begin_later, None
        if stepping is not None and not self.run.exists:
            self._begin(stepping)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for part in (self.transport, self.canvas, self.scene, self.facts, self.check):
            part.set_tokens(tokens)
        self.possible.set_tokens(tokens)
        self.timeline.set_tokens(tokens)
        self.monitor_button.setIcon(icon("signal", tokens))
        self._refresh()

    @property
    def other(self) -> str:
        """The file of the shown run, if it is not the file of the drawing; else empty."""
        run = self.run
        shown = run.foreign and run.shown and run.blueprint is not None
        return Path(run.blueprint.file).name if shown and run.blueprint is not None else ""

    def showEvent(self, event: QShowEvent) -> None:
        """Offer the choices for the next run."""
        super().showEvent(event)
        self.next.offer()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the facts beside the lists, or as one of them if there is little room."""
        super().resizeEvent(event)
        self.facts_place.fit(self.size())
        self.low_page.fit(self.height())

    def play_script(self, text: str, name: str) -> None:
        """Start a run in the chosen world in which a script acts, with the name of its file."""
        if self.run.exists:
            self.canvas.say("There is a run already. End it first")
        elif self._session.broken is not None:
            self._say_refused(self._session.broken.refusal)
        else:
            script = script_of(text.encode(), name, self._session.blueprint)
            self._begin(stepping=False, script=script)

    def start_at(self, states: tuple[str, ...]) -> None:
        """Let the next run start in these states, one for each SB. This starts no run."""
        if self.run.exists:
            self.canvas.say("There is a run already. End it first")
            return
        if self.next.is_fixed:
            self.show_drawing()
        self.next.start_at(states)
        self.canvas.say("The next run starts there. Play begins it")

    def _begin(self, stepping: bool, script: Script | None = None) -> None:
        if self._session.broken is not None:
            self._say_refused(self._session.broken.refusal)
            return
        waits = refusal_of_open(self._session.blueprint)
        if waits is not None:
            self._say_refused(waits)
            return
        if self.canvas.moved_on:
            self.run.forget()
        self.next.offer()
        if self.next.loaded is None:
            # The worlds are not known before the plugins were searched for.
            self._begin_later = stepping if script is None else None
            self.canvas.say("Loading the plugins. The run begins when they are loaded")
            return
        choice = replace(self.next.choice, policy=self.policy())
        if script is not None:
            choice = replace(choice, start="", starts=(), goal="", by_hand=False, script=script)
        self.events.clear()
        self.scene.clear()
        self.canvas.show_refusal("")
        self.run.recordings = self.recordings()
        speed = self.transport.speed.currentData()
        self.run.begin(self._session.blueprint, choice, speed, stepping, self.next.loaded)
        self.named.emit()
        self._frames.start()

    # Building.

    def _build(self) -> None:
        across, right = Qt.Orientation.Horizontal, self._right()
        above = split(across, (self.canvas, right), (628, 811), (44, 56))
        whole = split(Qt.Orientation.Vertical, (above, self.timeline), (626, 160), (1, 0))
        self.low_page = LowPage(
            self._lists, self.canvas, ((self.scene, right), (self.timeline, whole))
        )
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(whole)

    def _right(self) -> QSplitter:
        self._facts_rate, self._facts_note = label("", "small"), Elided("")
        self._facts_note.setProperty("role", "small")
        self.monitor_button = tool(
            "Monitor", "signal", "Every sensor and node (Ctrl+M)", self._tokens
        )
        self.monitor_button.clicked.connect(self.show_monitor)
        top = head("Facts", self._facts_rate, None, self._facts_note, self.monitor_button)
        self._lists = Tabs()
        cost = label("cost", "small")
        cost.setContentsMargins(0, 0, 8, 0)
        self._lists.add("Possible now", self.possible, cost)
        self._lists.add("Events", self.events)
        self.facts_place = FactsPlace(top, self.facts, self.check, self._lists)
        return split(Qt.Orientation.Vertical, (self.scene, self.facts_place), (300, 325), (1, 1))

    def _connect(self) -> None:
        transport = self.transport
        transport.play_wanted.connect(self.play)
        transport.pause_wanted.connect(self.pause)
        transport.step_wanted.connect(self.step)
        transport.stop_wanted.connect(self.stop)
        transport.speed_changed.connect(self.run.set_speed)
        transport.by_hand_changed.connect(lambda on: self.run.set_automatic(not on))
        self.run.changed.connect(self._refresh)
        self.run.progressed.connect(lambda: self.canvas.show_time(self.run.shown_time))
        self.run.opened.connect(self._show_world)
        self.run.events_told.connect(self._tell)
        self.run.exists_changed.connect(self.run_exists)
        self.run.refused.connect(self._say_refused)
        self.possible.chosen.connect(self.ask)
        self.canvas.chosen.connect(self.ask)
        self.canvas.drawing_wanted.connect(self.show_drawing)
        self.events.jump_wanted.connect(self.canvas.jump)
        self._session.opened.connect(self._another_file)
        self._session.blueprint_changed.connect(self._drawing_changed)
        self._session.broken_changed.connect(self._text_repaired)

    # What is shown.

    def file_asked(self) -> None:
        """Note that another file will be opened; questions may take long until then."""
        self._asked = self.run.exists

    def _another_file(self) -> None:
        """Drop what was shown of a run of the former file.

        A run that existed when the file was asked for stays visible, even if it has ended since.
        The outline shows the new file, so it no longer shows that run.
        """
        self.run.foreign = self.run.exists or (self._asked and self.run.shown)
        self._asked = False
        if not self.run.foreign:
            self.show_drawing()
        self.named.emit()
        self._refresh()

    def show_drawing(self) -> None:
        """Drop the results of a run that is over, and show the drawing."""
        self.events.clear()
        self.scene.clear()
        self.run.forget()
        self.named.emit()

    def _drawing_changed(self) -> None:
        self.next.forget_offer()
        if self.isVisible():
            self.next.offer()
        self.canvas.drawing_changed()
        self._show_active()
        self.said.emit()

    def _text_repaired(self) -> None:
        if self._session.broken is None:
            self.canvas.show_refusal("")

    def _refresh(self) -> None:
        run, status, blueprint = self.run, self.run.status, self.run.blueprint
        self.transport.show_phase(run.phase, run.exists, run.sentence, run.over)
        if self.isVisible():
            self.next.offer()
        self.canvas.refresh()
        self.said.emit()
        if status is None or blueprint is None:
            self._show_nothing()
            return
        lost = run.phase == "failed"
        facts = fact_rows(blueprint, status, lost)
        self.facts.show_rows(facts if run.exists else as_they_were(facts))
        self.scene.show_facts(facts)
        rows = possible_rows(blueprint, status) if run.exists else ()
        choosable = run.exists and status.phase in CHOOSABLE
        self.possible.show_rows(rows, choosable, capital(run.sentence) or "Nothing is possible")
        self.timeline.show_lanes(lanes(blueprint, status, run.story, run.sensors), run.time)
        check = status.check or last_check(blueprint, status, lost)
        self.check.show_check(blueprint, check, waiting=status.running is not None)
        self._facts_note.setText(f"{status.running.operation} in transit" if status.running else "")
        self._show_active()

    def _show_active(self) -> None:
        """Tell the active states, but not if the drawing is another since the run ended."""
        run, status = self.run, self.run.status
        if status is None or run.blueprint is None:
            return
        over = run.foreign or (not run.exists and self.canvas.moved_on)
        active = {} if over else status.configuration
        self.moved.emit(active, status.running.branch if status.running and active else "")

    def _show_nothing(self) -> None:
        self.facts.show_rows(())
        empty = "Opening the world" if self.run.exists else "Starts with the run"
        self.possible.show_rows((), False, empty)
        self.timeline.show_lanes((), 0.0)
        self.check.show_check(None, None, waiting=False)
        self._facts_rate.setText("")
        self._facts_note.setText("")
        self.moved.emit({}, "")

    def _tell(self, events: tuple[Event, ...]) -> None:
        self.events.add_events(events)
        for event in events:
            why = asked_words(event)
            if why:
                self.canvas.say(why)

    def _show_world(self) -> None:
        self._facts_rate.setText(rate_words(self.run.sensors))
        self.scene.load()

    def _draw_world(self) -> None:
        self.scene.draw()
        if not self.run.exists:
            self._frames.stop()

    def _say_refused(self, error: StudioError) -> None:
        self._frames.stop()
        self.canvas.show_refusal(begin_words(error))
