"""Random formulas, their text, and a second way to tell whether they hold."""

from __future__ import annotations

import re
from collections.abc import Mapping

from hypothesis import strategies as st

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    StateTerm,
)
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json

TEXT = """{
"SB1": {"HEADER": {"NUM_FACTS": 2}, "State_aa": {"Op": "State_ab"}, "State_ab": {}, "State_bb": {},
  "_facts": {"0": {"name": "it's on"}, "1": {"name": "the \\"plain\\" one"}}},
"not": {"State_0": {"Up": "State_1"}, "State_1": {}},
"two words": {"State_in": {}, "State_or": {}}
}"""
BLUEPRINT: Blueprint = read_blueprint(parse_json(TEXT, "file.json"))

_FACTS: tuple[tuple[str, int | None, str, str], ...] = (
    ("SB1", 0, "", "ab"),
    ("SB1", None, "it's on", "ab"),
    ("SB1", None, 'the "plain" one', "ab"),
    ("not", None, "", "01"),
    ("not", 0, "", "01"),
    ("two words", 0, "", "io"),
)
_facts = st.sampled_from(
    [
        FactTerm(branch, digit, plain, value, True)
        for branch, digit, plain, values in _FACTS
        for value in values
    ]
)
_terms = st.one_of(
    st.builds(lambda t, e: FactTerm(t.branch, t.digit, t.name, t.value, e), _facts, st.booleans()),
    st.sampled_from(
        [StateTerm(branch.name, state) for branch in BLUEPRINT for state in branch.table]
    ),
)


def _joined(parts: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
    some = st.lists(parts, min_size=2, max_size=3).map(tuple)
    return st.one_of(
        parts.filter(lambda part: not isinstance(part, Negation)).map(Negation),
        some.filter(lambda all_of: not any(isinstance(p, AllOf) for p in all_of)).map(AllOf),
        some.filter(lambda any_of: not any(isinstance(p, AnyOf) for p in any_of)).map(AnyOf),
    )


formulas: st.SearchStrategy[Formula] = st.recursive(_terms, _joined, max_leaves=12)


def name(text: str) -> str:
    """A name as it is written: bare if it can be."""
    if re.fullmatch(r"[A-Za-z0-9_-]+", text) and text not in ("and", "or", "not", "in"):
        return text
    return "'" + text.replace("'", "''") + "'"


def written(formula: Formula) -> str:
    """The text of a formula, in brackets wherever they might be needed."""
    if isinstance(formula, Negation):
        return f"not ({written(formula.part)})"
    if isinstance(formula, AllOf | AnyOf):
        word = " and " if isinstance(formula, AllOf) else " or "
        return word.join(f"({written(part)})" for part in formula.parts)
    if isinstance(formula, StateTerm):
        return f"{name(formula.branch)} in {name(formula.state)}"
    fact = name(formula.branch)
    if formula.name:
        fact += '/"' + formula.name.replace('"', '""') + '"'
    elif formula.digit is not None:
        fact += f"/{formula.digit}"
    return f"{fact} {'=' if formula.equal else '!='} {name(formula.value)}"


def true_in(formula: Formula, configuration: Mapping[str, str]) -> bool:
    """Whether a formula holds, told from the names of the states alone."""
    if isinstance(formula, Negation):
        return not true_in(formula.part, configuration)
    if isinstance(formula, AllOf):
        return all(true_in(part, configuration) for part in formula.parts)
    if isinstance(formula, AnyOf):
        return any(true_in(part, configuration) for part in formula.parts)
    state = configuration[formula.branch]
    if isinstance(formula, StateTerm):
        return state == formula.state
    at = {"it's on": 0, 'the "plain" one': 1}.get(formula.name, formula.digit or 0)
    return (state.removeprefix("State_")[at] == formula.value) == formula.equal
