"""After any sequence of edits, text and meaning still agree, for any blueprint in any layout."""

from __future__ import annotations

import difflib
import json
import random
from collections import Counter
from collections.abc import Callable
from inspect import signature
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.names import fresh_branch_name, fresh_operation_name, fresh_state_name
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.errors import EditRefused
from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.json_form import parse_json, write_json
from smsl_studio.smsl.splice import reconcile
from tests.counts import share_of
from tests.smsl.texts import texts

ODD_NAMES = ["State0", "a/b", "~", "é", "Op_1b", "x y", '"', "S\\", "State_ab", "HEADER ", "", "_n"]


def some(chance: random.Random, blueprint: Blueprint) -> Address:
    """The address of something in the blueprint."""
    branch = blueprint[chance.choice(list(blueprint.branches))]
    kind = chance.randrange(3)
    if kind == 0 or not branch.table:
        return branch.address
    state = chance.choice(list(branch.table))
    if kind == 1 or not branch.table[state]:
        return Address(branch.name, state)
    return Address(branch.name, state, chance.choice(list(branch.table[state])))


def random_edit(chance: random.Random, blueprint: Blueprint) -> Blueprint:
    """What one edit, chosen by chance, makes of a blueprint; EditRefused where it is nonsense."""
    if not blueprint.branches:
        return edit.add_branch(blueprint, fresh_branch_name(blueprint))
    name = chance.choice([name for name in edit.__all__ if name not in APART])
    change = getattr(edit, name)
    values = drawn_values(chance, blueprint)
    chosen = {
        one.name: values[one.name]()
        for one in signature(change).parameters.values()
        if one.default is one.empty or (one.name != "offset" and chance.random() < 0.5)
    }
    if name == "set_header":
        chosen["key"] = chance.choice(["INITIAL", "ACTIVATING", "NUM_FACTS", "NUM_STATES"])
    made = change(**chosen)
    after: Blueprint = made[0] if isinstance(made, tuple) else made
    return after


APART = {
    "excerpt": "it gives a text, which ``paste`` puts in again",
    "give_facts": "it takes the blueprint before and after",
    "keep_activating": "it takes the blueprint before and after",
    "keep_facts": "it takes the blueprint before and after",
    "keep_on": "it takes the blueprint before and after",
    "turned_facts": "it takes the blueprint before and after",
    "keep_last": "it takes a path to a key that is written twice",
    "set_imports": "it takes other files, and test_editing_imports.py has them",
}
"""The edits that no random arguments fit, each with the reason."""


def drawn_values(chance: random.Random, blueprint: Blueprint) -> dict[str, Callable[[], Any]]:
    """A value for a parameter of an edit, by its name. A parameter of another name comes here."""
    at, other = some(chance, blueprint), some(chance, blueprint)
    where = (chance.uniform(-9, 9), float(chance.randrange(99)))
    odd = chance.choice(ODD_NAMES)
    fresh = [odd, fresh_branch_name(blueprint), fresh_state_name(blueprint[at.branch])]
    if at.state:
        fresh.append(fresh_operation_name(blueprint[at.branch], at.state))
    notes: list[dict[str, Any] | None] = [
        {"title": odd}, {"cost": 1.5}, {"name": odd, "on": "1"}, None, {"facts": ["a"]},
    ]  # fmt: skip
    key = chance.choice(["0", at.state, at.operation])
    level = chance.choice(["human", "shared", "automatic", None])
    return {
        "blueprint": lambda: blueprint,
        "address": lambda: at,
        "addresses": lambda: [at, other][: chance.randrange(1, 3)],
        "branch": lambda: at.branch,
        "base": lambda: at.branch,
        "sub": lambda: other.branch,
        "state": lambda: at.state,
        "target": lambda: other.state,
        "source": lambda: other.state,
        "name": lambda: chance.choice(fresh),
        "new_name": lambda: odd,
        "rename_everywhere": lambda: True,
        "index": lambda: chance.randrange(4),
        "digit": lambda: chance.randrange(2),
        "states": lambda: [one for one in (at.state, other.state) if one],
        "old_value": lambda: chance.choice(["0", "1", *"ab"]),
        "new_value": lambda: chance.choice(["0", "1", *"ab", odd]),
        "table_text": lambda: chance.choice(
            ["", f"{odd}\tgo\t{other.state}", f"a\tgo\tb\n{at.state}\tgo\tb\nc", "a\tgo\nb"]
        ),
        "fact_value": lambda: chance.choice(["", "1", "b", "10", odd]),
        "at": lambda: where,
        "positions": lambda: {at.state: where},
        "former": lambda: {at.state: (0.0, 0.0)},
        "bends": lambda: [where] * chance.randrange(3),
        "label": lambda: chance.choice([None, (chance.random(), *where)]),
        "key": lambda: key,
        "value": lambda: chance.choice([other.state, None, 1, 2, 3]),
        "table": lambda: chance.choice(["_facts", "_states", "_operations"]),
        "fact_rows": lambda: chance.choice(["", "a\t0 = no\nb", f"name\tunit\n{odd}\tmm"]),
        "note": lambda: chance.choice(notes),
        "given": lambda: {at.state: chance.choice([["0"], ["0", "1"], ["", "a"], [odd]])},
        "changes": lambda: {(at.branch, key): chance.choice(notes) or {}},
        "levels": lambda: {str(at): level, "supervision": level},
        "properties": lambda: [{"name": "p", "never": "A/0 = 1"}] * chance.randrange(3),
        "hazards": lambda: [{"name": "h", "facts": {}}] * chance.randrange(3),
        "text": lambda: edit.excerpt(blueprint, [other]),
        "file": lambda: chance.choice(blueprint.documents).file,
        "drawn_notes": lambda: {chance.choice("123"): chance.choice([
            None, {"text": odd, "at": where}, {"text": "n", "at": where, "state": at.state},
            {"at": where, "state": None}])},
        "groups": lambda: {chance.choice("123"): chance.choice([
            None, {"title": odd}, {"title": odd, "states": [at.state]}])},
    }  # fmt: skip


def whole(blueprint: Blueprint) -> Any:
    """Everything a blueprint holds, order included."""
    return json.dumps(
        [
            blueprint.meaning,
            dict(blueprint.fields),
            [
                [branch.name, branch.table, dict(branch.fields), dict(branch.state_fields)]
                for branch in blueprint
            ],
            [
                [h.initial, h.activating, h.num_facts, h.sub_sbs, h.num_states, dict(h.unknown)]
                for h in (branch.header for branch in blueprint)
            ],
        ]
    )


@settings(max_examples=share_of(300))
@given(texts(), st.integers(0, 10**6))
def test_after_every_edit_the_text_reads_to_the_blueprint(text: str, seed: int) -> None:
    chance = random.Random(seed)
    blueprint = read_blueprint(parse_json(text, "f.json"))
    for _ in range(8):
        before = blueprint.document.text
        try:
            after = random_edit(chance, blueprint)
        except EditRefused:
            continue
        assert blueprint.document.text == before
        again = read_blueprint(parse_json(after.document.text, "f.json"))
        assert whole(again) == whole(after)
        assert again == after
        blueprint = after


@settings(max_examples=share_of(200))
@given(texts())
def test_the_values_of_a_blueprint_change_nothing_in_its_text(text: str) -> None:
    document = parse_json(text, "f.json")
    blueprint = read_blueprint(document)
    plain = read_blueprint(parse_json(write_json(values_of(blueprint)), "f.json"))
    assert plain == blueprint
    assert values_of(plain) == values_of(blueprint)
    assert reconcile(document, values_of(blueprint)).text == text


@settings(max_examples=share_of(150))
@given(st.integers(0, 10**6))
def test_an_edit_touches_no_line_that_does_not_name_its_element(seed: int) -> None:
    chance = random.Random(seed)
    text = write_json(values_of(hanoi(2))).replace("\n", chance.choice(["\n", "\r\n"]))
    before = read_blueprint(parse_json(text, "f.json"))
    table = before["SB1"].table
    state = chance.choice(list(table))
    operation, target = chance.choice(list(table[state].items()))
    edge = Address("SB1", state, operation)
    kind = chance.randrange(5)
    names: tuple[str, ...]
    if kind == 0:
        after, names = edit.rename(before, edge, "New"), (operation, "New")
    elif kind == 1:
        other = chance.choice([name for name in table if name != target])
        after, names = edit.retarget(before, edge, other), (operation,)
    elif kind == 2:
        after, names = edit.delete(before, [edge]), (operation,)
    elif kind == 3:
        after, names = edit.rename(before, Address("SB1", state), "New"), (state, "New")
    else:
        after, names = edit.add_operation(before, "SB1", state, "New", state), ("New",)
    touched = touched_lines(before.document.text, after.document.text)
    assert touched
    assert all(any(f'"{name}"' in line for name in names) for line in touched)


def touched_lines(before: str, after: str) -> list[str]:
    """The lines that differ, but for those where only the comma to a neighbour does."""
    lines = list(difflib.unified_diff(before.split("\n"), after.split("\n"), n=0))[2:]
    gone, come = (
        Counter(line[1:].rstrip(",\r") for line in lines if line[0] == sign) for sign in "-+"
    )
    return [*(gone - come), *(come - gone)]
