"""The rows of supervision in the Run menu. Their keys act in Supervise mode, where the pane answers
them itself: each asks once more before anything happens."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol

from smsl_studio.dispatch.supervision.row import CommandRow
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Shell

NAMES = {"reset": "run_reset", "end": "run_end"}
"""Actions that are not called as their commands are."""


class Supervising(Protocol):
    """What actions ask of Supervise mode."""

    def run_exists(self) -> bool:
        """Whether there is a run."""

    def is_located(self) -> bool:
        """Whether a run that was taken over fits one configuration only."""

    def is_stopped(self) -> bool:
        """Whether the run is stopped."""

    def is_held(self) -> bool:
        """Whether the run is stopped, or holds after a fault or without a route."""

    def is_mapped(self) -> bool:
        """Whether every state of the SB is shown."""

    def choose_first(self) -> None:
        """Give the keys to the first card."""

    def ask_for(self, word: str) -> None:
        """Ask a person once more for a command, named by its word."""


def supervise_actions(pane: Supervising, shell: Shell) -> tuple[Action, ...]:
    """The rows of the Run menu by which a person supervises."""

    def there(call: Callable[[], object]) -> Callable[[], None]:
        """Show Supervise, where what is asked can be seen, then ask."""

        def ask() -> None:
            """Show Supervise, then ask."""
            shell.set_mode("supervise")
            call()

        return ask

    def command(one: CommandRow) -> Action:
        """The row of one command of supervision."""
        ask, name = partial(pane.ask_for, one.word), NAMES.get(one.word, one.word)
        if one.word == "full_map":
            return Action(name, one.label, there(ask), "Run", one.icon, (), pane.run_exists,
                          pane.is_mapped, section=2, tip=one.tip)  # fmt: skip
        words = "Take over, or give back" if one.word == "take_over" else one.label
        enabled = fitting.get(one.word, pane.run_exists)
        return Action(name, words, there(ask), "Run", one.icon, tuple(one.key.split()), enabled,
                      scope="supervise", section=2, tip=one.tip)  # fmt: skip

    fitting = {"accept": pane.is_located, "reset": pane.is_stopped, "end": pane.is_held}
    return (
        Action("choose_operation", "Choose an operation", there(pane.choose_first), "Run", "",
               tuple("123456789"), pane.run_exists, scope="supervise", section=2,
               tip="Choose one of the operations out of the current state"),
        *(command(one) for one in COMMANDS.values() if one.tip),
    )  # fmt: skip
