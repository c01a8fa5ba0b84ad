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

    def run_exists(self) -> bool: ...
    def is_located(self) -> bool: ...
    def is_stopped(self) -> bool: ...
    def is_held(self) -> bool: ...
    def is_mapped(self) -> bool: ...
    def choose_first(self) -> None: ...
    def ask_for(self, word: str) -> None: ...


def supervise_actions(pane: Supervising, shell: Shell) -> tuple[Action, ...]:
    def there(call: Callable[[], object]) -> Callable[[], None]:
        """Show Supervise, where what is asked can be seen, then ask."""

        def ask() -> None:
            shell.set_mode("supervise")
            call()

        return ask

    def row(name: str, words: str, call: Callable[[], object], icon: str, key: str, tip: str,
            enabled: Callable[[], bool] = pane.run_exists) -> Action:  # fmt: skip
        keys = tuple(key.split())
        return Action(name, words, there(call), "Run", icon, keys, enabled,
                      scope="supervise", section=2, tip=tip)  # fmt: skip

    def command(one: CommandRow) -> Action:
        ask, name = partial(pane.ask_for, one.word), NAMES.get(one.word, one.word)
        if one.word == "full_map":
            return Action(name, one.label, there(ask), "Run", one.icon, (), pane.run_exists,
                          pane.is_mapped, section=2, tip=one.tip)  # fmt: skip
        words = "Take over, or give back" if one.word == "take_over" else one.label
        return row(name, words, ask, one.icon, one.key, one.tip,
                   fitting.get(one.word, pane.run_exists))  # fmt: skip

    fitting = {"accept": pane.is_located, "reset": pane.is_stopped, "end": pane.is_held}
    return (
        row("choose_operation", "Choose an operation", pane.choose_first, "", "1 2 3 4 5 6 7 8 9",
            "Choose one of the operations out of the current state"),
        *(command(one) for one in COMMANDS.values() if one.tip),
    )  # fmt: skip
