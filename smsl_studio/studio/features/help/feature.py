"""Help as a feature: F1 on what has the focus, and the rows of the menu Help about its pages."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QApplication

from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.help.key import HelpKey
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.help.help_window import HelpWindow
    from smsl_studio.studio.features.help.pages import HelpPlace


class HelpFeature(Feature):
    """The help of one window. ``rule`` returns the rule of the chosen finding; empty for none."""

    def __init__(self, parts: WindowParts, shell: Shell, rule: Callable[[], str]) -> None:
        self._window, self._shell, self._rule = parts.window, shell, rule
        self._tokens = parts.tokens

    def actions(self) -> tuple[Action, ...]:
        """The first rows of the menu Help."""
        return (
            Action("help_here", "Help on this", self.explain_focus, "Help", "info", ("F1",),
                   tip="Explain what has the keyboard focus"),
            Action("help_pages", "Help pages", self.show_first, "Help", "file", (),
                   tip="All pages, with an index and search"),
        )  # fmt: skip

    def take_actions(self, actions: Actions) -> None:
        """Let F1 work in dialogs, too."""
        HelpKey(actions["help_here"], self._window)

    def explain_focus(self) -> None:
        """Show the page and the section about what has the keyboard focus."""
        from smsl_studio.studio.features.help.pages import HelpPlace
        from smsl_studio.studio.features.help.topics import part_with_row, place_about

        focus = QApplication.focusWidget()
        rule = self._rule() if part_with_row(focus) == "Findings" else ""
        of_rule = HelpPlace("inspection.md", "", rule)
        self.show_place(of_rule if rule else place_about(focus, self._shell.mode))

    def show_first(self) -> None:
        """Show the first page, beside the index."""
        from smsl_studio.studio.features.help.pages import FIRST, HelpPlace

        self.show_place(HelpPlace(FIRST))

    def show_place(self, place: HelpPlace) -> None:
        """Show a place of the help.

        A dialog that waits for an answer blocks all windows but its own, so it gets a help window
        of its own.
        """
        from smsl_studio.studio.features.help.help_window import HelpWindow

        owner = QApplication.activeModalWidget() or self._window
        shown = next((one for one in owner.children() if isinstance(one, HelpWindow)), None)
        (shown or HelpWindow(self._tokens, owner)).show_place(place)

    @property
    def windows(self) -> list[HelpWindow]:
        """The help windows that were made."""
        from smsl_studio.studio.features.help.help_window import HelpWindow

        return self._window.findChildren(HelpWindow)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for shown in self.windows:
            shown.set_tokens(tokens)
