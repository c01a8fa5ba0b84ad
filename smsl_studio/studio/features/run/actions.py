"""The actions of a run: play, step, pause, stop, monitor, plugins."""

from __future__ import annotations

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import AllWindows, Shell
from smsl_studio.studio.running.run_actions import RunActions


def run_actions(run: RunActions, windows: AllWindows, shell: Shell) -> tuple[Action, ...]:
    """The rows for the Run menu, and the monitor for the View menu."""

    def play() -> None:
        """Show the run and continue it."""
        watch()
        run.play()

    def step() -> None:
        """Show the run and carry out one operation."""
        watch()
        run.step()

    def watch() -> None:
        """Switch to Run mode, unless Supervise or Replay mode is shown."""
        if shell.mode not in ("supervise", "replay"):
            shell.set_mode("run")

    def can_run() -> bool:
        """Whether there is something that could run: not while the start page is shown."""
        return shell.mode != "start"

    return (
        Action("run_play", "Run", play, "Run", "play", ("F5",), can_run,
               tip="Start the run, or go on with it"),
        Action("run_pause", "Pause", run.pause, "Run", "pause", ("F6",)),
        Action("run_step", "One operation", step, "Run", "step", ("F10",), can_run),
        Action("monitor", "Monitor", run.show_monitor, "View", "signal", ("Ctrl+M",), section=1,
               tip="Every sensor, fact, node and state check of the run"),
        Action("run_stop", "Stop", windows.stop_every_run, "Run", "stop", ("F8",), section=1,
               tip="A controlled stop, from anywhere"),
        Action("reload_plugins", "Look for plugins again", windows.look_for_plugins, "Run", "", (),
               section=4, tip="Read edited and added plugins; a run always has them as they are"),
    )  # fmt: skip
