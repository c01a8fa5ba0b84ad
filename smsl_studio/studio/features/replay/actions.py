"""What of the File and Run menus concerns recorded runs."""

from __future__ import annotations

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import AllWindows, Shell
from smsl_studio.studio.features.replay.playback import ReplayVerbs


def replay_actions(replaying: ReplayVerbs, windows: AllWindows, shell: Shell) -> tuple[Action, ...]:
    """The rows of the File, View and Run menus that concern recorded runs."""
    replay, settings = replaying.replay, windows.settings

    def shown() -> bool:
        """Whether Replay mode is shown."""
        return shell.mode == "replay"

    def record() -> None:
        """Switch whether runs are recorded."""
        settings.record_runs = not settings.record_runs

    return (
        Action("open_recording", "Open recording…", replaying.open, "File", "clock", section=1,
               tip="Show a recorded run again, moment by moment"),
        Action("mode_replay", "Replay", lambda: shell.set_mode("replay"), "View",
               enabled=lambda: replaying.is_open, checked=shown, short="Replay",
               tip="Show the recorded run that is open"),
        Action("replay_back", "One event back", lambda: replay.step(-1), "Run", "step-back",
               ("Shift+F10",), shown, section=3, tip="Of a replay: one event back"),
        Action("record_runs", "Record runs", record, "Run", checked=lambda: settings.record_runs,
               section=3, tip="Write every run to a log, so that it can be shown and verified"),
    )  # fmt: skip
