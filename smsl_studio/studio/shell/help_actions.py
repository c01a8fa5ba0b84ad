"""The Help menu."""

from __future__ import annotations

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Shell


def help_actions(shell: Shell) -> tuple[Action, ...]:
    return (
        Action("shortcuts", "Keyboard shortcuts", shell.show_shortcuts, "Help", "", ("F1",)),
        Action("about", "About SMSL Studio", shell.show_about, "Help"),
    )
