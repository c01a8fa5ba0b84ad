"""The names of a model of guarded commands, and the findings that all checkers of models share."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.commands import CommandModel
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.identifiers import Identifiers
from smsl_studio.exchange.left_out import told_of_left_out
from smsl_studio.legible import one_line

_HELD = ("SUB_SBS", "_hazards", "_properties")


class ModelNames:
    """Identifiers for SBs (``sb_``), operations (``op_``) and what is forbidden (``never_``)."""

    def __init__(self, model: CommandModel) -> None:
        free = Identifiers()
        self.order = model.numbers.hierarchy.order
        self.branches = [f"sb_{free.of(name)}" for name in self.order]
        actions = Identifiers()
        self._actions: dict[tuple[str, str], str] = {}
        for command in model.commands:
            key = command.edge.branch, command.edge.name
            if key not in self._actions:
                self._actions[key] = f"op_{actions.of('_'.join(key))}"
        claims = Identifiers()
        self.forbidden = [f"never_{claims.of(one.name)}" for one in model.forbidden]

    def action(self, branch: str, operation: str) -> str:
        """Return the identifier of an operation of an SB."""
        return self._actions[branch, operation]

    def table(self, model: CommandModel, at: int) -> Iterator[str]:
        """Yield a line for each state of an SB: its number and its name."""
        for number, state in enumerate(model.numbers.states[at]):
            yield f"{number} {one_line(state)}"


def told_of_models(blueprint: Blueprint, findings: ExchangeFindings, more: str = "") -> None:
    """Add what a model of commands leaves out: all that changes no step. ``more`` is held too."""
    told_of_left_out(blueprint, findings, _HELD, f"what is required and loaded{more}")
