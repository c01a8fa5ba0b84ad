"""The settings as a feature: one row of the Edit menu, and its dialog."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.settings.dialog import SettingsDialog


class SettingsFeature(Feature):
    """The settings of the program, shown by each of its windows."""

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        self._window, self._shell = parts.window, shell
        self._actions: Actions | None = None

    def actions(self) -> tuple[Action, ...]:
        """The last row of the Edit menu."""
        return (
            Action("settings", "Settings…", self.open, "Edit", "", ("Ctrl+,",), section=3,
                   tip="Theme, size, motion, keys, saving, plugin folders, privacy"),
        )  # fmt: skip

    def take_actions(self, actions: Actions) -> None:
        """Keep the table, whose keys can be changed."""
        self._actions = actions

    def open(self) -> SettingsDialog | None:
        """Show the settings."""
        from smsl_studio.studio.features.settings.dialog import SettingsDialog

        if self._actions is None:
            return None
        dialog = SettingsDialog(self._shell.program, self._actions, self._window)
        dialog.open()
        return dialog
