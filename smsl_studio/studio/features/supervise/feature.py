"""Supervision as one feature: its page, and its rows of the Run menu."""

from __future__ import annotations

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Page, Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.supervise.actions import supervise_actions
from smsl_studio.studio.features.supervise.pane import SupervisePane
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.window_parts import WindowParts


class SuperviseFeature(Feature):
    """Supervise mode."""

    def __init__(self, parts: WindowParts, shell: Shell, run: RunSession) -> None:
        self._shell = shell
        self.pane = SupervisePane(parts.session, run, parts.tokens)
        self.pages = {"supervise": Page(self.pane, self.pane, self.pane.bar)}

    def actions(self) -> tuple[Action, ...]:
        """What a supervisor commands."""
        return supervise_actions(self.pane, self._shell)

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self.pane.set_tokens(tokens)
