"""The actions about recorded runs in the File, View and Run menus."""

from __future__ import annotations

from typing import Protocol

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import AllWindows, Shell


class ReplayActions(Protocol):
    """What these actions need of the feature."""

    @property
    def is_open(self) -> bool:
        """Whether a recording is open."""

    def open(self) -> None:
        """Ask for a recording and show it."""

    def turn(self) -> None:
        """Pause if it plays, else play."""

    def pause(self) -> None:
        """Pause at the present moment."""

    def step(self, events: int = 1) -> None:
        """Go so many events forward, or back if negative."""


def replay_actions(replay: ReplayActions, windows: AllWindows, shell: Shell) -> tuple[Action, ...]:
    """The rows of the File, View and Run menus that concern recorded runs."""
    settings = windows.settings

    def shown() -> bool:
        """Whether Replay mode is shown."""
        return shell.mode == "replay"

    def record() -> None:
        """Switch recording of runs on or off."""
        settings.record_runs = not settings.record_runs

    return (
        Action("open_recording", "Open recording…", replay.open, "File", "clock", section=1,
               tip="Show a recorded run again, moment by moment", also="replay log"),
        Action("mode_replay", "Replay", lambda: shell.set_mode("replay"), "View",
               enabled=lambda: replay.is_open, checked=shown, short="Replay",
               tip="Show the recorded run that is open"),
        Action("replay_back", "One event back", lambda: replay.step(-1), "Run", "step-back",
               ("Shift+F10",), shown, section=3, tip="Of a replay: one event back"),
        Action("record_runs", "Record runs", record, "Run", checked=lambda: settings.record_runs,
               section=3, tip="Write every run to a log, so that it can be shown and verified"),
    )  # fmt: skip
