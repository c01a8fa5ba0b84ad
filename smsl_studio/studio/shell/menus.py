"""The rows of all actions: those of each feature, and those of the shell."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Shell


def all_actions(features: Iterable[Feature], shell: Shell) -> tuple[Action, ...]:
    """All rows, in the order of the features."""
    rows = [action for feature in features for action in feature.actions()]
    return (*rows, *help_actions(shell))


def help_actions(shell: Shell) -> tuple[Action, ...]:
    """The rows of the Help menu."""
    return (
        Action("shortcuts", "Keyboard shortcuts", shell.show_shortcuts, "Help", "",
               ("Shift+F1",), section=1),
        Action("failure", "Report of the last failure…", shell.show_failure, "Help", "", (),
               shell.has_failure, section=1,
               tip="Read what failed in this program, and keep it if you want"),
        Action("about", "About SMSL Studio", shell.show_about, "Help", section=1),
    )  # fmt: skip
