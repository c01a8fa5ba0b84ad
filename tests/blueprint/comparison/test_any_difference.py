"""For any two blueprints: the comparison is empty exactly if they mean the same, and it is
symmetric."""

from __future__ import annotations

import random

from hypothesis import given, settings
from hypothesis import strategies as st

import smsl_studio as smsl
from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import Change, ChangeKind, compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.generate.rules import hanoi
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json
from tests.blueprint.test_any_edits import random_edit
from tests.counts import share_of
from tests.smsl.texts import texts

OTHER_WAY = {ChangeKind.ADDED: ChangeKind.REMOVED, ChangeKind.REMOVED: ChangeKind.ADDED}
NO_MEANING = ("header",)
"""Header keys that have no effect are told, too."""


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
    assert sorted(map(key, there.fields)) == sorted(map(turned, back.fields))
    assert {change.what for change in there.fields} <= {"field"}
    for change in (*there.changes, *there.fields):
        assert change.words.endswith(".")
        assert (there.place_before(change) is None) == (change.path_before == ())
        if change.before is not None:
            assert before.resolve(change.before) == change.before
        if change.after is not None:
            assert after.resolve(change.after) == change.after
    assert there.as_json()["same"] is there.same


@settings(max_examples=share_of(100))
@given(texts(), st.integers(0, 10**6), st.integers(0, 6))
def test_a_difference_is_told_exactly_where_the_meaning_differs(
    text: str, seed: int, times: int
) -> None:
    before = read_blueprint(parse_json(text, "f.json"))
    assert compare(before, before).same
    again = read_blueprint(parse_json(text, "f.json"))
    assert compare(before, again).same
    must_agree(before, edited(before, seed, times))


@settings(max_examples=share_of(40))
@given(st.integers(0, 10**6), st.integers(1, 4))
def test_hanoi_after_any_edits(seed: int, times: int) -> None:
    before = hanoi(2)
    must_agree(before, edited(before, seed, times))


@settings(max_examples=share_of(40))
@given(texts(), texts())
def test_any_two_files(one: str, other: str) -> None:
    must_agree(
        read_blueprint(parse_json(one, "one.json")), read_blueprint(parse_json(other, "other.json"))
    )


BLUEPRINTS = tuple(
    smsl.read(samples_dir() / f"{name}.json")
    for name in ("hanoi", "hfsm", "registration", "registration-digitization", "three-levels")
)


@settings(max_examples=share_of(60))
@given(st.sampled_from(BLUEPRINTS), st.integers(0, 10**6))
def test_one_edit_anywhere_in_a_sample_is_one_change(before: Blueprint, seed: int) -> None:
    chance = random.Random(seed)
    branch = before[chance.choice([one.name for one in before if one.table])]
    state = chance.choice([name for name, operations in branch.table.items() if operations])
    operation = chance.choice(list(branch.table[state]))
    other = chance.choice([name for name in branch.table if name != branch.table[state][operation]])
    node, edge = Address(branch.name, state), Address(branch.name, state, operation)
    edits: list[tuple[Blueprint, tuple[str, str, str, str]]] = [
        (edit.rename(before, node, "Fresh"), ("renamed", "state", state, "Fresh")),
        (edit.rename(before, edge, "Fresh"), ("renamed", "operation", operation, "Fresh")),
        (
            edit.retarget(before, edge, other),
            ("retargeted", "operation", branch.table[state][operation], other),
        ),
        (edit.delete(before, [edge]), ("removed", "operation", branch.table[state][operation], "")),
        (edit.add_operation(before, branch.name, state, "Fresh", other),
         ("added", "operation", "", other)),
        (edit.rename(before, branch.address, "Fresh"), ("renamed", "branch", branch.name, "Fresh")),
    ]  # fmt: skip
    for after, expected in edits:
        changes = compare(before, after).changes
        # A name without digits leaves the SB without facts that can be cut out of its names.
        told = [c for c in changes if (c.what, c.field) != ("header", "NUM_FACTS")]
        assert [(c.kind.value, c.what, c.old or "", c.new or "") for c in told] == [expected]
