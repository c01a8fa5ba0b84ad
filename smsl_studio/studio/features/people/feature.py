"""People as a feature: badge, task card, continuum, dialogs, and rows of the Run menu."""

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
    """The people at a window and their tasks. Its parts are made together with the run.

    ``run`` returns the run of the window and the levels for the next one.
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
        """The card, the badge, the continuum and the dialogs."""
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
        """Show the open task with the keyboard focus and no answer selected."""
        self._shell.set_mode("supervise")
        self.people.card.take_focus()

    def actions(self) -> tuple[Action, ...]:
        """The rows for the open task, the levels and the persons."""
        return people_actions(self, self.open_task)

    def take_actions(self, actions: Actions) -> None:
        """Keep the table, which is refreshed when a task opens or ends."""
        self._actions = actions

    # What its actions need.

    def has_task(self) -> bool:
        """Whether a task is open for people."""
        return self.part.made is not None and self.part.made.has_task()

    def may_edit_levels(self) -> bool:
        """Whether the levels can be edited now. A run keeps those it began with."""
        return self.part.made is None or self.part.made.may_edit_levels()

    def edit_persons(self) -> None:
        """Open the dialog for persons."""
        self.people.edit_persons()

    def edit_levels(self) -> None:
        """Open the dialog for levels."""
        self.people.edit_levels()

    # What the shell needs.

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
