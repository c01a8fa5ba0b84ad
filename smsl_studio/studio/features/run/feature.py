"""The run as a feature: its pane, and a world kept ready for the next run."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QWidget

from smsl_studio.front.views.phase_words import outcome_words, phase_words
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Control, Feature, Page, Shell, whole
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.run_keys import lend_run_keys
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.run.actions import run_actions
from smsl_studio.studio.features.run.page_rows import PageRows
from smsl_studio.studio.features.run.run_pages import HOME, RunPages
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.running.run_actions import RunActions
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.host.spare import Spare
    from smsl_studio.library.loaded import Loaded
    from smsl_studio.studio.features.run.fault_dialog import FaultDialog
    from smsl_studio.studio.features.run.pane import RunPane
    from smsl_studio.studio.features.run.picture_file import ClipSaver
    from smsl_studio.studio.features.run.spare_world import SpareWorld, Wanted

PATIENCE = 3000
"""Milliseconds that a closing window waits for its run to stop."""
OWN = ("run", "supervise", "replay")
"""The modes whose title names the run that the keys act on."""
REST = ("paused", "ready", "fault_hold", "no_route")
"""The run states from which a key lets something move."""


class RunFeature(Feature):
    """Run mode. ``asked`` gets the actions of a run.

    The pane is made when somebody runs something or shows the mode for the first time. Before that
    there is no run.
    """

    def __init__(
        self, parts: WindowParts, shell: Shell, spare: Spare | None, persons: Persons
    ) -> None:
        self._parts, self._shell, self._spare = parts, shell, spare
        self._persons = persons
        self._tokens = parts.tokens
        self._loaded: Loaded | None = None
        self.asked: RunActions = self
        self.shown_elsewhere: Callable[[], bool] = lambda: False
        """Tells whether another feature shows a page in which a run can begin."""
        self.faults: FaultDialog | None = None
        """The dialog for a fault, after it was opened for the first time."""
        self.clips: ClipSaver | None = None
        """What saves clips of runs, after the first one was asked for."""
        self.part = LatePart(self._make)
        self.pages = {"run": self._page}
        self.body: RunPages | None = None
        """The pages of the mode, after it was shown for the first time."""
        self._cautious: tuple[object, tuple[str, ...]] = (None, ())
        self.further: dict[str, Callable[[], QWidget]] = {}
        """What makes further pages, by the name on the tab."""
        self.rows: dict[str, Callable[[], QWidget]] = {}
        """What makes the rows in the mode bar of pages that have their own, by the name."""

    @property
    def pane(self) -> RunPane:
        """The body of Run mode."""
        return self.part()

    @property
    def warming(self) -> SpareWorld:
        """The object that keeps the world of the next run ready."""
        self.part()
        return self._warming

    def _page(self) -> Page:
        pane = self.pane
        pages = self.body = RunPages(pane, pane.canvas.canvas)
        self._offer_pages()
        rows = PageRows(pane.transport, self.rows)
        pages.bar.currentChanged.connect(lambda *_: rows.show_page(pages.shown))
        return Page(pages, pages, rows)

    def _offer_pages(self) -> None:
        """Offer the further pages, each made when it is first shown."""
        if self.body is not None:
            for name, make in self.further.items():
                self.body.offer(name, make)

    def show_page(self, name: str) -> None:
        """Show a page of Run, and give it the keys."""
        self._shell.set_mode("run")
        assert self.body is not None
        self.body.show_page(name)
        self.body.setFocus()

    def toggle_page(self, name: str) -> None:
        """Show a page of Run; if it is shown already, the run itself."""
        shown = self._shell.mode == "run" and self.body is not None and self.body.shown == name
        self.show_page(HOME if shown else name)

    def _make(self) -> RunPane:
        from smsl_studio.studio.features.run.kept_edges import offer_to_keep
        from smsl_studio.studio.features.run.pane import RunPane
        from smsl_studio.studio.features.run.spare_world import SpareWorld

        session, files, window = self._parts.session, self._parts.files, self._parts.window
        pane = RunPane(session, self._tokens, window)
        pane.hide()
        pane.canvas.canvas.collapse.join(self._parts.collapse)
        pane.scene.fault_wanted.connect(self.inject_fault)
        pane.scene.script_wanted.connect(self.save_script)
        pane.scene.picture_wanted.connect(self._save_picture)
        pane.scene.clip_wanted.connect(self._save_clip)
        pane.run.caution = pane.canvas.caution = self._caution
        # The persons outlive the window, so that a method is connected that ends with it.
        self._persons.changed.connect(pane.canvas.refresh)
        for changed in (
            pane.levels.changed,
            pane.transport.world.currentIndexChanged,
            pane.transport.offered,
        ):
            changed.connect(lambda *_: pane.canvas.refresh())
        pane.recordings = lambda: self._parts.settings.wanted_recordings
        warming = self._warming = SpareWorld(self._next, window)
        warming.spare = pane.run.spare = self._spare
        for changed in (session.blueprint_changed, pane.run.exists_changed,
                        pane.transport.world.currentIndexChanged,
                        pane.transport.seed.textChanged):  # fmt: skip
            changed.connect(lambda *_: warming.soon())
        files.asking.connect(pane.file_asked)
        pane.run.exists_changed.connect(self._tell_end)
        pane.run.exists_changed.connect(partial(offer_to_keep, pane.run, self._parts))
        pane.run.way_wanted.connect(self.ask_for_a_way)
        if self._loaded is not None:
            pane.set_plugins(self._loaded)
        return pane

    def _caution(self) -> tuple[str, ...]:
        """Return what the next run cannot give although its levels ask for it."""
        from smsl_studio.front.twin import may_be_tried
        from smsl_studio.front.views.before_run import RunMeans, lacking

        pane = self.pane
        if pane.next.loaded is not None:
            pane.next.offer()
        wanted = pane.next.wanted
        if wanted is None:
            return ()
        blueprint, world, _, loaded, _ = wanted
        roles = tuple(one.role for one in self._persons.all)
        forecast = pane.next.supervisors.forecast
        means = RunMeans(world, may_be_tried(world, loaded), roles, forecast)
        asked = id(blueprint), means, tuple(pane.levels.set.items())
        if asked != self._cautious[0]:
            # The banner asks at each step of a run, and a large blueprint has many edges.
            self._cautious = asked, lacking(blueprint, pane.levels.levels(blueprint), means)
        return self._cautious[1]

    def actions(self) -> tuple[Action, ...]:
        """The rows about a run."""
        return run_actions(self.asked, self, self._shell.program, self._shell)

    # What the actions of a run ask for.

    def play(self) -> None:
        """Start a run, or continue the present one. A stopped one asks on its own page."""
        if self.body is not None and self.pane.run.phase == "stopped":
            self.body.show_page(HOME)
        self.pane.play()

    def play_step(self, starts: tuple[str, ...], goal: str) -> str:
        """Start a run from these states to a goal, in the chosen world (addresses).

        Returns why it does not begin; empty if it does.
        """
        pane = self.pane
        held = pane.run.blueprint
        if pane.run.exists and held is not None:
            file = Path(held.file).name
            return f"There is a run of {file} already. End it first: End run in the menu Run."
        if pane.next.loaded is None:
            return "The plugins are being loaded. Ask again in a moment."
        pane.next.step = starts, goal
        pane.play()
        pane.next.step = None
        return "" if pane.run.exists else "It cannot be played now. Run says why."

    @property
    def _other(self) -> str:
        """The file of a run that exists, if the shown page is about another file; else empty."""
        pane = self.part.made
        elsewhere = pane is not None and pane.run.exists and self._shell.mode not in OWN
        return pane.other if pane is not None and elsewhere else ""

    def may_move(self) -> bool:
        """Whether the run may go on now.

        The person is asked if it is of another file than the one that is shown, because then the
        key was probably meant for that one.
        """
        other = self._other
        if not other:
            return True
        run = self.pane.run
        if run.phase not in REST and not run.pausing:
            return True
        agreed = Dialogs(self._parts.window).may_go_on(other, self._parts.files.name)
        # While it was asked the run may have ended, and then a key would begin another one.
        return agreed and run.exists

    def tell_other(self) -> None:
        """Say of which run a pause was, if it is of another file than the one shown."""
        if self._other:
            self._parts.toast.say(f"The run of {self._other} is told to pause")

    def pause(self) -> None:
        """Pause the run."""
        if self.part.made is not None:
            self.part.made.pause()

    def step(self) -> None:
        """Carry out one operation, then pause; without a run, begin one."""
        self.pane.step()

    def show_monitor(self) -> None:
        """Show the monitor page."""
        self.pane.show_monitor()

    def can_inject(self) -> bool:
        """Whether there is a run, so that a fault can be injected."""
        return self.part.made is not None and self.part.made.run.exists

    def inject_fault(self) -> None:
        """Open the dialog for a fault, or bring it to the front."""
        from smsl_studio.studio.features.run.fault_dialog import FaultDialog

        if self.faults is None:
            self.faults = FaultDialog(self.pane.run, self._parts.window)
            lend_run_keys(self.faults, self._parts.window)
        self.faults.hold.begin()
        self.faults.show()
        self.faults.raise_()
        self.faults.activateWindow()

    def choose_supervisors(self) -> None:
        """Ask for the automatic supervisors of the next run."""
        from smsl_studio.studio.features.run.supervisors_dialog import choose_supervisors

        choose_supervisors(self.pane.next, self._parts.window)

    def can_ask_for_a_way(self) -> bool:
        """Whether the run holds because no way leads to the goal."""
        return self.part.made is not None and self.part.made.run.lacks_way

    def ask_for_a_way(self) -> None:
        """Ask who proposes operations that lead on."""
        from smsl_studio.studio.features.run.way_dialog import ask_for_a_way

        ask_for_a_way(self.pane.run, self._parts.window)

    def has_script(self) -> bool:
        """Whether something was done by hand in the run that is shown."""
        return self.part.made is not None and bool(self.part.made.run.lines)

    def save_script(self) -> None:
        """Save what was done by hand as a script."""
        from smsl_studio.studio.features.run.script_file import save_script

        save_script(self.pane.run, self._folder, self._parts.toast, self._parts.window)

    @property
    def _folder(self) -> Path:
        path = self._parts.files.path
        return path.parent if path is not None else Path.home()

    def _picture_name(self) -> Path:
        blueprint = self.pane.run.blueprint
        return self._folder / (Path(blueprint.file).stem if blueprint is not None else "world")

    def _save_picture(self) -> None:
        from smsl_studio.studio.features.run.picture_file import save_picture

        parts, name = self._parts, self._picture_name()
        save_picture(self.pane.scene.view, name, parts.toast, parts.window)

    def _save_clip(self) -> None:
        from smsl_studio.studio.features.run.picture_file import ClipSaver

        scene, parts = self.pane.scene, self._parts
        if self.clips is None:
            self.clips = ClipSaver(scene.view, parts.toast, parts.window)
        self.clips.save(scene.kept, self._picture_name())

    def _tell_end(self, exists: bool) -> None:
        """Say how a run has ended, where the shown page does not."""
        run, shown = self.pane.run, self._shell.mode in ("run", "supervise")
        if shown or exists or not run.over or run.blueprint is None:
            return
        said = f"The run of {Path(run.blueprint.file).name} has ended: {outcome_words(run.phase)}."
        self._parts.toast.tell(
            f"{said} {capital(run.sentence)}".strip(),
            "Show the run",
            lambda: self._shell.set_mode("run"),
            "" if phase_words(run.phase)[1] == "good" else "W",
        )

    # What the shell needs.

    def control(self, name: str) -> Control | None:
        """The buttons of the run's row, and the world."""
        pane = self.part.made
        if pane is None:
            return None
        row = pane.transport
        own = {"run_play": row.play, "run_stop": row.stop, "world": pane.world,
               "run_canvas": pane.canvas, "possible": pane.possible}  # fmt: skip
        return whole(own[name]) if name in own else None

    def mode_shown(self) -> None:
        """Prepare a world, because a run may begin in the mode that is shown now."""
        if self.part.made is not None:
            self.warming.soon()

    def keep_warm(self, spare: Spare | None) -> None:
        """Use this spare process for the worlds of the next runs; None keeps none ready."""
        self._spare = spare
        if self.part.made is not None:
            self.warming.spare = self.part.made.run.spare = spare

    def _next(self) -> Wanted | None:
        shown = self.pane.isVisible() or self.shown_elsewhere()
        return self.pane.next.wanted if shown else None

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """Offer the worlds of the plugins, once these were searched for."""
        if known:
            self._loaded = loaded
            if self.part.made is not None:
                self.part.made.set_plugins(loaded)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    @property
    def moves(self) -> bool:
        """Whether something moves in the run, or may begin to move by itself."""
        run = self.part.made.run if self.part.made is not None else None
        return run is not None and run.exists and run.phase in ("opening", "running", "waiting")

    def stop_run(self) -> None:
        """Stop the run under control, if there is one."""
        if self.part.made is not None:
            self.part.made.stop()

    def may_leave(self, ask: Callable[[str], bool]) -> bool:
        """Whether the window may close: there is no run, or the person agrees to end it."""
        run = self.part.made.run if self.part.made is not None else None
        if run is None or not run.exists or run.blueprint is None or run.choice is None:
            return True
        file = Path(run.blueprint.file).name
        return ask(f"The run of {file} in {run.choice.world} has not ended.")

    def stop(self) -> None:
        """Stop the run, wait until it has stopped or ``PATIENCE`` is over, and release it."""
        pane = self.part.made
        if pane is None:
            return
        if self.faults is not None:
            self.faults.leave()
        if self.clips is not None:
            self.clips.stop()
        run = pane.run
        if run.exists and run.phase != "stopped":
            wait = QEventLoop(pane)

            def look() -> None:
                """End the wait when the run has stopped."""
                if run.phase == "stopped":
                    wait.quit()

            run.changed.connect(look)
            run.exists_changed.connect(lambda _: wait.quit())
            QTimer.singleShot(PATIENCE, wait, wait.quit)
            run.stop()
            wait.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
        pane.shut()
