"""The world of a run: its picture, or its facts as tiles if there is nothing to draw."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QHBoxLayout,
    QMenu,
    QStackedWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.front.views.fact_rows import FactRow
from smsl_studio.front.views.fact_tiles import fact_tiles
from smsl_studio.front.views.run_marks import operation_words, progress, time_words
from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.running.forecast_bar import HIGH as BAR
from smsl_studio.studio.running.forecast_bar import ForecastBar
from smsl_studio.studio.running.forecaster import proposed
from smsl_studio.studio.running.frames import MIDDLE, laid_over, tool, tools_over, words_over
from smsl_studio.studio.running.operation_bar import OperationBar
from smsl_studio.studio.running.operation_time import WHY
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.scene.camera import VIEWS
from smsl_studio.studio.running.scene.ghost import Ghost
from smsl_studio.studio.running.scene.kept_poses import KeptPoses
from smsl_studio.studio.running.scene.world_view import WorldView
from smsl_studio.studio.running.tiles import TilesView

LEAST_SLIDER = 60
"""So much wider than its least is the bar of a forecast, if it shall stand in one line with others
(pixels)."""
FAULT = "Let something go wrong, now or at a chosen moment (Ctrl+Shift+I)"
SCRIPT = "Save what was done by hand as a script"


class WorldPane(QWidget):
    """Shows the world of ``run``, and the forecast of an operation as a ghost in it.

    ``view`` is its picture. ``tiles`` and ``bar`` stand in its place if the world has no shapes or
    there are no graphics. One that only ``watches`` offers no trials, and another part asks for the
    forecasts. Above it are the buttons for a fault and for the script of what was done
    by hand. ``kept`` are the poses that were watched, for a clip.
    """

    fault_wanted = Signal()
    """The person wants to inject a fault."""
    script_wanted = Signal()
    """The person wants to save what was done by hand as a script."""
    picture_wanted = Signal()
    """The person wants to save the picture."""
    clip_wanted = Signal()
    """The person wants to save a clip of what was watched."""

    def __init__(self, run: RunSession, tokens: Tokens, watches: bool = False) -> None:
        super().__init__()
        self._run, self._watches = run, watches
        self._loaded = False
        self.view = WorldView(tokens)
        self.kept, self.ghost = KeptPoses(), Ghost(self)
        self.moment = ForecastBar(self.ghost, tokens)
        self.ghost.moved.connect(self._show_ghost)
        self.view.came_into_view.connect(self.draw)
        self.view.came_into_view.connect(self._look_ahead)
        self.tiles, self.bar = TilesView(tokens), OperationBar(tokens)
        self._name = Elided("")
        self._name.setProperty("role", "second")
        self._looks = tool("Front right", "camera", "Where to look from; save what is seen", tokens)
        self._looks.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self._looks)
        for name in VIEWS:
            menu.addAction(name, partial(self._look, name))
        menu.addSeparator()
        self.follow = menu.addAction("Follow the tool")
        self.follow.setCheckable(True)
        self.follow.toggled.connect(self.view.follow)
        menu.addSeparator()
        menu.addAction("Save picture…", self.picture_wanted.emit)
        self.clip = menu.addAction("Save clip…", self.clip_wanted.emit)
        menu.aboutToShow.connect(lambda: self.clip.setEnabled(len(self.kept) > 1))
        self._looks.setMenu(menu)
        self._home = tool("", "fit", "Back to the chosen view", tokens)
        self._home.clicked.connect(self.view.come_back)
        self.fault = tool("Fault…", "warning", FAULT, tokens)
        self.fault.clicked.connect(self.fault_wanted)
        self.script = tool("Script…", "save", SCRIPT, tokens)
        self.script.clicked.connect(self.script_wanted)
        self._tools = tools_over(self._looks, self._home)
        self._tools.hide()
        self._trials = tools_over(self.fault, self.script)
        self._build()
        run.progressed.connect(self.show_time)
        run.forecaster.changed.connect(self.show_forecast)

    def _build(self) -> None:
        plain = QWidget()
        plain.setProperty("role", "panel")
        column = QVBoxLayout(plain)
        column.setContentsMargins(12, 2 * MIDDLE, 4, 0)
        column.setSpacing(0)
        column.addWidget(self.tiles, 1)
        column.addWidget(self.bar)
        self._pages = QStackedWidget()
        self._pages.addWidget(self.view)
        self._pages.addWidget(plain)
        self._words = words_over(label("World", "heading"), self._name)
        self._words.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._buttons = QWidget()
        across = QHBoxLayout(self._buttons)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(0)
        across.addWidget(self._trials)
        across.addWidget(self._tools)
        foot = QWidget()
        self._foot = QHBoxLayout(foot)
        self._foot.setContentsMargins(12, 0, 12, 12)
        self._foot.addWidget(self.moment)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(laid_over(self._pages, self._words, self._buttons, foot))
        self.show_trials()

    @property
    def shows_tiles(self) -> bool:
        """Whether the facts stand in the place of the picture."""
        return self._pages.currentIndex() == 1

    def load(self) -> None:
        """Show the world of the run, which is open now."""
        run, self._loaded = self._run, True
        name = run.choice.world if run.choice else ""
        self.view.load(run.shapes, name)
        self.kept.clear()
        if not run.shapes:
            self._name.setText(name)
        elif self.view.has_picture:
            self._name.setText(f"{name}, from poses")
        else:
            self._name.setText(f"{name}. {self.view.sentence}")
        self._tools.setVisible(self.view.has_picture)
        # Over a picture the buttons are small, so that they hide little of it.
        style = Qt.ToolButtonStyle
        small = (
            style.ToolButtonIconOnly if self.view.has_picture else style.ToolButtonTextBesideIcon
        )
        for button in (self.fault, self.script):
            button.setToolButtonStyle(small)
        self._fit()
        self.draw()

    def clear(self) -> None:
        """Show that there is no run."""
        self._loaded = False
        self.ghost.show(None)
        self.view.clear()
        self.kept.clear()
        self._name.setText("")
        self._tools.hide()
        self._trials.hide()
        self._pages.setCurrentIndex(0)

    def show_trials(self) -> None:
        """Show which of the trials by hand are possible now."""
        run, acts = self._run, len(self._run.lines)
        self._trials.setVisible(not self._watches and (run.exists or bool(acts)))
        self.fault.setEnabled(run.exists)
        self.script.setEnabled(bool(acts))
        words = f"Script {acts}…" if acts else "Script…"
        if self.script.text().strip() != words:
            self.script.setText(words)
            self.script.setAccessibleName(f"{counted(acts, 'act')} by hand. {SCRIPT}")
        self._fit()

    def draw(self) -> None:
        """Draw the newest poses, also those of a run that has ended."""
        run = self._run
        if self._loaded and self.view.isVisible():
            poses = run.poses()
            self.kept.add(run.time, poses)
            self.view.show_poses(poses, run.words(), last=not run.exists)

    def _look_ahead(self) -> None:
        """Forecast the operation that is proposed, where the picture can show that."""
        run, edge = self._run, proposed(self._run.status)
        if not self._watches and self.isVisible() and self.view.has_picture and edge is not None:
            run.forecaster.follow(run.asked, run.status, edge)
        self.show_forecast()

    def show_forecast(self) -> None:
        """Play the forecast of the run once as a ghost, while an operation is proposed."""
        view, edge = self._run.forecaster.view, proposed(self._run.status)
        if self.isVisible():
            seen = self.view.has_picture and view is not None and edge is not None
            self.ghost.show(view.frames if seen and view is not None else None)

    def _show_ghost(self) -> None:
        self._fit_foot()
        self.view.show_ghost(self.ghost.place)

    def _fit_foot(self) -> None:
        """Put the bar of the forecast beside the words of the world, and below them if they leave
        it no room."""
        wanted = self.moment.sizeHint().width() + LEAST_SLIDER
        beside = round(self.view.reach) + 8
        fits = self.width() - beside - 12 >= wanted
        self._foot.setContentsMargins(beside if fits else 12, 0, 12, 12)
        self.view.foot = BAR + 6 if self.ghost.seconds > 0 and not fits else 0

    def show_facts(self, rows: tuple[FactRow, ...]) -> None:
        """Show the facts of the run, if the world has no picture, and look ahead if it has one."""
        self.show_trials()
        self._look_ahead()
        blueprint, status = self._run.blueprint, self._run.status
        if blueprint is None or status is None or self.view.has_picture or not self._loaded:
            self._pages.setCurrentIndex(0)
            return
        self._pages.setCurrentIndex(1)
        self.tiles.show_tiles(fact_tiles(blueprint, rows))
        self.show_time()

    def show_time(self) -> None:
        """Show what runs, and how far it is."""
        run, shown = self._run, self._run.shown_time
        blueprint, status = run.blueprint, run.status
        if blueprint is None or status is None or not self.shows_tiles:
            return
        share, why = progress(blueprint, status, run.story), ""
        time = time_words(blueprint, status, run.story)
        if shown is not None and shown.address == status.running:
            share, time, why = shown.share, shown.said, WHY
        self.tiles.show_share(share or 0.0)
        self.bar.show_operation(operation_words(blueprint, status), time, share, why)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.view, self.tiles, self.bar, self.moment):
            part.set_tokens(tokens)
        self._looks.setIcon(icon("camera", tokens))
        self._home.setIcon(icon("fit", tokens))
        self.fault.setIcon(icon("warning", tokens))
        self.script.setIcon(icon("save", tokens))

    def _look(self, name: str) -> None:
        self._looks.setText(name)
        self.view.set_view(name)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Shorten the words where the buttons begin."""
        super().resizeEvent(event)
        self._fit()
        self._fit_foot()

    def _fit(self) -> None:
        self._words.setMaximumWidth(max(0, self.width() - self._buttons.sizeHint().width()))
