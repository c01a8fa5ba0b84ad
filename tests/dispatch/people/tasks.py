"""Helpers for tests of runs with people: who answers what, and what was asked."""

from __future__ import annotations

from typing import Any, Self

from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.people.task import Task
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import Host
from tests.dispatch.runs import Story


class Attended(Story):
    """A run on the table that somebody attends; people answer by the words of the options."""

    def __init__(
        self,
        blueprint: Blueprint,
        host: Host | None = None,
        levels: dict[str, str] | None = None,
        **choices: Any,
    ) -> None:
        choices.setdefault("attended", True)
        on = host if host is not None else LocalHost(blueprint, "table")
        super().__init__(blueprint, on, levels=Levels(blueprint, levels or {}), **choices)

    @property
    def tasks(self) -> tuple[Task, ...]:
        return self.dispatcher.status.tasks

    @property
    def asked(self) -> list[tuple[str, str]]:
        """Kind and address of everything that was ever asked."""
        return [(event.kind, event.address) for event in self.of("task_opened")]

    @property
    def outcomes(self) -> list[tuple[str, str]]:
        return [(event.outcome, event.answer) for event in self.of("task_closed")]

    @property
    def refused(self) -> list[str]:
        """Why commands were refused."""
        return [event.refused for event in self.of("commanded") if event.refused]

    def say(self, option: str, by: str = "Ann", role: str = "", task: str = "") -> Self:
        """Somebody answers the only open task, or the one that is named; then the run goes on."""
        self.dispatcher.answer(task, option, role, by=by)
        self.run()
        return self

    def wait(self, seconds: float) -> Self:
        until = self.dispatcher.time + seconds
        while self.dispatcher.time < until - 1e-6 and not self.dispatcher.finished:
            self.tick()
        return self
