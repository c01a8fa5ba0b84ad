"""The actions about people in the Run menu: open task, levels, persons."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from smsl_studio.studio.base.actions import Action


class PeopleActions(Protocol):
    """What these actions need of the feature."""

    def has_task(self) -> bool:
        """Whether a task is open for people."""

    def may_edit_levels(self) -> bool:
        """Whether the levels can be edited now."""

    def edit_persons(self) -> None:
        """Open the dialog for persons."""

    def edit_levels(self) -> None:
        """Open the dialog for levels."""


def people_actions(people: PeopleActions, open_task: Callable[[], object]) -> tuple[Action, ...]:
    """The rows about people in the Run menu."""
    return (
        Action("open_task", "Show the open task", open_task, "Run", "hand", ("F4",),
               people.has_task, section=3, tip="Show in Supervise what people are asked"),
        Action("levels", "Edit levels…", people.edit_levels, "Run", "shared", (),
               people.may_edit_levels, section=3,
               tip="Who does, senses, inspects and supervises, before a run"),
        Action("persons", "Persons…", people.edit_persons, "Run", "person", (), section=3,
               tip="Who works at this window; the record of a run has their names"),
    )  # fmt: skip
