"""The run as one feature: its pane, and the world that waits for the next run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEventLoop, QTimer

from smsl_studio.host.spare import Spare
from smsl_studio.library.loading import Loaded
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Page, Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.run.actions import run_actions
from smsl_studio.studio.features.run.pane import RunPane
from smsl_studio.studio.features.run.spare_world import SpareWorld, Wanted
from smsl_studio.studio.running.run_actions import RunActions
from smsl_studio.studio.running.window_parts import WindowParts

PATIENCE = 3000
"""Milliseconds that a run may take to stand still before its window closes all the same."""


class RunFeature(Feature):
    """Run mode. ``asked`` is what the keys of a run reach."""

    def __init__(self, parts: WindowParts, shell: Shell, spare: Spare | None) -> None:
        session = parts.session
        self._shell = shell
        self.pane = RunPane(session, parts.tokens)
        self.pane.recordings = lambda: parts.settings.wanted_recordings
        self.asked: RunActions = self.pane
        self.shown_elsewhere: Callable[[], bool] = lambda: False
        """Whether a neighbour shows a page in which a run can begin."""
        self.warming = SpareWorld(self._next, parts.window)
        self.keep_warm(spare)
        for changed in (session.blueprint_changed, self.pane.run.exists_changed,
                        self.pane.transport.world.currentIndexChanged,
                        self.pane.transport.seed.textChanged):  # fmt: skip
            changed.connect(lambda *_: self.warming.soon())
        parts.files.asking.connect(self.pane.file_asked)
        self.pages = {"run": Page(self.pane, self.pane.canvas.canvas, self.pane.transport)}

    def actions(self) -> tuple[Action, ...]:
        """The Run menu."""
        return run_actions(self.asked, self._shell.program, self._shell)

    def keep_warm(self, spare: Spare | None) -> None:
        """Have the next run's world stand ready while a mode is shown in which it can begin."""
        self.warming.spare = self.pane.run.spare = spare

    def _next(self) -> Wanted | None:
        shown = self.pane.isVisible() or self.shown_elsewhere()
        return self.pane.next.wanted if shown else None

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """Offer their worlds, once they were looked for."""
        if known:
            self.pane.set_plugins(loaded)

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self.pane.set_tokens(tokens)

    def may_leave(self, ask: Callable[[str], bool]) -> bool:
        """Whether the run may end with the window: there is none, or the person agrees."""
        run = self.pane.run
        if not run.exists or run.blueprint is None or run.choice is None:
            return True
        file = Path(run.blueprint.file).name
        return ask(f"The run of {file} in {run.choice.world} has not ended.")

    def stop(self) -> None:
        """Stop the run, wait until it stands or ``PATIENCE`` is over, and let go of it."""
        run = self.pane.run
        if run.exists and run.phase != "stopped":
            wait = QEventLoop(self.pane)

            def look() -> None:
                """End the wait once the run has stopped."""
                if run.phase == "stopped":
                    wait.quit()

            run.changed.connect(look)
            run.exists_changed.connect(lambda _: wait.quit())
            QTimer.singleShot(PATIENCE, wait, wait.quit)
            run.stop()
            wait.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
        self.pane.shut()
