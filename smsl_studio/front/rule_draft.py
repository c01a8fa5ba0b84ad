"""A text of rules while somebody writes it: what it gives so far, and what cannot be read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import ReadError, StudioError
from smsl_studio.front.generated import ruled_blueprint
from smsl_studio.generate.rule_file import RuleSet, read_rules
from smsl_studio.generate.rule_states import left_out, ruled_branch

MOST_SHOWN = 10_000
"""The largest number of states that are looked for while somebody writes."""
MOST_COMBINATIONS = 100_000
"""With more combinations of values than these, nobody counts which of them ``never`` leaves out."""


@dataclass(frozen=True)
class RuleDraft:
    """What a text of rules gives.

    ``faults`` are the errors of the rules and conditions that are left out. If the text cannot be
    read at all, ``blueprint`` is None and ``faults`` has the reason. ``whole`` is false if there
    are more than ``MOST_SHOWN`` states. ``combinations`` has, for each condition of ``never``, how
    many combinations of values it leaves out; it is None if nobody counts them.
    """

    faults: tuple[StudioError, ...]
    rules: RuleSet | None = None
    blueprint: Blueprint | None = None
    states: int = 0
    operations: int = 0
    goal_reached: bool = True
    whole: bool = True
    combinations: tuple[int, ...] | None = None

    @property
    def branch(self) -> StateBranch | None:
        """The SB that the rules make."""
        if self.rules is None or self.blueprint is None:
            return None
        return self.blueprint[self.rules.branch]


def rule_draft(text: str, file: str) -> RuleDraft:
    """Return what a text of rules gives. Its faults are part of the answer and are not raised."""
    raw = text.encode("utf-8", "surrogatepass")
    faults: list[ReadError] = []
    try:
        rules = read_rules(raw, file, faults)
        made = ruled_branch(rules, MOST_SHOWN)
        name = f"{Path(file).name.partition('.')[0] or 'rules'}.json"
        blueprint = ruled_blueprint(made, raw, file, name)
        counted = left_out(rules, MOST_COMBINATIONS)
    except StudioError as error:
        return RuleDraft((*faults, error))
    return RuleDraft(
        tuple(faults), rules, blueprint, made.states, made.operations, made.goal_reached,
        made.whole, counted,
    )  # fmt: skip
