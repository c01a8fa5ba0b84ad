"""The rows of supervision in the Run menu. Their keys act in Supervise mode, where the pane answers
them itself: each asks once more before anything happens."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Shell, Supervising


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

    return (
        row("choose_operation", "Choose an operation", pane.choose_first, "", "1 2 3 4 5 6 7 8 9",
            "Choose one of the operations out of the current state"),
        row("veto", "Veto once", pane.ask_veto, "close", "V",
            "Have the operation that is next, or chosen, skipped once"),
        row("prune", "Prune…", pane.ask_prune, "scissors", "P",
            "Shut an operation out until it is restored, with a reason"),
        row("take_over", "Take over, or give back", pane.ask_hand, "hand", "T",
            "Lock the automation out, or have it go on from the state that is located"),
        row("accept", "Accept the located state", pane.accept, "check", "",
            "Go on from the state that was located", pane.is_located),
        row("run_reset", "Reset", pane.ask_reset, "", "", "Unlatch a stop, to paused",
            pane.is_stopped),
        row("run_end", "End run", pane.ask_end, "", "", "Finish a run that is stopped or holds",
            pane.is_held),
        Action("full_map", "Show full map, logged", there(pane.turn_map), "Run", "map", (),
               pane.run_exists, pane.is_mapped, section=2,
               tip="Every state of the State Branch; that it was looked at is recorded"),
    )  # fmt: skip
