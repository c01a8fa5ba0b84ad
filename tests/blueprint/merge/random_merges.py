"""Checks of one random merge: against the oracle, in a file, and with its sides swapped."""

from __future__ import annotations

from random import Random

from smsl_studio.blueprint.merge import Conflict, Merge, merge, read_conflicts
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.inputs import inspect
from smsl_studio.smsl.json_form import parse_json
from tests.blueprint.merge.sides import (
    GONE,
    address_of_thing,
    drawn,
    edited,
    merged_thing,
    things,
)


def sides(number: int, renames: bool) -> tuple[Blueprint, Blueprint, Blueprint]:
    chance = Random(number)
    base = drawn(chance)
    ours = edited(base, chance, chance.randint(1, 9), renames)
    return base, ours, edited(base, chance, chance.randint(1, 9), renames)


def turned(conflict: Conflict) -> tuple[object, ...]:
    """A conflict as the other side sees it."""
    return conflict.address, conflict.path, conflict.base, conflict.theirs, conflict.ours


def check_against_the_oracle(base: Blueprint, ours: Blueprint, theirs: Blueprint) -> Merge:
    done = merge(base, ours, theirs)
    before, here, there, after = map(things, (base, ours, theirs, done.blueprint))
    open_ones = [one.address for one in done.conflicts]
    touched = set(open_ones)
    # What belongs to a conflict follows the choice: what lies below it, and ways to a lost state.
    lost = {one.path for one in done.conflicts if len(one.path) <= 2}

    def belongs(thing: tuple[str, ...]) -> bool:
        address = address_of_thing(thing)
        if any(address == one or address.startswith(f"{one}/") for one in touched):
            return True
        targets = {side.get(thing, GONE) for side in (before, here, there)}
        return thing[0] in ("target", "cost") and any(
            path == (thing[1], target)
            for path in lost
            for target in targets | {side.get(("target", *thing[1:]), GONE)
                                     for side in (before, here, there)}
        )  # fmt: skip

    for thing in {*before, *here, *there}:
        values = [side.get(thing, GONE) for side in (before, here, there)]
        wanted = merged_thing(*values)
        if wanted is None:
            assert belongs(thing), f"{thing} {values} is no conflict"
        elif wanted == "" and thing[0] in ("initial", "activating") and values[1] != values[2]:
            continue  # one side has no states left, and those that clash stay
        elif not belongs(thing):
            assert after.get(thing, GONE) == wanted, thing
    assert after.keys() <= before.keys() | here.keys() | there.keys()
    return done


def check_that_it_is_readable(done: Merge) -> None:
    text = done.blueprint.document.text
    again = read_blueprint(parse_json(text, "file.json"))
    assert again == done.blueprint
    raw = again.document.values.get("_conflicts", [])
    read, faults = read_conflicts(raw)
    assert faults == []
    assert list(read.values()) == list(done.conflicts)
    told = [str(one.address) for one in inspect(again, ["R29"])
            if "a merge left" in one.message]  # fmt: skip
    assert sorted(told) == sorted(one.address for one in done.conflicts)


def check_the_other_order(base: Blueprint, ours: Blueprint, theirs: Blueprint) -> None:
    one, other = merge(base, ours, theirs), merge(base, theirs, ours)
    assert len(one.conflicts) == len(other.conflicts)
    if any(conflict.about_name for conflict in one.conflicts):
        return  # the addresses are those of the other name
    there = [(c.address, c.path, c.base, c.ours, c.theirs) for c in other.conflicts]
    for conflict in one.conflicts:
        assert turned(conflict) in there, conflict
    if not one.conflicts:
        assert things(one.blueprint) == things(other.blueprint)
