"""Supervision as one feature: its page, and its rows of the Run menu."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Page, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.supervise.actions import supervise_actions
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.supervise.pane import SupervisePane
    from smsl_studio.studio.running.run_session import RunSession


class SuperviseFeature(Feature):
    """Supervise mode. Its pane is made together with the run that it shows.

    ``run`` answers with the run of the window.
    """

    def __init__(self, parts: WindowParts, shell: Shell, run: Callable[[], RunSession]) -> None:
        self._parts, self._shell, self._run = parts, shell, run
        self._tokens = parts.tokens
        self.part = LatePart(self._make)
        self.pages = {"supervise": self._page}

    @property
    def pane(self) -> SupervisePane:
        """The body of Supervise mode."""
        self._run()
        return self.part()

    def _page(self) -> Page:
        return Page(self.pane, self.pane, self.pane.bar)

    def _make(self) -> SupervisePane:
        from smsl_studio.studio.features.supervise.pane import SupervisePane

        pane = SupervisePane(self._parts.session, self._run(), self._tokens, self._parts.window)
        pane.hide()
        return pane

    def actions(self) -> tuple[Action, ...]:
        """What a supervisor commands."""
        return supervise_actions(self, self._shell)

    # What its actions ask.

    def run_exists(self) -> bool:
        """Whether there is a run."""
        return self.part.made is not None and self.part.made.run_exists()

    def is_located(self) -> bool:
        """Whether a run that was taken over fits one configuration only."""
        return self.part.made is not None and self.part.made.is_located()

    def is_stopped(self) -> bool:
        """Whether the run is stopped."""
        return self.part.made is not None and self.part.made.is_stopped()

    def is_held(self) -> bool:
        """Whether the run is stopped, or holds after a fault or without a route."""
        return self.part.made is not None and self.part.made.is_held()

    def is_mapped(self) -> bool:
        """Whether every state of the SB is shown."""
        return self.part.made is not None and self.part.made.is_mapped()

    def choose_first(self) -> None:
        """Give the keys to the first card."""
        self.pane.choose_first()

    def ask_for(self, word: str) -> None:
        """Ask a person once more for a command, named by its word."""
        self.pane.ask_for(word)

    # What the shell asks of it.

    def is_shown(self) -> bool:
        """Whether its page is in view."""
        return self.part.made is not None and self.part.made.isVisible()

    def refresh(self) -> None:
        """Show the run as it stands, where it is shown."""
        if self.part.made is not None:
            self.part.made.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
