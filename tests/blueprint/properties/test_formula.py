"""Formulas: what is read, what it means, and where it cannot be read."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count, product

import pytest
from hypothesis import given

from smsl_studio.blueprint.properties import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    StateTerm,
    meaning_of,
    read_formula,
)
from smsl_studio.blueprint.properties.follow import terms_of
from smsl_studio.blueprint.properties.meaning import Joined, branches_in, holds
from smsl_studio.blueprint.properties.property import Property
from smsl_studio.blueprint.properties.words import property_words
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import FormulaError
from smsl_studio.inspection.proof.contradiction import contradicted
from smsl_studio.inspection.proof.exploration import Exploration
from smsl_studio.inspection.proof.space import Space
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.stop import heeding
from tests.blueprint.properties.drawn import BLUEPRINT, formulas, true_in, written

CONFIGURATIONS = [
    dict(zip(BLUEPRINT.branches, states, strict=True))
    for states in product(*(branch.table for branch in BLUEPRINT))
]


@given(formulas)
def test_what_is_written_is_read_and_means_the_same(formula: Formula) -> None:
    assert read_formula(written(formula)) == formula
    meaning = meaning_of(formula, BLUEPRINT)
    for configuration in CONFIGURATIONS:
        assert holds(meaning, configuration) == true_in(formula, configuration)
    assert set(branches_in(meaning)) <= set(BLUEPRINT.branches)


@given(formulas)
def test_what_contradicts_itself_is_true_in_no_configuration(formula: Formula) -> None:
    met = any(true_in(formula, one) for one in CONFIGURATIONS)
    names = contradicted(meaning_of(formula, BLUEPRINT))
    assert set(names) <= set(BLUEPRINT.branches)
    assert not (names and met)
    if isinstance(formula, AllOf) and all(isinstance(one, TERMS) for one in formula.parts):
        assert bool(names) != met


PARTS = 300


LONG = read_formula(" or ".join(["SB1 in State_aa and SB1/0 = b"] * PARTS))
MEANING = meaning_of(LONG, BLUEPRINT)
assert isinstance(MEANING, Joined)
WORDS = 8 * PARTS


@pytest.mark.parametrize(
    ("look", "often"),
    [
        (lambda: read_formula("not " * WORDS + "SB1/0 = b"), 2 * WORDS),
        (lambda: meaning_of(LONG, BLUEPRINT), 3 * PARTS),
        (lambda: list(branches_in(MEANING)), 3 * PARTS),
        (lambda: list(terms_of(LONG)), 3 * PARTS),
        (lambda: Space(BLUEPRINT).test(MEANING), 3 * PARTS),
        (lambda: Exploration(Space(BLUEPRINT), 10).first(MEANING), 3 * PARTS),
        (lambda: property_words(Property("p", "never", formulas=(LONG,)), BLUEPRINT), 3 * PARTS),
        (lambda: contradicted(MEANING), 2 * PARTS),
    ],
)
def test_a_stop_is_heeded_at_each_part_of_a_long_condition(
    look: Callable[[], object], often: int
) -> None:
    heeded = count()
    with heeding(lambda: next(heeded)):
        look()
    assert next(heeded) >= often


TERMS = (FactTerm, StateTerm)
A, B, C = (FactTerm("SB1", 0, "", value, True) for value in "abc")


@pytest.mark.parametrize(
    ("text", "formula"),
    [
        ("SB1/0=a", A),
        (" SB1 / 0 = 'a' ", A),
        ("0 = a", FactTerm("", 0, "", "a", True)),
        ('"Clamp fixed" != 1', FactTerm("", None, "Clamp fixed", "1", False)),
        ("'0' = a", FactTerm("0", None, "", "a", True)),
        ("SB1 in State_x-y", StateTerm("SB1", "State_x-y")),
        ("'in' in 'or'", StateTerm("in", "or")),
        # 'not' binds most, then 'and', then 'or'.
        (
            "not SB1/0=a and SB1/0=b or SB1/0=c",
            AnyOf((AllOf((Negation(A), B)), C)),
        ),
        ("not not SB1/0=a", A),
        ("SB1/0=a and (SB1/0=b or SB1/0=c)", AllOf((A, AnyOf((B, C))))),
    ],
)
def test_a_text_is_this_formula(text: str, formula: Formula) -> None:
    assert read_formula(text) == formula


@pytest.mark.parametrize(
    ("text", "at", "words"),
    [
        ("", 1, "the text ends"),
        ("SB1/0", 6, "'=' or '!=' is expected"),
        ("SB1", 4, "'=', '!=' or 'in' is expected"),
        ("SB1/0 = ", 8, "a value is expected"),
        ("SB1/x = 1", 5, "a digit of SB1 or a plain name"),
        ("SB1/0 = a b", 11, "'and', 'or' or the end is expected"),
        ("SB1/0 = a AND SB1/0 = b", 11, "'AND' stands there"),
        ("(SB1/0 = a", 11, "')' is expected"),
        ("SB1/0 = 'a", 9, "' is not closed"),
        ('"plain', 1, '" is not closed'),
        ("SB1/0 = {", 9, "'{' can be no part of a name"),
        ("not", 4, "the text ends"),
        ("and SB1/0 = a", 1, "'and' stands there"),
        ("SB1/0 = a and", 14, "the text ends"),
        ("SB1/0 = a -> b", 12, "'>' can be no part of a name"),
        (f"{'(' * 200}SB1/0=a{')' * 200}", 101, "more than 100 deep"),
    ],
)
def test_a_fault_has_its_place_and_an_advice(text: str, at: int, words: str) -> None:
    with pytest.raises(FormulaError) as caught:
        read_formula(text)
    assert caught.value.sentence.startswith(f"character {at}: ")
    assert words in caught.value.sentence
    assert caught.value.at == at - 1
    assert caught.value.advice


@pytest.mark.parametrize(
    ("text", "words", "advice"),
    [
        ("SB2/0 = a", "there is no SB SB2", "Did you mean SB1?"),
        ("0 = a", "the SB of the fact is missing", "Write SB/DIGIT"),
        ("SB1 = a", "SB1 has 2 facts, so a digit is missing", "Write SB1/0"),
        ("SB1/2 = a", "2 is none of its digits", "Digits count from 0."),
        ("SB1/0 = c", "it's on of SB1 never has the value c", "It has a, b."),
        ('SB1/"its on" = a', 'SB1 has no fact named "its on"', "Did you mean it's on?"),
        ("SB1 in State_ac", "SB1 has no state State_ac", "Did you mean State_a"),
    ],
)
def test_a_name_that_does_not_exist_is_told(text: str, words: str, advice: str) -> None:
    formula = read_formula(f"SB1/0 = a or {text}")
    with pytest.raises(FormulaError) as caught:
        meaning_of(formula, BLUEPRINT)
    assert caught.value.at == 13
    assert words in caught.value.sentence
    assert caught.value.advice.startswith(advice)


def test_two_facts_of_one_name_are_told_apart_by_the_digit() -> None:
    text = '{"A": {"State_01": {}, "_facts": {"0": {"name": "x"}, "1": {"name": "x"}}}}'
    blueprint = read_blueprint(parse_json(text, "file.json"))
    with pytest.raises(FormulaError, match='A has 2 facts named "x"'):
        meaning_of(read_formula('"x" = 0'), blueprint)
    assert holds(meaning_of(read_formula("1 = 1"), blueprint), {"A": "State_01"})


def test_a_long_text_is_read_in_one_go() -> None:
    text = " and ".join(["SB1/0 = a", "not SB1/1 = b"] * 20_000)
    formula = read_formula(text)
    assert isinstance(formula, AllOf)
    assert len(formula.parts) == 40_000
    assert holds(meaning_of(formula, BLUEPRINT), {"SB1": "State_aa"})
