"""No rule crashes on a broken blueprint, and every quick fix either helps or says why it cannot."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused, ReadError
from smsl_studio.graph.hierarchy import cycles, levels
from smsl_studio.graph.layout import place_states
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of

SAMPLES = Path(__file__).parents[2] / "samples"
TEXTS = {
    name: (SAMPLES / name).read_text("utf-8")
    for name in ("hfsm.json", "registration.json", "hanoi-2.json")
}
ODD_NAMES = st.sampled_from(["State_0", "State", "Idle", "SB1", "SB2", "REGISTRATION", "a/b~", "Ä"])
ODD_HEADERS = st.fixed_dictionaries(
    {},
    optional={
        "INITIAL": ODD_NAMES,
        "ACTIVATING": ODD_NAMES,
        "NUM_FACTS": st.integers(-1, 5),
        "NUM_STATES": st.integers(0, 9),
        "SUB_SBS": st.one_of(
            st.dictionaries(ODD_NAMES, st.integers(-2, 5), max_size=3),
            st.lists(st.dictionaries(ODD_NAMES, st.integers(-2, 5), max_size=2), max_size=3),
        ),
        "Initial": ODD_NAMES,
    },
)
ODD_NOTES = st.one_of(
    st.none(),
    st.dictionaries(
        st.one_of(ODD_NAMES, st.sampled_from(["0", "1", "7", "x", "State100/Operation100A"])),
        st.sampled_from(
            [1, {}, {"name": 3}, {"cost": 2}, {"facts": ["1"]}, {"on": "z"}, [1, 2], {"k": 0}]
        ),
        max_size=3,
    ),
)
EDITS = st.one_of(
    st.tuples(st.just("retarget"), st.integers(0, 99), ODD_NAMES),
    st.tuples(st.just("rename"), st.integers(0, 99), ODD_NAMES),
    st.tuples(st.just("empty"), st.integers(0, 99), st.none()),
    st.tuples(st.just("delete"), st.integers(0, 99), st.none()),
    st.tuples(st.just("header"), st.integers(0, 9), ODD_HEADERS),
    st.tuples(
        st.sampled_from(["_facts", "_states", "_operations", "_layout", "_hazards"]),
        st.integers(0, 9),
        ODD_NOTES,
    ),
    st.tuples(st.just("double"), st.integers(0, 999), st.none()),
)


def broken(values: dict[str, Any], kind: str, pick: int, odd: Any) -> None:
    """One fault in the values of a sample."""
    branches = [name for name in values if not name.startswith("_")]
    name = branches[pick % len(branches)] if branches else ""
    branch = values.get(name, {})
    states = [key for key in branch if key != "HEADER" and not key.startswith("_")]
    state = states[pick % len(states)] if states else ""
    if kind == "header" and branches:
        branch["HEADER"] = odd
    elif kind == "_hazards":
        values[kind] = odd
    elif kind.startswith("_") and branches:
        branch[kind] = odd
    elif not states:
        return
    elif kind == "retarget" and branch[state]:
        branch[state][next(iter(branch[state]))] = odd
    elif kind == "rename":
        branch[odd] = branch.pop(state)
    elif kind == "empty":
        branch[state] = {}
    elif kind == "delete":
        del branch[state]


def doubled(text: str, pick: int) -> str:
    """The text with one of its lines that end with a comma written twice."""
    lines = text.split("\n")
    whole = [i for i, line in enumerate(lines) if line.endswith(",") and ":" in line]
    if whole:
        at = whole[pick % len(whole)]
        lines.insert(at, lines[at])
    return "\n".join(lines)


@st.composite
def broken_blueprints(draw: st.DrawFn) -> Blueprint:
    values = json.loads(draw(st.sampled_from(sorted(TEXTS.values()))))
    edits = draw(st.lists(EDITS, min_size=1, max_size=5))
    for kind, pick, odd in edits:
        if kind != "double":
            broken(values, kind, pick, odd)
    text = json.dumps(values, indent=2)
    for kind, pick, _ in edits:
        if kind == "double":
            text = doubled(text, pick)
    try:
        return read_blueprint(parse_json(text, "broken.json"))
    except ReadError:
        assume(False)
        raise


@given(broken_blueprints())
@settings(max_examples=share_of(250))
def test_no_rule_crashes_and_every_finding_has_its_place(blueprint: Blueprint) -> None:
    text = blueprint.document.text
    lines = text.split("\n")
    for finding in inspect(blueprint):
        place = finding.place
        assert 1 <= place.line <= len(lines)
        assert lines[place.line - 1][place.column - 1] in '"{'
        assert str(finding).startswith(f"broken.json:{place.line}:{place.column} {finding.rule} ")
    assert set(levels(blueprint)) == set(blueprint.branches)
    assert all(set(cycle) <= set(blueprint.branches) for cycle in cycles(blueprint))
    for branch in blueprint:
        assert list(place_states(branch)) == list(branch.table)


@given(broken_blueprints())
@settings(max_examples=share_of(80))
def test_every_fix_helps_or_says_why_not(blueprint: Blueprint) -> None:
    for finding in inspect(blueprint):
        if finding.fix is None:
            continue
        try:
            fixed = finding.fix.apply(blueprint)
        except EditRefused:
            continue
        left = {(f.rule, f.address, f.message) for f in inspect(fixed, [finding.rule])}
        assert (finding.rule, finding.address, finding.message) not in left, finding
