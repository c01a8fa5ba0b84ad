"""The window: a shell around its features. It knows no verb of the domain."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QCloseEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QMainWindow, QWidget

from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.feature import AllWindows, Control, DockSides
from smsl_studio.studio.base.lines.typed_field import take_over
from smsl_studio.studio.base.own_keys import read_keys
from smsl_studio.studio.base.settings import KEYS
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.document.files.auto_save import AutoSave
from smsl_studio.studio.document.files.collapse_choice import CollapseChoice
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.fresh import empty_blueprint
from smsl_studio.studio.document.inspector import Inspector
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.running.window_parts import WindowParts
from smsl_studio.studio.shell.announcer import Announcer
from smsl_studio.studio.shell.crash_page import crash_page
from smsl_studio.studio.shell.departure import Departure
from smsl_studio.studio.shell.features import Features
from smsl_studio.studio.shell.frame.body import PageBody
from smsl_studio.studio.shell.frame.captions import Captions
from smsl_studio.studio.shell.frame.docks import Docks
from smsl_studio.studio.shell.frame.dropped_files import DroppedFiles
from smsl_studio.studio.shell.frame.help import about_dialog, shortcuts_dialog
from smsl_studio.studio.shell.frame.keys_home import KeysHome
from smsl_studio.studio.shell.frame.menu_row import MenuRow
from smsl_studio.studio.shell.frame.mode_bar import ModeBar
from smsl_studio.studio.shell.frame.modes import Modes
from smsl_studio.studio.shell.frame.page_row import PageRow
from smsl_studio.studio.shell.frame.screen_room import ScreenRoom
from smsl_studio.studio.shell.frame.status_line import StatusLine
from smsl_studio.studio.shell.menus import all_actions
from smsl_studio.studio.shell.plugin_question import PluginQuestions
from smsl_studio.studio.shell.stop_key import StopKey
from smsl_studio.studio.shell.windows import Windows


class Window(QMainWindow):
    """One window with one blueprint."""

    def __init__(self, windows: Windows) -> None:
        super().__init__()
        self._windows, self._settings = windows, windows.settings
        self.tokens = windows.tokens
        self._closes = False
        self._room, self._announcer = ScreenRoom(self), Announcer(self)
        DroppedFiles(self.open_path, self._open_beside, self)
        self.session = Session(empty_blueprint(), self)
        self.files = Files(self.session, self._settings, Dialogs(self), self)
        AutoSave(self.session, self.files, self._settings)
        self.inspector = Inspector(self.session, self)
        self._build_features()
        self._name_parts()
        self.actions_table = Actions(
            all_actions(self.features, self),
            self,
            self.tokens,
            self.settle,
            read_keys(self._settings.text_of(KEYS)),
        )
        self._build_frame()
        self._connect()
        self._restore()
        self.show_plugins()
        windows.add(self)

    # Building.

    def _build_features(self) -> None:
        self.body = PageBody()
        self.setCentralWidget(self.body)
        self.toast = Toast(self.tokens, self.body)
        self.parts = WindowParts(
            self.session,
            self.files,
            self.inspector,
            self._settings,
            CollapseChoice(self.session, self.files, self._settings),
            self.toast,
            self.tokens,
            self,
        )
        self.features = Features(self.parts, self, self._windows)
        self.leaving = Departure(self.features.may_leave, self.files, Dialogs(self))
        PluginQuestions(self._windows, self).refused.connect(self.toast.refuse)
        self._stop_key = StopKey(self._windows.application, self._windows.stop_every_run, self)
        panels = [panel for feature in self.features for panel in feature.panels]
        self.docks = Docks(self, panels, self.tokens)
        pages = {mode: page for feature in self.features for mode, page in feature.pages.items()}
        pages |= {page.id: page.make for feature in self.features for page in feature.mode_pages}
        self._modes = Modes(pages, self.body, self.docks, self._settings)

    def _name_parts(self) -> None:
        """Give the parts of the features names at the window, for tests and scripts.

        The shell itself uses ``features``. A panel needs no name here: ``docks.panel`` gives it.
        """
        draw = self.features.draw
        self.canvas, self.editor, self.fix_card = draw.canvas, draw.editor, draw.fix_card
        self.drawing, self.clipping = draw.drawing, draw.clipping
        self.outline, self.library, self.history = draw.outline, draw.library, draw.history
        self.facts = draw.facts
        self.properties, self.source, self.findings = draw.properties, draw.source, draw.findings
        self.comparing, self.safety, self.going = draw.comparing, draw.safety, draw.going

    def _build_frame(self) -> None:
        actions, tokens = self.actions_table, self.tokens
        submenus = {
            name: menu for feature in self.features for name, menu in feature.submenus.items()
        }
        self.menu_row = MenuRow(actions, tokens, submenus)
        for feature in self.features:
            for badge in feature.badges:
                self.menu_row.add_badge(badge)
        self.setMenuWidget(self.features.below(self.menu_row))
        self.mode_bar = ModeBar(actions, tokens)
        self.addToolBar(Qt.ToolBarArea.TopToolBarArea, self.mode_bar)
        self.page_row = PageRow([one for f in self.features for one in f.mode_pages])
        self.addToolBarBreak(Qt.ToolBarArea.TopToolBarArea)
        self.addToolBar(Qt.ToolBarArea.TopToolBarArea, self.page_row)
        self.page_row.page_wanted.connect(self.set_mode)
        self.status_line = StatusLine()
        self.setStatusBar(self.status_line)
        self.toast.line = self.status_line
        self._modes.dress(self.mode_bar, self.status_line)
        KeysHome(self._modes, (self.mode_bar, self.menu_row), self)
        self._captions = Captions(
            self.session,
            self.files,
            self.features.tell_caret,
            self.menu_row,
            self.status_line,
            self,
        )
        self._captions.other = lambda: self.features.other(self.mode)
        for feature in self.features:
            feature.take_actions(actions)
        self.command_palette = self.features.draw.palette

    def _connect(self) -> None:
        session, actions, features = self.session, self.actions_table, self.features
        actions.later = session.afterwards.show
        session.afterwards.follow(
            actions.refresh, session.blueprint_changed, session.selection_changed,
            session.branch_changed, session.stepped)  # fmt: skip
        self.files.settling.connect(self.settle)
        self.files.refused.connect(self.toast.refuse)
        self.files.said.connect(self.toast.say)
        self.docks.changed.connect(actions.refresh)
        self.mode_bar.search_wanted.connect(self.open_palette)
        self._windows.plugins.changed.connect(self.show_plugins)
        features.caret_moved.connect(self.status_line.show_caret)
        features.run_exists.connect(self._run_exists)
        features.said.connect(self._show_said)
        features.named.connect(self._captions.show_title)
        features.phase_shown.connect(self.mode_bar.show_phase)
        features.phase_shown.connect(self._announcer.tell_phase)
        features.phase_shown.connect(lambda *_: self._windows.dress_late())

    # What the features may ask of the shell.

    @property
    def mode(self) -> str:
        """The current mode, such as "draw"."""
        return self._modes.shown

    @property
    def sides(self) -> DockSides:
        """The docks beside the drawing."""
        return self.docks

    @property
    def program(self) -> AllWindows:
        """The program with all its windows."""
        return self._windows

    def new_window(self) -> None:
        """Show another empty window, a little below this one."""
        self._beside().set_mode("draw")

    def copy_beside(self, path: Path) -> None:
        """Open a copy of a sample in another window, a little below this one."""
        window = self._beside()
        window.files.open_copy(path)
        window.set_mode("draw")

    def _beside(self) -> Window:
        window = Window(self._windows)
        window.move(self.pos() + QPoint(32, 32))
        window.show()
        return window

    def _open_beside(self, path: Path) -> None:
        window = self._beside()
        window.open_path(path)
        window.set_mode(window.mode)

    def set_mode(self, mode: str) -> None:
        """Switch to Draw, Run, Supervise or Replay.

        As long as nothing is open, the start page stands for Draw.
        """
        if mode == "draw" and not self.files.is_open:
            mode = "start"
        if mode != self.mode:
            self._modes.show(mode, self.size())
            self.page_row.show_mode(mode)
            self.features.mode_shown()
            self._show_said()
            self._captions.show_title()
        self.actions_table.refresh()

    def wear(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.tokens = tokens
        fold = self.docks.fold
        frame = (self.menu_row, self.mode_bar, fold, self.toast, self.actions_table)
        for part in (*self.features, *frame):
            part.set_tokens(self.tokens)
        self.actions_table.refresh()

    @property
    def name(self) -> str:
        """The name of the file that is shown."""
        return self.files.name

    def open_path(self, path: Path) -> None:
        """Open a file: a blueprint, or what a feature can open, such as a recorded run."""
        if not any(feature.open_path(path) for feature in self.features):
            self.files.open(path)

    def say(self, sentence: str) -> None:
        """Show a message."""
        self.toast.say(sentence)

    @property
    def runs(self) -> bool:
        """Whether something moves in its run."""
        return self.features.runs

    def stop_run(self) -> None:
        """Stop the run of this window."""
        self.features.stop_run()

    def end_run(self) -> None:
        """Stop the run under control and release it, without a question."""
        self.features.end_run()

    def keep_unsaved(self) -> bool:
        """Write the journal now; returns whether there is unsaved work."""
        return self.features.keep_unsaved()

    def leave_behind(self) -> bool:
        """Keep unsaved work for the next start; returns whether there is any."""
        return self.features.leave_behind()

    def tell_failure(self, sentence: str) -> None:
        """Show that the program failed, and offer the report."""
        self.toast.fail(sentence, "Read the report", self.show_failure)
        self.actions_table.refresh()

    def has_failure(self) -> bool:
        """Whether the program failed since its start."""
        return self._windows.failure is not None

    def show_failure(self) -> None:
        """Show the report of the last failure; nothing is written before the person keeps it."""
        if self._windows.failure is not None:
            crash_page(*self._windows.failure, self).open()

    def open_palette(self) -> None:
        """Open the command palette."""
        self.features.open_palette(self.search_corner())

    def search_corner(self) -> QPoint:
        """The point of the window below the search field, or below the bar if the field is
        hidden."""
        box = self.mode_bar.search
        if box.isVisible():
            return box.mapTo(self, QPoint(box.width(), box.height() + 4))
        return QPoint(self.width() - 12, self.body.y() + 8)

    def corner_below(self, action: str) -> QPoint:
        """The point of the screen below the button of an action."""
        return self.mode_bar.below(action)

    def controls(self, name: str) -> list[Control]:
        """The controls of this name in all features and in the mode bar, visible or not."""
        found = [self.mode_bar.control(name), *(one.control(name) for one in self.features)]
        return [control for control in found if control is not None]

    def show_tab(self, name: str) -> None:
        """Show the panel of this name."""
        self.docks.show_tab(name)

    def show_count(self, panel: str, count: int) -> None:
        """Show a number on the tab of a panel."""
        self.docks.bottom_tabs.set_count(panel, count)

    def show_page(self, page: str, count: int | None) -> None:
        """Offer a page of Draw in the row of pages, with a number; None takes it away."""
        self.page_row.show_page(page, count)
        if count is None and self.mode == page:
            self.set_mode("draw")

    def hold_run(self, reason: str) -> None:
        """Let Run wait, for a reason in words; empty text lets it go on."""
        self.mode_bar.hold_run(reason)

    def show_segment(self, name: str, shown: bool) -> None:
        """Show or hide the button of a mode in the mode bar."""
        self.mode_bar.segments.show_segment(name, shown)

    def add_badge(self, badge: QWidget) -> None:
        """Add a badge at the right of the menus."""
        self.menu_row.add_badge(badge)

    def say_findings(self, words: str) -> None:
        """Show the number of findings in the status line."""
        self.status_line.show_findings(words)
        self._announcer.tell_findings(words)

    def show_shortcuts(self) -> None:
        """Show the list of all shortcuts."""
        own = [keys for feature in self.features for keys in feature.keys]
        shortcuts_dialog(self.actions_table, own, self).open()

    def show_about(self) -> None:
        """Show the name of the program and its version."""
        about_dialog(self).open()

    # What is shown.

    def show_plugins(self) -> None:
        """Hand what the installed plugins offer to the features, and name a plugin that failed."""
        plugins = self._windows.plugins
        for feature in self.features:
            feature.set_plugins(plugins.loaded, plugins.known)
        if plugins.loaded.faults:
            self.toast.warn(str(plugins.loaded.faults[0]))
        elif plugins.news:
            self.toast.say(plugins.news)

    def settle(self) -> None:
        """Take over what is still being typed; the focus stays in its field."""
        self.session.afterwards.catch_up()
        for feature in self.features:
            feature.settle()
        take_over(self.focusWidget())

    def _run_exists(self, exists: bool) -> None:
        self.mode_bar.show_stop(exists)
        self._stop_key.listen(exists)

    def _show_said(self) -> None:
        """Show the texts of the mode in the status line."""
        self.status_line.show_run(self.features.words(self.mode))

    # Qt's events.

    def _restore(self) -> None:
        self._room.restore(self._settings.bytes_of("window"))
        self._modes.restore()

    def showEvent(self, event: QShowEvent) -> None:
        """Keep the window on its screen."""
        super().showEvent(event)
        self._room.shown()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the panels into the new size."""
        super().resizeEvent(event)
        self._modes.fit(self.size())

    def closeEvent(self, event: QCloseEvent) -> None:
        """Close if the person agrees; then end the run and remember the places of the panels."""
        if self._closes or not self.leaving.may_close():
            event.ignore()
            return
        self._closes = True
        self.features.stop()
        self._settings.store("window", self.saveGeometry())
        self._modes.keep()
        self._settings.sync()
        self._stop_key.listen(False)
        self.inspector.stop()
        # The history is cleared when it is deleted, and its listeners are gone by then.
        self.session.history.blockSignals(True)
        self._windows.remove(self)
        event.accept()
