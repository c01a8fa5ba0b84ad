"""The actions of a run: play, step, pause, stop, fault, script, monitor, plugins."""

from __future__ import annotations

from typing import Protocol

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import AllWindows, Shell
from smsl_studio.studio.running.run_actions import RunActions


class Trials(Protocol):
    """What the actions may ask about the run and about trying things by hand."""

    def may_move(self) -> bool:
        """Whether the run may go on now; a run of another file than the one shown is asked for."""

    def tell_other(self) -> None:
        """Say of which run a pause was, if it is of another file than the one shown."""

    def can_inject(self) -> bool:
        """Whether a fault can be injected now."""

    def inject_fault(self) -> None:
        """Open the dialog for a fault."""

    def choose_supervisors(self) -> None:
        """Open the dialog for automatic supervisors."""

    def can_ask_for_a_way(self) -> bool:
        """Whether the run holds because no way leads to the goal."""

    def ask_for_a_way(self) -> None:
        """Open the dialog for who proposes operations that lead on."""

    def has_script(self) -> bool:
        """Whether something was done by hand in the run that is shown."""

    def save_script(self) -> None:
        """Save what was done by hand as a script."""


def run_actions(
    run: RunActions, trials: Trials, windows: AllWindows, shell: Shell
) -> tuple[Action, ...]:
    """The rows for the Run menu, and the monitor for the View menu."""

    def play() -> None:
        """Show the run and continue it."""
        if trials.may_move():
            watch()
            run.play()

    def pause() -> None:
        """Pause the run."""
        trials.tell_other()
        run.pause()

    def step() -> None:
        """Show the run and carry out one operation."""
        if trials.may_move():
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
               tip="Start the run, or go on with it", once=True),
        Action("run_pause", "Pause", pause, "Run", "pause", ("F6",)),
        Action("run_step", "One operation", step, "Run", "step", ("F10",), can_run,
               once=True),
        Action("monitor", "Monitor", run.show_monitor, "View", "signal", ("Ctrl+M",), section=1,
               tip="Every sensor, fact, node and state check of the run"),
        Action("run_stop", "Stop", windows.stop_every_run, "Run", "stop", ("F8",), section=1,
               tip="A controlled stop, from anywhere"),
        Action("inject_fault", "Inject a fault…", trials.inject_fault, "Run", "warning",
               ("Ctrl+Shift+I",), trials.can_inject, section=3,
               tip="Let something go wrong in the world, now or at a chosen moment"),
        Action("supervisors", "Automatic supervisors…", trials.choose_supervisors, "Run", "shield",
               (), can_run, section=3,
               tip="Who decides on each operation of the next run, and what a forecast does"),
        Action("ask_for_a_way", "Ask for a way…", trials.ask_for_a_way, "", "search", (),
               trials.can_ask_for_a_way, section=3,
               tip="Where no way leads to the goal: who proposes operations of the library"),
        Action("save_script", "Save as script…", trials.save_script, "Run", "save", (),
               trials.has_script, section=3,
               tip="Save what was done by hand in this run, so that it can be done again"),
        Action("reload_plugins", "Look for plugins again", windows.look_for_plugins, "Run", "", (),
               section=4, tip="Read edited and added plugins; a run always has them as they are"),
    )  # fmt: skip
