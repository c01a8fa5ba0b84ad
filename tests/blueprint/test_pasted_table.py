"""A table of state, operation and target becomes states and operations; faults are told by row."""

from __future__ import annotations

import random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.pasted_table import LONGEST, is_table, read_states
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.forms import form_named
from tests.blueprint.values import read
from tests.counts import share_of

SMALL: dict[str, Any] = {
    "SB1": {"HEADER": {"NUM_STATES": 2}, "Idle": {"go": "Ready"}, "Ready": {},
            "_layout": {"Idle": [0, 0], "Ready": [200, 0]}},
}  # fmt: skip


def test_rows_make_states_and_operations_beside_those_that_stand() -> None:
    table = "Ready\tlift\tUp\nUp\tdrop\tIdle\nIdle\tgo\tReady\nSpare\n"
    after, made = edit.paste_states(read(SMALL), "SB1", table)
    assert after["SB1"].table == {
        "Idle": {"go": "Ready"}, "Ready": {"lift": "Up"}, "Up": {"drop": "Idle"}, "Spare": {}
    }  # fmt: skip
    assert [str(address) for address in made] == [
        "SB1/Up", "SB1/Spare", "SB1/Ready/lift", "SB1/Up/drop"
    ]  # fmt: skip
    assert after["SB1"].header.num_states == 4
    assert read_states(read(SMALL)["SB1"], table).known == 1


def test_the_first_row_may_name_the_columns_in_any_order() -> None:
    plain = read_states(read(SMALL)["SB1"], "A\tgo\tB")
    named = read_states(read(SMALL)["SB1"], 'To\tFrom\tAction\n"B"\tA\tgo\n')
    assert named.states == ("A", "B") == plain.states
    assert [row[1:] for row in named.operations] == [row[1:] for row in plain.operations]
    with pytest.raises(EditRefused, match="there is no row"):
        read_states(read(SMALL)["SB1"], "state\toperation\ttarget\n")


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("A\tgo", "row 1: an operation without a target"),
        ("A\t\tB", "row 1: a target without an operation"),
        ("A\tgo\tB\n\tgo\tB", "row 2: no state"),
        ("A\tgo\tB\tred", "row 1: 'red' stands behind the last column"),
        ("A\tgo\tB\n\n_x\tgo\tB", "row 3: '_x' starts with _"),
        ("A\tHEADER\tHEADER", "row 1: HEADER is the name"),
        ("A\tgo\tB\nA\tgo\tC", "row 2: go of A leads to B in row 1"),
        ("Idle\tgo\tIdle", "row 1: Idle has an operation go already, to Ready"),
        ("A\t1\nB\t1\nC\t1\nD\t1\nE\t1", "and 2 more rows"),
        ("A\tgo\tB\n" * (LONGEST // 6), "more than 300,000 characters"),
    ],
)
def test_faults_are_told_by_row_and_nothing_is_pasted(table: str, words: str) -> None:
    with pytest.raises(EditRefused, match=words):
        edit.paste_states(read(SMALL), "SB1", table)


def test_a_table_that_brings_nothing_is_refused() -> None:
    with pytest.raises(EditRefused, match="has all states and operations"):
        edit.paste_states(read(SMALL), "SB1", "Idle\tgo\tReady")


@pytest.mark.parametrize(
    ("text", "table"),
    [
        ("A\tgo\tB", True),
        ("\n\nA\tgo\tB\n", True),
        ("buy milk", False),
        ("A\t", False),
        ('{\n\t"SB1": {}\n}', False),
        ('{\t"SB1": {}}', False),
        ("State0:\t[go -> State1]", False),
        ('\t"State0": {}', False),
        ("# NAME:\tSB1", False),
    ],
)
def test_a_table_is_told_from_the_text_of_a_file(text: str, table: bool) -> None:
    assert is_table(text) is table


def test_states_without_an_sb_around_them_are_pasted_too() -> None:
    before = read(SMALL)
    for text in ('"Up": {"drop": "Idle"},\n"Spare": {},', "Up: [drop -> Idle],\nSpare: [ ]"):
        after, made = edit.paste(before, "SB1", text)
        assert after["SB1"].table["Up"] == {"drop": "Idle"}
        assert [str(address) for address in made] == ["SB1/Up", "SB1/Spare"]
    for text in ('"drop": "Idle"', "drop -> Idle", "buy milk"):
        with pytest.raises(EditRefused, match="is no SMSL"):
            edit.paste(before, "SB1", text)


@settings(max_examples=share_of(100), deadline=None)
@given(st.sampled_from(["json", "smsl", "yaml"]), st.integers(0, 10**6))
def test_what_was_pasted_and_deleted_leaves_the_same_meaning(form: str, seed: int) -> None:
    chance = random.Random(seed)
    text = form_named(form).write(SMALL)
    before = read_blueprint(form_named(form).parse(text, f"f.{form}"))
    names = ["Idle", "Ready", "Up", "x y", "é", "a/b", "State_01"]
    rows = [[chance.choice(names), chance.choice("abc"), chance.choice(names)]
            for _ in range(chance.randrange(1, 12))]  # fmt: skip
    table = "\n".join("\t".join(row) for row in rows)
    try:
        after, made = edit.paste_states(before, "SB1", table)
    except EditRefused:
        return
    again = read_blueprint(form_named(form).parse(after.document.text, f"f.{form}"))
    assert again == after
    told = {(row[0], row[1]): row[2] for row in rows}
    assert all(after["SB1"].table[state][op] == target for (state, op), target in told.items())
    here = [one for one in made if one.state in before["SB1"].table]
    gone = edit.delete(after, [*here, *(a for a in made if not a.operation)])
    assert gone == before
    assert Address("SB1", "Idle") not in made
