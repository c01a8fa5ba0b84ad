"""Compares headers by their effect: an explicit default is no change."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint.comparison.difference import Change
from smsl_studio.blueprint.comparison.file_level import changed_fields, kind_of, value_words
from smsl_studio.blueprint.comparison.sides import BranchSides
from smsl_studio.blueprint.comparison.values import fields_that_differ, merged
from smsl_studio.blueprint.model import StateBranch

Json = Any
HEADER = "HEADER"


def compare_header(pair: BranchSides) -> None:
    """Compare INITIAL, ACTIVATING, the split of names into facts, sub-SBs, and every other key."""
    for key in ("INITIAL", "ACTIVATING"):
        _compare_role(pair, key)
    _compare_facts(pair)
    _compare_subs(pair)
    one, other = pair.before.header, pair.after.header
    was, now = _others(pair.before), _others(pair.after)
    for key, here, there in fields_that_differ(was, now):
        old, new = was.get(key), now.get(key)
        words = value_words(here, there, old, new)
        _add(pair, key, (old, new), words, sides=(here, there))
    pair.sides.changes.extend(
        changed_fields(
            one.fields,
            other.fields,
            f"the header of {pair.after.name}",
            (pair.before.name, HEADER),
            (pair.after.name, HEADER),
            before=pair.before.address,
            after=pair.after.address,
        )
    )


def _compare_role(pair: BranchSides, key: str) -> None:
    word = key.lower()
    old, new = getattr(pair.before, word), getattr(pair.after, word)
    if pair.state(old) == new:
        return
    written = getattr(pair.after.header, word) is not None
    default = "" if written or not new else f", the {_default(key)} state listed"
    words = f"is {new or 'no state'} instead of {old or 'no state'}{default}"
    _add(pair, key, (old, new), words)


def _default(key: str) -> str:
    return "first" if key == "INITIAL" else "last"


def _compare_facts(pair: BranchSides) -> None:
    one, other = pair.before.shape, pair.after.shape
    if (one.num_facts, one.width, one.opaque) == (other.num_facts, other.width, other.opaque):
        return
    old, new = pair.before.header.num_facts, pair.after.header.num_facts
    words = f"cuts the names into {_cut(pair.after)} instead of {_cut(pair.before)}"
    if old == new:
        words = f"is {_cut(pair.after)} by the names, instead of {_cut(pair.before)}"
    _add(pair, "NUM_FACTS", (_shape(pair.before), _shape(pair.after)), words)


def _cut(branch: StateBranch) -> str:
    shape = branch.shape
    if shape.opaque:
        return "one fact (the whole name)"
    count = f"{shape.num_facts} fact{'' if shape.num_facts == 1 else 's'}"
    return count if shape.width <= 1 else f"{count} of {shape.width} characters"


def _shape(branch: StateBranch) -> Json:
    return None if branch.shape.opaque else branch.shape.num_facts


def _compare_subs(pair: BranchSides) -> None:
    old: dict[str, list[int]] = {}
    new: dict[str, list[int]] = {}
    names: dict[str, str] = {}
    for sub, digit in pair.before.header.sub_sbs:
        now = pair.sides.branch(sub)
        names[now] = sub
        old.setdefault(now, []).append(digit)
    for sub, digit in pair.after.header.sub_sbs:
        new.setdefault(sub, []).append(digit)
    for sub in merged(list(old), list(new)):
        here, there = sorted(old.get(sub, [])), sorted(new.get(sub, []))
        if here == there:
            continue
        one, other = _digits(here), _digits(there)
        was = names.get(sub, sub)
        if here and there:
            words = f"lets {sub} expand {other} instead of {one}"
        elif here:
            words = f"lets {was} expand {one} no more"
        else:
            words = f"lets {sub} expand {other}"
        below = (was if here else "", sub if there else "")
        values, sides = (_one(here), _one(there)), (bool(here), bool(there))
        _add(pair, "SUB_SBS", values, words, below, sides)


def _digits(digits: list[int]) -> str:
    return "digit " + " and ".join(map(str, digits))


def _one(digits: list[int]) -> Json:
    return digits[0] if len(digits) == 1 else digits or None


def _others(branch: StateBranch) -> dict[str, Json]:
    """Return the keys without effect. A correct NUM_STATES is left out."""
    header = branch.header
    found = {**header.odd, **header.unknown}
    if header.num_states is not None and header.num_states != len(branch.table):
        found["NUM_STATES"] = header.num_states
    return found


def _add(
    pair: BranchSides,
    key: str,
    values: tuple[Json, Json],
    words: str,
    below: tuple[str, str] = ("", ""),
    sides: tuple[bool, bool] = (True, True),
) -> None:
    """Add a change of a header. Pairs are before and after.

    ``below`` has the keys inside the header's value. ``sides`` says on which sides it is written.
    """
    here, there = sides
    inner = [(key, name) if name else (key,) for name in below]
    pair.add(
        Change(
            kind_of(here, there),
            "header",
            pair.before.address,
            pair.after.address,
            f"{key} of {pair.after.name} {words}.",
            "/".join(inner[there]),
            *values,
            (pair.before.name, HEADER, *inner[0]) if here else (),
            (pair.after.name, HEADER, *inner[1]) if there else (),
        )
    )
