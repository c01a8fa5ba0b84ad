"""People as one feature: a badge, what they are asked, and their rows of the Run menu."""

from __future__ import annotations

from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.people.actions import people_actions
from smsl_studio.studio.features.people.people import People
from smsl_studio.studio.running.next_levels import NextLevels
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.window_parts import WindowParts


class PeopleFeature(Feature):
    """Who works at a window, and what they are asked."""

    def __init__(
        self,
        parts: WindowParts,
        shell: Shell,
        run: RunSession,
        levels: NextLevels,
        persons: Persons,
    ) -> None:
        self._shell = shell
        self.people = People(parts.session, run, levels, persons, parts.tokens, parts.window)
        self.people.task_wanted.connect(self.open_task)
        self.badges = (self.people.badge,)

    def open_task(self) -> None:
        """Show what people are asked, with the keys on it and no answer chosen."""
        self._shell.set_mode("supervise")
        self.people.card.take_focus()

    def actions(self) -> tuple[Action, ...]:
        """Tasks, levels and persons."""
        return people_actions(self.people, self.open_task)

    def take_actions(self, actions: Actions) -> None:
        """An open task can be shown, and a closed one cannot."""
        self.people.changed.connect(actions.refresh)

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self.people.set_tokens(tokens)
