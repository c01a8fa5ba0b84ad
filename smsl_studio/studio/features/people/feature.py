"""People as one feature: a badge, what they are asked, and their rows of the Run menu."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.people.actions import people_actions
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.people.people import People
    from smsl_studio.studio.running.next_levels import NextLevels
    from smsl_studio.studio.running.run_session import RunSession


class PeopleFeature(Feature):
    """Who works at a window, and what they are asked. It is put together with the run.

    ``run`` answers with the run of the window, and the levels that are set for the next one.
    """

    def __init__(
        self,
        parts: WindowParts,
        shell: Shell,
        run: Callable[[], tuple[RunSession, NextLevels]],
        persons: Persons,
    ) -> None:
        self._parts, self._shell, self._run, self._persons = parts, shell, run, persons
        self._tokens = parts.tokens
        self._actions: Actions | None = None
        self.part = LatePart(self._make)

    @property
    def people(self) -> People:
        """Card, badge, continuum and dialogs."""
        self._run()
        return self.part()

    def _make(self) -> People:
        from smsl_studio.studio.features.people.people import People

        parts, (run, levels) = self._parts, self._run()
        people = People(parts.session, run, levels, self._persons, self._tokens, parts.window)
        people.task_wanted.connect(self.open_task)
        if self._actions is not None:
            people.changed.connect(self._actions.refresh)
        self._shell.add_badge(people.badge)
        return people

    def open_task(self) -> None:
        """Show what people are asked, with the keys on it and no answer chosen."""
        self._shell.set_mode("supervise")
        self.people.card.take_focus()

    def actions(self) -> tuple[Action, ...]:
        """Tasks, levels and persons."""
        return people_actions(self, self.open_task)

    def take_actions(self, actions: Actions) -> None:
        """An open task can be shown, and a closed one cannot."""
        self._actions = actions

    # What its actions ask.

    def has_task(self) -> bool:
        """Whether people are asked something now."""
        return self.part.made is not None and self.part.made.has_task()

    def may_edit_levels(self) -> bool:
        """Whether the levels can be edited now: a run keeps those it began with."""
        return self.part.made is None or self.part.made.may_edit_levels()

    def edit_persons(self) -> None:
        """Open the dialog of the persons."""
        self.people.edit_persons()

    def edit_levels(self) -> None:
        """Open the dialog of the levels."""
        self.people.edit_levels()

    # What the shell asks of it.

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
