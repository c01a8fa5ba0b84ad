"""Several sources give one value by the declared rule, and never a value that no source has."""

from __future__ import annotations

import re
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.monitor.aggregate import NOBODY, FactRule, SourceValue, aggregate

SENSED = ("single", "any", "all", "k_of_n", "priority")


def _said(text: str) -> list[SourceValue]:
    """``01-``: three sensors, of which the first reads 0, the second 1, the third nothing."""
    return [
        SourceValue(
            name, None if value == "-" else value, "dark" if value == "-" else "", float(index)
        )
        for index, (name, value) in enumerate(zip("ABC", text, strict=False))
    ]


def _word(rule: FactRule, text: str) -> str:
    verdict = aggregate(rule, _said(text))
    assert not (verdict.conflict and verdict.value is not None)
    return "conflict" if verdict.conflict else verdict.value or "unknown"


AGREE = {"11": "1", "10": "conflict", "1-": "1", "-1": "1", "--": "unknown", "01": "conflict"}
TABLES: dict[str, tuple[FactRule, dict[str, str]]] = {
    "single": (FactRule("single"), AGREE),
    "any": (FactRule("any"), AGREE),
    "any, critical": (FactRule("any", critical=True), AGREE),
    "all": (FactRule("all"), {**AGREE, "1-": "unknown", "-1": "unknown", "10-": "conflict"}),
    "priority": (FactRule("priority"), {**AGREE, "10": "1", "01": "0", "-01": "0"}),
    "priority, critical": (FactRule("priority", critical=True), AGREE),
    "2 of 3": (
        FactRule("k_of_n", 2),
        {"111": "1", "110": "1", "11-": "1", "10-": "conflict", "1--": "unknown", "abc": "conflict",
         "---": "unknown", "011": "1"},
    ),
    "2 of 3, critical": (
        FactRule("k_of_n", 2, critical=True),
        {"111": "1", "110": "conflict", "11-": "1", "10-": "conflict", "1--": "unknown"},
    ),
    "1 of 2": (FactRule("k_of_n", 1), {"10": "conflict", "1-": "1", "11": "1"}),
    "3 of 2": (FactRule("k_of_n", 3), {"11": "unknown", "10": "conflict"}),
    "k of 2, no k": (FactRule("k_of_n"), {"11": "1", "1-": "unknown", "10": "conflict"}),
    "human": (FactRule("human"), {"11": "unknown", "1-": "unknown", "10": "unknown"}),
}  # fmt: skip


@pytest.mark.parametrize(
    ("rule", "text", "word"),
    [
        pytest.param(rule, text, word, id=f"{name}: {text}")
        for name, (rule, table) in TABLES.items()
        for text, word in table.items()
    ],
)
def test_the_truth_tables(rule: FactRule, text: str, word: str) -> None:
    assert _word(rule, text) == word


def test_reasons_name_who_says_what() -> None:
    conflict = aggregate(FactRule("all"), _said("10-"))
    assert conflict.reason == "conflict: A says 1, B says 0"
    missing = aggregate(FactRule("all"), _said("1-"))
    assert missing.reason == "not all sensors have a reading (B: dark)"
    few = aggregate(FactRule("k_of_n", 2), _said("1--"))
    assert few.reason == "1 of 3 sensors have a reading, 2 must agree"
    assert aggregate(FactRule("any"), _said("--")).reason == "dark"
    assert aggregate(FactRule("all"), []).reason == "no sensor reads it"


@pytest.mark.parametrize(
    ("rule", "text", "age"),
    [
        (FactRule("any"), "-11", 1.0),
        (FactRule("all"), "111", 2.0),
        (FactRule("k_of_n", 2), "1-1", 2.0),
        (FactRule("k_of_n", 1), "111", 0.0),
        (FactRule("priority"), "-11", 1.0),
        (FactRule("any"), "10", 1.0),
    ],
)
def test_a_value_is_as_old_as_what_it_rests_on(rule: FactRule, text: str, age: float) -> None:
    assert aggregate(rule, _said(text)).age == age


def test_only_a_person_answers_what_is_asked_of_one() -> None:
    rule = FactRule("human")
    assert aggregate(rule, _said("11")).reason == NOBODY
    person = SourceValue("Ada", "0", human=True)
    assert aggregate(rule, [*_said("11"), person]).value == "0"
    for other in SENSED:
        assert aggregate(FactRule(other), [person]).value is None


def test_all_is_unknown_wherever_any_part_is() -> None:
    for text in map("".join, product("01-", repeat=3)):
        known = _word(FactRule("all"), text) in ("0", "1")
        assert known == (text in ("000", "111"))


values = st.sampled_from(["0", "1", "a", None])
rules = st.builds(
    FactRule,
    st.sampled_from(SENSED),
    st.one_of(st.none(), st.integers(1, 4)),
    st.booleans(),
)


def _sources(read: list[str | None]) -> list[SourceValue]:
    return [
        SourceValue(f"s{i}", value, "" if value else "dark", 0.1 * i)
        for i, value in enumerate(read)
    ]


@given(rules, st.lists(values, max_size=5))
def test_unknown_never_becomes_a_value(rule: FactRule, read: list[str | None]) -> None:
    verdict = aggregate(rule, _sources(read))
    assert verdict.value is None or verdict.value in read
    assert bool(verdict.reason) == (verdict.value is None)
    if len(set(read) - {None}) > 1 and rule.critical:
        assert verdict.value is None


@given(st.booleans(), st.lists(values, max_size=5), st.data())
def test_losing_a_reading_never_makes_all_know_more(
    critical: bool, read: list[str | None], data: st.DataObject
) -> None:
    rule = FactRule("all", critical=critical)
    before = aggregate(rule, _sources(read)).value
    for index in range(len(read)):
        after = aggregate(rule, _sources([*read[:index], None, *read[index + 1 :]])).value
        assert after is None
    assert before is None or set(read) == {before}


@given(rules, st.lists(values, min_size=1, max_size=5), st.randoms(use_true_random=False))
def test_who_is_asked_first_matters_by_priority_alone(rule, read, chance) -> None:  # type: ignore[no-untyped-def]
    said = _sources(read)
    mixed = chance.sample(said, len(said))
    if rule.aggregation != "priority" or rule.critical:
        first, second = aggregate(rule, said), aggregate(rule, mixed)
        assert (first.value, first.conflict) == (second.value, second.conflict)


PAGE = Path(__file__).parents[2] / "docs" / "monitoring.md"
COLUMNS = (
    (FactRule("single"), FactRule("any")),
    (FactRule("all"),),
    (FactRule("k_of_n", 2),),
    (FactRule("k_of_n", 2, critical=True),),
    (FactRule("priority"),),
    (FactRule("priority", critical=True),),
    (FactRule("human"),),
)


def test_the_page_says_what_is_so() -> None:
    rows = re.findall(r"^\| `([-ab ]{5})` \|(.*)\|$", PAGE.read_text("utf-8"), re.MULTILINE)
    assert len(rows) == 8
    for read, cells in rows:
        said = [cell.strip() for cell in cells.split("|")]
        for word, column in zip(said, COLUMNS, strict=True):
            for rule in column:
                assert _word(rule, read.replace(" ", "")) == word
