"""The scores of rules that records carry: they are what the seeded faults show."""

from __future__ import annotations

import json
from collections import Counter

from benches.seeded import COUNT, SCORES, found
from smsl_studio.inspection.approval.rule_scores import rule_scores
from smsl_studio.inspection.approval.statement import SignedRule
from smsl_studio.inspection.inspect import RULES

SHARE = 250


def test_a_share_of_the_faults_agrees_with_the_scores() -> None:
    """Which rules find faults at all does not depend on how many are seeded."""
    by_rule: Counter[str] = Counter()
    found(by_rule, SHARE)
    scores = {rule: one.found for rule, one in rule_scores().items()}
    assert set(scores) == set(RULES)
    assert {rule for rule, many in by_rule.items() if many > SHARE // 50} <= {
        rule for rule, many in scores.items() if many
    }
    for rule, many in scores.items():
        assert abs(by_rule[rule] / SHARE - many / COUNT) < 0.12, rule


def test_the_file_says_how_many_faults_were_seeded() -> None:
    told = json.loads(SCORES.read_bytes())
    assert (told["faults"], {one.of for one in rule_scores().values()}) == (COUNT, {COUNT})


def test_a_rule_without_a_score_is_written_as_before() -> None:
    values = {"id": "R01", "version": "1", "code": "0" * 64, "result": "passed"}
    assert SignedRule.model_validate(values).model_dump() == values
    scored = {**values, "score": {"found": 3, "of": 4}}
    assert SignedRule.model_validate(scored).model_dump() == scored
