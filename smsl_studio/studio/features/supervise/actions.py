"""The actions of supervision in the Run menu.

The pane answers their keys itself, only in Supervise mode. Each asks for confirmation first.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol

from smsl_studio.dispatch.supervision.row import CommandRow
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Shell

NAMES = {"reset": "run_reset", "end": "run_end"}
"""The ids of actions that differ from the words of their commands."""


class Supervising(Protocol):
    """What these actions need of Supervise mode."""

    def run_exists(self) -> bool:
        """Whether there is a run."""

    def is_located(self) -> bool:
        """Whether the facts of a run that was taken over fit exactly one configuration."""

    def is_stopped(self) -> bool:
        """Whether the run is stopped."""

    def is_mapped(self) -> bool:
        """Whether the full map of the SB is shown."""

    def is_large(self) -> bool:
        """Whether the large layout is shown."""

    def turn_large(self) -> None:
        """Show the large layout, or the usual one again."""

    def choose_first(self) -> None:
        """Give the keyboard focus to the first card."""

    def ask_for(self, word: str) -> None:
        """Ask the person to confirm the command with this word."""


def supervise_actions(pane: Supervising, shell: Shell) -> tuple[Action, ...]:
    """The rows of supervision in the Run menu."""

    def there(call: Callable[[], object]) -> Callable[[], None]:
        """The call, with Supervise mode shown first, so that its question is visible."""

        def ask() -> None:
            """Show Supervise mode, then make the call."""
            shell.set_mode("supervise")
            call()

        return ask

    def command(one: CommandRow) -> Action:
        """The action of one command."""
        ask, name = partial(pane.ask_for, one.word), NAMES.get(one.word, one.word)
        if one.word == "full_map":
            return Action(name, one.label, there(ask), "Run", one.icon, (), pane.run_exists,
                          pane.is_mapped, section=2, tip=one.tip)  # fmt: skip
        words = "Take over, or give back" if one.word == "take_over" else one.label
        enabled = fitting.get(one.word, pane.run_exists)
        return Action(name, words, there(ask), "Run", one.icon, tuple(one.key.split()), enabled,
                      scope="supervise", section=2, tip=one.tip)  # fmt: skip

    fitting = {"accept": pane.is_located, "reset": pane.is_stopped, "end": pane.run_exists}
    return (
        Action("choose_operation", "Choose an operation", there(pane.choose_first), "Run", "",
               tuple("123456789"), pane.run_exists, scope="supervise", section=2,
               tip="Choose one of the operations out of the current state"),
        Action("large_supervise", "Supervise, large", there(pane.turn_large), "View", "", ("W",),
               checked=pane.is_large, scope="supervise", section=3,
               tip="Few words in large letters, read from two metres", also="big wall screen"),
        *(command(one) for one in COMMANDS.values() if one.tip),
    )  # fmt: skip
