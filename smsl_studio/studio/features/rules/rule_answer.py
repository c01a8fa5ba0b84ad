"""What the page shows of a text of rules: the draft, the places of its states, the differences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.front.rule_differences import RuleComparison, rule_comparison
from smsl_studio.front.rule_draft import RuleDraft, rule_draft
from smsl_studio.front.rule_preview import RulePreview, rule_preview
from smsl_studio.graph.layout import Point, place_states


@dataclass(frozen=True)
class RuleAnswer:
    """A draft with the places of its states. ``comparison`` is None if the drawing has no SB of
    this name with a state, or if not all states of the rules are known. ``before`` is what the
    text gave before its last change."""

    text: str
    draft: RuleDraft
    places: Mapping[str, Point] = field(default_factory=dict)
    comparison: RuleComparison | None = None
    preview: RulePreview | None = None
    before: StateBranch | None = None


def rule_answer(
    text: str, file: str, drawn: Blueprint, former: RuleAnswer | None = None
) -> RuleAnswer:
    """Read the text and follow its rules. ``former`` is the answer before. This may take seconds,
    so it is done in a worker."""
    draft = rule_draft(text, file)
    branch, before = draft.branch, None
    if former is not None:
        before = former.before if former.text == text else former.draft.branch or former.before
    if branch is None or draft.blueprint is None:
        return RuleAnswer(text, draft, before=before)
    there = drawn.branches.get(branch.name)
    if there is not None and not (there.table and draft.whole):
        there = None
    comparison = None if there is None else rule_comparison(branch, there)
    differences = () if comparison is None else comparison.differences
    preview = rule_preview(draft.blueprint, branch, before, there, differences)
    places = place_states(preview.blueprint[branch.name])
    return RuleAnswer(text, draft, places, comparison, preview, before)
