"""What the page shows of a text of rules: the draft, the places of its states, the differences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.rule_differences import RuleComparison, rule_comparison
from smsl_studio.front.rule_draft import RuleDraft, rule_draft
from smsl_studio.graph.layout import Point, place_states


@dataclass(frozen=True)
class RuleAnswer:
    """A draft with the places of its states. ``comparison`` is None if the drawing has no SB of
    this name with a state, or if not all states of the rules are known."""

    text: str
    draft: RuleDraft
    places: Mapping[str, Point] = field(default_factory=dict)
    comparison: RuleComparison | None = None


def rule_answer(text: str, file: str, drawn: Blueprint) -> RuleAnswer:
    """Read the text and follow its rules. This may take seconds, so it is done in a worker."""
    draft = rule_draft(text, file)
    branch = draft.branch
    if branch is None:
        return RuleAnswer(text, draft)
    there = drawn.branches.get(branch.name)
    compared = there is not None and bool(there.table) and draft.whole
    return RuleAnswer(
        text, draft, place_states(branch),
        rule_comparison(branch, there) if compared and there is not None else None,
    )  # fmt: skip
