"""Any two blueprints: nothing differs exactly where they mean the same, and it reads both ways."""

from __future__ import annotations

import random

from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.comparing import Change, Kind, compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.json_form import parse_json
from tests.blueprint.test_any_edits import random_edit
from tests.smsl.texts import texts

OTHER_WAY = {Kind.ADDED: Kind.REMOVED, Kind.REMOVED: Kind.ADDED}
NO_MEANING = ("field", "header")
"""Fields that no reader reads and header keys that have no effect are told, too."""


def edited(blueprint: Blueprint, seed: int, times: int) -> Blueprint:
    chance = random.Random(seed)
    for _ in range(times):
        try:
            blueprint = random_edit(chance, blueprint)
        except EditRefused:
            continue
    return blueprint


def key(change: Change) -> tuple[str, ...]:
    sides = (change.before, change.old), (change.after, change.new)
    return (change.kind.value, change.what, str(sides[0]), str(sides[1]), change.field)


def turned(change: Change) -> tuple[str, ...]:
    sides = (change.after, change.new), (change.before, change.old)
    kind = OTHER_WAY.get(change.kind, change.kind)
    return (kind.value, change.what, str(sides[0]), str(sides[1]), change.field)


def must_agree(before: Blueprint, after: Blueprint) -> None:
    there, back = compare(before, after), compare(after, before)
    if before == after:
        assert all(change.what in NO_MEANING for change in there.changes)
    else:
        assert there.changes
    names = ("_states", "_operations")
    plain = [c for c in there.changes if not c.field.startswith(names)]
    plain_back = [c for c in back.changes if not c.field.startswith(names)]
    assert sorted(map(key, plain)) == sorted(map(turned, plain_back))
    assert len(there.changes) == len(back.changes)
    assert len(there.moved) == len(back.moved)
    for change in there.changes:
        assert change.words.endswith(".")
        assert (there.place_before(change) is None) == (change.path_before == ())
        if change.before is not None:
            assert before.resolve(change.before) == change.before
        if change.after is not None:
            assert after.resolve(change.after) == change.after
    assert there.as_json()["same"] is there.same


@settings(max_examples=100)
@given(texts(), st.integers(0, 10**6), st.integers(0, 6))
def test_a_difference_is_told_exactly_where_the_meaning_differs(
    text: str, seed: int, times: int
) -> None:
    before = read_blueprint(parse_json(text, "f.json"))
    assert compare(before, before).same
    again = read_blueprint(parse_json(text, "f.json"))
    assert compare(before, again).same
    must_agree(before, edited(before, seed, times))


@settings(max_examples=40)
@given(st.integers(0, 10**6), st.integers(1, 4))
def test_hanoi_after_any_edits(seed: int, times: int) -> None:
    before = hanoi(2)
    must_agree(before, edited(before, seed, times))


@settings(max_examples=40)
@given(texts(), texts())
def test_any_two_files(one: str, other: str) -> None:
    must_agree(
        read_blueprint(parse_json(one, "one.json")), read_blueprint(parse_json(other, "other.json"))
    )
