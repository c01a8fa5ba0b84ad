"""Edits of the facts of an SB: add, delete and move a digit in the names of all its states."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.editing.conditions import (
    conditions_follow,
    moved_facts,
    properties_follow,
)
from smsl_studio.blueprint.editing.draft import Draft, branch_of, rename_keys
from smsl_studio.blueprint.editing.levels import levels_follow
from smsl_studio.blueprint.editing.renames import states_renamed
from smsl_studio.blueprint.facts import fact_string, shape_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import has_only_words, told_facts
from smsl_studio.blueprint.properties import FactTerm, Term
from smsl_studio.blueprint.properties.follow import terms_of
from smsl_studio.blueprint.properties.meaning import fact_of
from smsl_studio.blueprint.properties.property import properties_of
from smsl_studio.errors import EditRefused

Json = Any
NEW = -1
"""Stands for the new fact in an order of digits."""


def add_fact(blueprint: Blueprint, branch: str, fact_value: str = "") -> Blueprint:
    """Give every state of an SB one more fact behind the others, with this value (``0`` without
    one, as wide as the others).

    States whose names carry no facts get it in ``_states``. An SB without states gets one more in
    NUM_FACTS. EditRefused if a state would not have the new number of facts.
    """
    found = branch_of(blueprint, branch)
    return _arranged(blueprint, found, [*range(count_of(found)), NEW], fact_value)


def more_facts(blueprint: Blueprint, branch: str, count: int) -> Blueprint:
    """Give every state of an SB so many facts more behind the others, all ``0``."""
    found = branch_of(blueprint, branch)
    return _arranged(blueprint, found, [*range(count_of(found)), *[NEW] * count])


def delete_fact(blueprint: Blueprint, branch: str, digit: int) -> Blueprint:
    """Take a fact out of the names of all states of an SB. Facts behind it move up.

    EditRefused if two states would be the same, if a sub-SB expands the fact, or if a hazard or a
    ``requires`` names it.
    """
    found = branch_of(blueprint, branch)
    order = _order(found, digit)
    sub = found.subs.get(digit)
    if sub is not None:
        raise EditRefused(f"{sub} expands digit {digit} of {branch}", advice=f"Detach {sub} first.")
    _refuse_named(blueprint, branch, digit)
    order.remove(digit)
    return _arranged(blueprint, found, order)


def move_fact(blueprint: Blueprint, branch: str, digit: int, index: int) -> Blueprint:
    """Move a fact to digit ``index`` in the names of all states. What names digits follows:
    SUB_SBS, ``_facts``, ``touches``, ``requires``, hazards, levels. EditRefused for a digit that
    does not exist.
    """
    found = branch_of(blueprint, branch)
    order = _order(found, digit)
    _order(found, index)
    order.remove(digit)
    order.insert(index, digit)
    return _arranged(blueprint, found, order)


def count_of(branch: StateBranch) -> int:
    """Return how many facts the states of an SB carry.

    It is 0 if their names cannot be cut, or are words without a fact.
    """
    return 0 if branch.table and branch.shape.opaque else told_facts(branch)


def stand_beside(branch: StateBranch) -> bool:
    """Return whether new facts of the states stand beside their names, in ``_states``."""
    return bool(branch.table) and (branch.shape.width == 0 or has_only_words(branch))


def _order(branch: StateBranch, digit: int) -> list[int]:
    count = count_of(branch)
    if not 0 <= digit < count:
        raise EditRefused(
            f"{branch.name} has {count} facts, so it has no digit {digit}",
            advice=f"Choose a digit from 0 to {count - 1}." if count else "Add a fact first.",
        )
    return list(range(count))


def _arranged(
    blueprint: Blueprint, branch: StateBranch, order: Sequence[int], new: str = ""
) -> Blueprint:
    """Return the blueprint in which the facts of an SB stand in this order."""
    if list(order) == list(range(count_of(branch))):
        return blueprint
    draft = Draft(blueprint)
    if stand_beside(branch):
        _arrange_notes(draft, branch, order, new or "0")
        names: dict[str, str] = {}
    else:
        names = new_names(branch, order, new)
        states_renamed(draft, branch.name, names)
    if branch.header.num_facts is not None or not branch.table:
        if order:
            draft.header(branch.name)["NUM_FACTS"] = len(order)
        else:
            draft.header(branch.name).pop("NUM_FACTS", None)
    _facts_follow(draft, branch, order, names)
    return draft.done()


def new_names(branch: StateBranch, order: Sequence[int], new: str = "") -> dict[str, str]:
    """Return the name of each state after its facts were put into this order, by its name before.
    NEW stands for a fact with the value ``new``.

    EditRefused if two names would be the same, or if they could not be cut as it is meant.
    """
    shape = branch.shape
    value = new or "0" * max(shape.width, 1)
    names: dict[str, str] = {}
    meant: dict[str, tuple[str, ...]] = {}
    for state in branch.table:
        text = fact_string(state, shape.written)
        values = shape.values(state)
        facts = tuple(value if digit == NEW else values[digit] for digit in order)
        name = state[: len(state) - len(text)] + "".join(facts)
        if name in meant:
            other = next(former for former, now in names.items() if now == name)
            raise EditRefused(
                f"{other} and {state} would have the same facts", advice="Delete one of them first."
            )
        names[state], meant[name] = name, facts
    width = f" of {shape.width} characters" if shape.width > 1 else ""
    advice = f"Choose a value{width} as in the other names." if NEW in order else (
        "Delete or rename the states first.")  # fmt: skip
    must_be_cut(meant, None if shape.written is None else len(order), advice)
    return names


def must_be_cut(meant: Mapping[str, tuple[str, ...]], written: int | None, advice: str) -> None:
    """Raise EditRefused if the names of states would not be cut into the facts that are meant.

    ``written`` is NUM_FACTS.
    """
    after = shape_of(meant, written)
    if meant and (after.opaque or any(after.values(name) != meant[name] for name in meant)):
        count = len(next(iter(meant.values())))
        raise EditRefused(
            f"the names of the states could not be cut into {count} facts", advice=advice
        )


def _arrange_notes(draft: Draft, branch: StateBranch, order: Sequence[int], new: str) -> None:
    """Arrange the facts that ``_states`` gives for names without facts."""
    if branch.shape.opaque:
        _refuse_opaque(branch)
    table = draft.table(branch.name, "_states")
    for state in branch.table:
        values = branch.facts(state) if count_of(branch) else ()
        facts = [new if digit == NEW else values[digit] for digit in order]
        entry = table.get(state, {})
        if not isinstance(entry, dict):
            raise EditRefused(
                f"{state} in _states of {branch.name} is no map, so nothing can be added to it",
                advice="Write it as { ... } in the text.",
            )
        after = {**entry, "facts": facts} if facts else {
            word: inner for word, inner in entry.items() if word != "facts"}  # fmt: skip
        if after:
            table[state] = after
        else:
            table.pop(state, None)
    if not table:
        del draft.at(branch.name)["_states"]


def _refuse_opaque(branch: StateBranch) -> None:
    """Raise EditRefused if the states have facts of another kind, which a new one would hide."""
    given = [state for state, note in branch.notes.states.items() if note.facts]
    misfit = next((state for state in branch.table if state not in given), "")
    if branch.header.num_facts is not None:
        odd = branch.shape.misfits[0]
        raise EditRefused(
            f"the name {odd!r} cannot be cut into {branch.header.num_facts} facts of equal length",
            advice="Rename this state first, or leave NUM_FACTS out.",
        )
    if given:
        raise EditRefused(
            f"only some states of {branch.name} have fact values beside their names",
            advice=f"Give {misfit or given[0]} as many fact values as the others first.",
        )
    if branch.subs or branch.fact_note(0) is not None:
        raise EditRefused(
            f"the only fact of {branch.name} is the name of its state",
            advice="Rename the states so that their names carry facts, such as State_0.",
        )


def _facts_follow(
    draft: Draft, branch: StateBranch, order: Sequence[int], names: Mapping[str, str]
) -> None:
    """Let all that names digits or states of an SB follow its new order of facts."""
    moved = {digit: place for place, digit in enumerate(order) if digit != NEW}
    count, name = count_of(branch), branch.name
    digits = {str(digit): digit for digit in {*range(count), *range(len(order))}}
    for table in draft.tables(name, "_facts"):
        # An entry that is left of a former digit must not become that of the new one.
        for key in digits.keys() & table.keys():
            if digits[key] not in moved:
                del table[key]
        rename_keys(table, {str(was): str(now) for was, now in moved.items()})
        if not table:
            del draft.at(name)["_facts"]
    if branch.header.sub_sbs:
        header = draft.header(name)
        header["SUB_SBS"] = _moved_subs(header["SUB_SBS"], moved)
    places = {(name, was): (name, now) for was, now in moved.items()}
    conditions_follow(draft, lambda facts: moved_facts(facts, places))
    properties_follow(draft, lambda term: _moved_term(draft.before, term, name, moved))
    for table in draft.tables(name, "_operations"):
        for key, note in table.items():
            touches = note.get("touches") if isinstance(note, dict) else None
            if isinstance(touches, list) and touches:
                left = [moved.get(one, one) for one in touches if one in moved or
                        type(one) is not int or not 0 <= one < count]  # fmt: skip
                table[key] = {**note, "touches": left}

    def follow(key: tuple[str, ...]) -> tuple[str, ...] | None:
        """Return the key of a level after the edit, None if its fact is gone."""
        if key[0] != name or len(key) > 3:
            return key
        if len(key) == 3:
            stands = key[2] in branch.table.get(key[1], {})
            return (name, names.get(key[1], key[1]), key[2]) if stands else key
        if key[1] not in digits:
            return key
        now = moved.get(digits[key[1]])
        return None if now is None else (name, str(now))

    levels_follow(draft, follow)


def _moved_subs(written: Json, moved: Mapping[int, int]) -> Json:
    if isinstance(written, list):
        return [_moved_subs(item, moved) for item in written]
    if not isinstance(written, dict):
        return written
    return {
        sub: moved.get(digit, digit) if type(digit) is int and sub[:1] != "_" else digit
        for sub, digit in written.items()
    }


def _moved_term(blueprint: Blueprint, term: Term, name: str, moved: Mapping[int, int]) -> Term:
    """Return a comparison of a property after the facts of an SB were moved."""
    if not isinstance(term, FactTerm) or fact_of(term, blueprint) is None:
        return term
    branch = term.branch or next(iter(blueprint.branches))
    if branch != name or term.digit is None or term.digit not in moved:
        return term
    return replace(term, digit=moved[term.digit])


def _refuse_named(blueprint: Blueprint, name: str, digit: int) -> None:
    """Raise EditRefused if a hazard, a ``requires`` or a property names a fact."""
    who = [(f"the hazard {hazard.name!r}", hazard.facts) for hazard in blueprint.hazards]
    for branch in blueprint:
        notes = branch.notes.operations.items()
        who += [(f"{Address.split(key)[-1]} of {branch.name}", note.requires)
                for key, note in notes if note.requires]  # fmt: skip
    named = [(words, set(map(split_fact, facts))) for words, facts in who]
    for one in properties_of(blueprint):
        terms = (term for formula in one.formulas for term in terms_of(formula))
        facts = {fact_of(term, blueprint) for term in terms if isinstance(term, FactTerm)}
        named.append((f"the property {one.name!r}", facts))
    for words, facts in named:
        if (name, digit) in facts:
            raise EditRefused(
                f"{words} names the fact {fact_text(name, digit)}, which would be gone",
                advice="Change that condition first.",
            )
