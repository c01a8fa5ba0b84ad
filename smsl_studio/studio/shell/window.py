"""The window: a shell around canvas, panels and run. It knows no verb of the domain."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QCloseEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QMainWindow, QMenu

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.lines.typed_field import take_over
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.fresh import empty_blueprint
from smsl_studio.studio.document.inspector import Inspector
from smsl_studio.studio.document.notices import step_notice
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas import popups
from smsl_studio.studio.features.draw.canvas.clipboard import ClipboardVerbs
from smsl_studio.studio.features.draw.canvas.context_menu import context_menu
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.fix_card import FixCard
from smsl_studio.studio.features.draw.compare.comparison import Comparison
from smsl_studio.studio.features.draw.files.dialogs import Dialogs
from smsl_studio.studio.features.draw.files.dropped_files import DroppedFiles
from smsl_studio.studio.features.draw.find.destinations import Destinations
from smsl_studio.studio.features.draw.find.finder import Finder
from smsl_studio.studio.features.draw.find.palette import Palette
from smsl_studio.studio.features.draw.panels.findings import Findings
from smsl_studio.studio.features.draw.panels.history import History
from smsl_studio.studio.features.draw.panels.library import Library
from smsl_studio.studio.features.draw.panels.offers import offers, operation_names
from smsl_studio.studio.features.draw.panels.outline import Outline
from smsl_studio.studio.features.draw.panels.properties import Properties
from smsl_studio.studio.features.draw.safety.safety import Safety
from smsl_studio.studio.features.draw.source.pane import SourcePane
from smsl_studio.studio.features.draw.tidings import Tidings
from smsl_studio.studio.features.replay.watched import Watched
from smsl_studio.studio.shell.departure import Departure
from smsl_studio.studio.shell.frame.body import PageBody
from smsl_studio.studio.shell.frame.captions import Captions
from smsl_studio.studio.shell.frame.docks import Docks
from smsl_studio.studio.shell.frame.help import about_dialog, shortcuts_dialog
from smsl_studio.studio.shell.frame.keys_home import KeysHome
from smsl_studio.studio.shell.frame.menu_row import MenuRow
from smsl_studio.studio.shell.frame.mode_bar import ModeBar
from smsl_studio.studio.shell.frame.modes import Modes, Page
from smsl_studio.studio.shell.frame.screen_room import ScreenRoom
from smsl_studio.studio.shell.frame.status_line import StatusLine
from smsl_studio.studio.shell.menus import all_actions
from smsl_studio.studio.shell.plugin_question import PluginQuestions
from smsl_studio.studio.shell.runs import Runs
from smsl_studio.studio.shell.shown_file import ShownFile
from smsl_studio.studio.shell.stop_key import StopKey
from smsl_studio.studio.shell.windows import Windows


class Window(QMainWindow):
    """One window on one blueprint."""

    def __init__(self, windows: Windows) -> None:
        super().__init__()
        self._windows, self._settings = windows, windows.settings
        self.tokens = windows.tokens
        self._closes = False
        self._room = ScreenRoom(self)
        DroppedFiles(self.open_path, lambda path: self._beside().open_path(path), self)
        self.session = Session(empty_blueprint(), self)
        self.files = Files(self.session, self._settings, Dialogs(self), self)
        self.inspector = Inspector(self.session, self)
        self._build_panels()
        self._build_actions()
        self._build_frame()
        self._connect()
        self._restore()
        self.show_plugins()
        windows.add(self)

    # Building.

    def _build_panels(self) -> None:
        session, tokens, settings = self.session, self.tokens, self._settings
        self.canvas = Canvas(tokens)
        self.editor = CanvasEditor(session, self.canvas)
        self.drawing = DrawVerbs(session, self.editor)
        self.clipping = ClipboardVerbs(session, self.canvas, lambda words: self.toast.say(words))
        self.runs = Runs(session, settings, self._windows.persons, tokens, self)
        self.runs.keep_warm(self._windows.spare)
        self.run_pane, self.supervise = self.runs.pane, self.runs.supervise
        self.people, self.replaying = self.runs.people, self.runs.replaying
        self.leaving = Departure(self.runs, self.files, Dialogs(self))
        self.outline, self.library = Outline(session, tokens), Library(session, tokens)
        self.properties, self.source = Properties(session, tokens), SourcePane(session, tokens)
        self.findings = Findings(session, tokens, self.inspector.rules)
        self.history = History(session, tokens)
        self.body = PageBody()
        self.setCentralWidget(self.body)
        self.toast = Toast(tokens, self.body)
        self.fix_card = FixCard(session, self.canvas, tokens)
        ask = Dialogs(self).file_to_open
        self.comparing = Comparison(session, self.files, ask, tokens, self)
        self.safety = Safety(
            session, self.files, self.source, self.toast, self._settings,
            self.comparing.with_version, tokens, self,
        )  # fmt: skip
        PluginQuestions(self._windows, self).refused.connect(self.toast.refuse)
        self._stop_key = StopKey(self._windows.application, self._windows.stop_every_run, self)
        self.docks = Docks(self, self.outline, self.library)
        self.docks.right_tabs.add("Properties", self.properties)
        self.docks.right_tabs.add("Source", self.source)
        self.docks.bottom_tabs.add("Findings", self.findings, self.findings.tools)
        self.docks.bottom_tabs.add("History", self.history)

        pages = {"draw": Page(self.canvas, self.canvas), **self.runs.pages()}
        self._modes = Modes(pages, self.body, self.docks, self._settings)

    def _build_actions(self) -> None:
        watched = Watched(self.run_pane, self.replaying.replay, lambda: self.mode)
        table = all_actions(
            self, self.session, self.files, self.drawing, self.clipping, self.findings, self.docks,
            watched, self._windows, self.comparing, self.supervise,
            self.people, self.open_task, self.replaying,
        )  # fmt: skip
        self.actions_table = Actions(table, self, self.tokens, self.settle)

    def _build_frame(self) -> None:
        actions, tokens = self.actions_table, self.tokens
        submenus: dict[str, tuple[str, Callable[[QMenu], None]]] = {
            "open": ("Open recent", partial(popups.fill_recent, self.files)),
            "new": ("Open sample", partial(popups.fill_samples, self.files)),
            "open_recording": ("Recordings", self.replaying.fill),
        }
        self.menu_row = MenuRow(actions, tokens, submenus)
        self.menu_row.add_badge(self.people.badge)
        self.setMenuWidget(self.safety.below(self.menu_row))
        self.mode_bar = ModeBar(actions, tokens)
        self.addToolBar(Qt.ToolBarArea.TopToolBarArea, self.mode_bar)
        self.status_line = StatusLine()
        self.setStatusBar(self.status_line)
        self._modes.dress(self.mode_bar, self.status_line)
        KeysHome(self._modes, (self.mode_bar, self.menu_row), self)
        segments = self.mode_bar.segments
        self._showing = ShownFile(self, self.files, self.replaying, self.safety, segments)
        self._captions = Captions(
            self.session, self.files, self.source, self.menu_row, self.status_line, self
        )
        self._captions.other = lambda: self.runs.other(self.mode)
        self.going = Destinations(self.docks, self.properties, self.files)
        finder = Finder(self.session, actions, self.findings, self.going)
        self.command_palette = Palette(finder, tokens, self)
        marked = (self.outline, self.library, self.source, self.fix_card)
        self.tidings = Tidings(
            self.session, self.inspector, self.findings, self.editor, marked,
            self.status_line.show_findings, actions.refresh, self,
        )  # fmt: skip

    def _connect(self) -> None:
        session, actions = self.session, self.actions_table
        session.blueprint_changed.connect(lambda *_: self._show_offers())
        for signal in (session.blueprint_changed, session.selection_changed,
                       session.branch_changed, session.history.indexChanged):  # fmt: skip
            signal.connect(lambda *_: actions.refresh())
        session.opened.connect(self.tidings.forget)
        session.opened.connect(self.toast.hide)
        session.opened.connect(self.canvas.setFocus)
        session.jumped.connect(self._jumped)
        session.history.indexChanged.connect(lambda _: self.toast.edited())
        session.broken_changed.connect(self._show_broken)
        session.refused.connect(self._refused)
        session.blueprint_changed.connect(self._say_of_step)
        self.files.settling.connect(self.settle)
        self.files.refused.connect(self.toast.refuse)
        self.comparing.refused.connect(self.toast.refuse)
        self.comparing.element_shown.connect(lambda _: self.set_mode("draw"))
        self.comparing.element_shown.connect(self._jumped)
        self.comparing.said.connect(self.toast.say)
        self.files.said.connect(self.toast.say)
        self.findings.count_changed.connect(
            lambda count: self.docks.bottom_tabs.set_count("Findings", count)
        )
        self.fix_card.fix_wanted.connect(self.findings.fix)
        self.outline.fact_wanted.connect(self.going.show_fact)
        self.outline.file_wanted.connect(lambda file: self.files.open(Path(file)))
        self.outline.verb_wanted.connect(self.clipping.on_branch)
        self.outline.action_wanted.connect(lambda name: actions[name].trigger())
        self.outline.branch_deleted.connect(self._say_deleted)
        self.canvas.fact_wanted.connect(
            lambda digit: self.going.show_fact(self.session.branch, digit)
        )
        self.canvas.verb_wanted.connect(lambda name: actions[name].trigger())
        self.properties.file.ask_file = Dialogs(self).file_to_open
        self.canvas.context_wanted.connect(self._open_context_menu)
        self.docks.changed.connect(actions.refresh)
        self.comparing.changed.connect(actions.refresh)
        self.canvas.overlays.empty.sample_wanted.connect(self._offer_samples)
        self.mode_bar.search_wanted.connect(self.open_palette)
        self._windows.plugins.changed.connect(self.show_plugins)
        self.run_pane.run_exists.connect(self._run_exists)
        self.run_pane.said.connect(self._show_said)
        self.run_pane.named.connect(self._captions.show_title)
        self.files.asking.connect(self.run_pane.file_asked)
        self.runs.light(self.outline, self.source, self.mode_bar)
        self.replaying.refused.connect(self.toast.refuse)
        self.replaying.pane.said.connect(self._show_said)
        self.replaying.replay.opened.connect(self._captions.show_title)
        self.people.task_wanted.connect(self.open_task)
        self.people.changed.connect(actions.refresh)

    # What the actions ask of the shell.

    @property
    def mode(self) -> str:
        return self._modes.shown

    def new_window(self) -> None:
        """Show another window, empty, on what the plugins offer here."""
        self._beside()

    def _beside(self) -> Window:
        window = Window(self._windows)
        window.move(self.pos() + QPoint(32, 32))
        window.show()
        return window

    def set_mode(self, mode: str) -> None:
        """Show Draw, Run or Supervise."""
        if mode != self.mode:
            self._modes.show(mode, self.width())
            self.runs.warming.soon()
            self._show_said()
            self._captions.show_title()
        self.actions_table.refresh()

    def wear(self, tokens: Tokens) -> None:
        """Paint everything in these colours."""
        self.tokens = tokens
        panels = (self.outline, self.library, self.properties, self.source, self.findings)
        frame = (self.menu_row, self.mode_bar, self.command_palette, self.fix_card, self.toast)
        others = (self.runs, self.comparing, self.safety, self.actions_table)
        for part in (self.canvas, *panels, *frame, *others):
            part.set_tokens(self.tokens)
        self.actions_table.refresh()

    @property
    def name(self) -> str:
        """The name of the file that is shown."""
        return self.files.name

    def open_path(self, path: Path) -> None:
        """Show a blueprint or a recorded run."""
        self._showing.open(path)

    def stop_run(self) -> None:
        self.run_pane.stop()

    def end_run(self) -> None:
        """Stop the run under control and let go of it; nothing is asked."""
        self.runs.end()

    def warn(self, words: str) -> None:
        """Say something that went wrong."""
        self.toast.warn(words)

    def open_task(self) -> None:
        """Show what people are asked, with the keys on it and no answer chosen."""
        self.set_mode("supervise")
        self.people.card.take_focus()

    def open_palette(self) -> None:
        box = self.mode_bar.search
        corner = QPoint(self.width() - 12, self.body.y() + 8)
        if box.isVisible():
            corner = box.mapTo(self, QPoint(box.width(), box.height() + 4))
        self.command_palette.open(corner)

    def choose_sub_sb(self) -> None:
        """A menu of the facts, and of the SBs that could expand each."""
        menu = popups.passing_menu(self)
        popups.fill_sub_sbs(self.session, self.drawing, menu)
        menu.popup(self.mode_bar.below("sub_sb"))

    def show_tab(self, name: str) -> None:
        self.docks.show_tab(name)

    def show_shortcuts(self) -> None:
        shortcuts_dialog(self.actions_table, self).open()

    def show_about(self) -> None:
        about_dialog(self).open()

    # What is shown.

    def show_plugins(self) -> None:
        """What the installed plugins offer; those that did not load are named."""
        plugins = self._windows.plugins
        self._show_offers()
        self.source.set_library(operation_names(plugins.loaded))
        self.properties.set_plugins(plugins.loaded)
        if plugins.known:
            self.run_pane.set_plugins(plugins.loaded)
        if plugins.loaded.faults:
            self.toast.warn(str(plugins.loaded.faults[0]))
        elif plugins.news:
            self.toast.say(plugins.news)

    def _show_offers(self) -> None:
        self.library.set_offers(offers(self._windows.plugins.loaded, self.session.blueprint))

    def _show_broken(self) -> None:
        """A text that does not read is repaired in the source, where its faults are marked."""
        if self.session.broken is not None and self.mode == "draw":
            self.show_tab("Source")

    def _say_of_step(self, before: Blueprint, after: Blueprint) -> None:
        self.toast.of_step(*step_notice(before, after))

    def _jumped(self, address: Address) -> None:
        """What was found is in view, and the keys act on it."""
        self.canvas.reveal(address)
        if self.mode == "draw":
            self.canvas.setFocus()

    def _say_deleted(self, name: str, states: int) -> None:
        """A whole SB has gone by one key: say so, and offer to take it back."""
        words = f"Deleted State Branch {name} with {counted(states, 'state')}."
        self.toast.offer(words, "Undo", self.session.history.undo)

    def _refused(self, error: StudioError) -> None:
        """Say it in a line, unless the field in which it was typed says it."""
        if self.editor.field is None:
            self.toast.refuse(error)

    def settle(self) -> None:
        """What is still being typed counts: leaving a field takes it over, then one goes on."""
        self.source.settle()
        take_over(self.focusWidget())

    def _run_exists(self, exists: bool) -> None:
        self.mode_bar.show_stop(exists)
        self._stop_key.listen(exists)

    def _show_said(self) -> None:
        """The status line speaks of the replay while that is shown, else of the run."""
        shown = self.replaying.pane if self.mode == "replay" else self.run_pane
        self.status_line.show_run(shown.words)

    def _open_context_menu(self, address: Address | None, at: QPoint) -> None:
        menu = context_menu(self.session, self.editor, self.actions_table, self.clipping, address)
        menu.popup(at)

    def _offer_samples(self) -> None:
        menu = popups.passing_menu(self)
        popups.fill_samples(self.files, menu)
        button = self.canvas.overlays.empty.sample
        menu.popup(button.mapToGlobal(QPoint(0, button.height() + 4)))

    # Qt's events.

    def _restore(self) -> None:
        self._room.restore(self._settings.bytes_of("window"))
        self._modes.restore()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._room.shown()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._modes.fit_width(self.width())

    def closeEvent(self, event: QCloseEvent) -> None:
        if self._closes or not self.leaving.may_close():
            event.ignore()
            return
        self._closes = True
        self.runs.end()
        for part in (self.source, self.comparing, self.replaying, self.findings):
            part.stop()
        self.safety.close()
        self._settings.store("window", self.saveGeometry())
        if self.mode == "draw":
            self._modes.keep()
        self._settings.sync()
        self._stop_key.listen(False)
        self.inspector.stop()
        # The history empties itself when it goes, and nobody is left to be told.
        self.session.history.blockSignals(True)
        self._windows.remove(self)
        event.accept()
