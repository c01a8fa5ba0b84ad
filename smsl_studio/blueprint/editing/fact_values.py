"""Edits of the values of facts: another name for a value, and another value in some states."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.editing.conditions import Facts, conditions_follow, properties_follow
from smsl_studio.blueprint.editing.digits import count_of, must_be_cut
from smsl_studio.blueprint.editing.draft import Draft, branch_of, existing, free_name, rename_keys
from smsl_studio.blueprint.editing.notes import change_notes
from smsl_studio.blueprint.editing.renames import rename_states
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.properties import FactTerm, Term
from smsl_studio.blueprint.properties.meaning import fact_of
from smsl_studio.errors import EditRefused, did_you_mean

Json = Any
Changes = dict[str, tuple[str, ...]]
"""States with the facts that they get."""


def rename_value(
    blueprint: Blueprint, branch: str, digit: int, old_value: str, new_value: str
) -> Blueprint:
    """Give a value of a fact another name in all states of an SB.

    Its entries in ``_facts``, every ``requires`` and hazard that names it follow, and what names a
    state. The same states count as on as before. EditRefused if the fact has no such value, if the
    new one is taken, or if names with it could not be cut.
    """
    found = branch_of(blueprint, branch)
    changes = renamed_value(found, digit, old_value, new_value)
    if old_value == new_value:
        return blueprint
    draft = Draft(blueprint)
    _write(draft, found, changes)
    for table in draft.tables(branch, "_facts"):
        entry = table.get(str(digit))
        if isinstance(entry, dict):
            table[str(digit)] = _renamed_in(entry, old_value, new_value)

    def follow(facts: Facts) -> Facts:
        """Return the facts of a condition after the edit."""
        named = [text for text, value in facts.items()
                 if value == old_value and split_fact(text) == (branch, digit)]  # fmt: skip
        return {**facts, **dict.fromkeys(named, new_value)} if named else facts

    conditions_follow(draft, follow)

    def renamed(term: Term) -> Term:
        """Return a comparison of a property after the edit."""
        if not isinstance(term, FactTerm) or term.value != old_value:
            return term
        fact = fact_of(term, blueprint)
        return replace(term, value=new_value) if fact == (branch, digit) else term

    properties_follow(draft, renamed)
    after, on = draft.done(), found.on_value(digit)
    on = new_value if on == old_value else on
    if after[branch].on_value(digit) == on:
        return after
    return change_notes(after, "_facts", {(branch, str(digit)): {"on": on}})


def set_value(
    blueprint: Blueprint, branch: str, states: Iterable[str], digit: int, fact_value: str
) -> Blueprint:
    """Give a fact another value in some states of an SB. Names that are made of facts follow.

    EditRefused if another state has the same facts, or if names with the value could not be cut.
    """
    found = branch_of(blueprint, branch)
    chosen = list(states)
    for state in chosen:
        existing(blueprint, Address(branch, state))
    _must_have_facts(found, digit)
    changes = {
        state: _with(found, state, digit, fact_value)
        for state in chosen
        if found.facts(state)[digit] != fact_value
    }
    if not changes:
        return blueprint
    _must_fit(found, fact_value)
    holders = {found.facts(state): state for state in found.table if state not in changes}
    for state, facts in changes.items():
        other = holders.setdefault(facts, state)
        if other != state and other not in changes:
            raise EditRefused(f"{other} has these facts already",
                              advice="Delete it or give it another value first.")  # fmt: skip
        if other != state:
            raise EditRefused(f"{other} and {state} would have the same facts",
                              advice="Choose only one of them.")  # fmt: skip
    draft = Draft(blueprint)
    _write(draft, found, changes)
    return draft.done()


def renamed_value(branch: StateBranch, digit: int, old: str, new: str) -> Changes:
    """Return the states with a value of a fact, and the facts that they have after its rename.

    EditRefused as ``rename_value``.
    """
    _must_have_facts(branch, digit)
    note = branch.fact_note(digit) or FactNote()
    alphabet = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
    known = {*alphabet, *note.values, *note.failure, branch.on_value(digit)}
    if old not in known:
        advice = did_you_mean(old, sorted(known)) or "Choose a value it has."
        raise EditRefused(f"digit {digit} of {branch.name} has no value {old!r}", advice=advice)
    if new != old and new in known:
        holder = next((s for s in branch.table if branch.facts(s)[digit] == new), "")
        where = f", in {holder}" if holder else ""
        raise EditRefused(f"digit {digit} of {branch.name} has the value {new!r} already{where}",
                          advice="Choose another value.")  # fmt: skip
    changes = {state: _with(branch, state, digit, new) for state in branch.table
               if branch.facts(state)[digit] == old}  # fmt: skip
    _must_fit(branch, new)
    names_with(branch, changes)
    return changes


def names_with(branch: StateBranch, changes: Changes) -> dict[str, str]:
    """Return the new names of the states that get other facts. It is empty if names carry none.

    EditRefused if the names could not be cut as it is meant.
    """
    shape = branch.shape
    if shape.width == 0:
        return {}
    names = {}
    for state, facts in changes.items():
        text = fact_string(state, shape.written)
        names[state] = state[: len(state) - len(text)] + "".join(facts)
        free_name(names[state], (), "a state")
    meant = {names.get(s, s): changes[s] if s in names else branch.facts(s) for s in branch.table}
    must_be_cut(meant, shape.written, "Choose a letter or a digit.")
    return names


def _write(draft: Draft, branch: StateBranch, changes: Changes) -> None:
    """Write the facts of states: into their names, or into ``_states`` if names carry none."""
    names = names_with(branch, changes)
    if names:
        rename_states(draft, branch.name, names)
    elif changes:
        table = draft.table(branch.name, "_states")
        for state, facts in changes.items():
            table[state] = {**table[state], "facts": list(facts)}


def _renamed_in(entry: dict[str, Json], old: str, new: str) -> dict[str, Json]:
    """Return an entry of ``_facts`` in which a value has another name."""
    after = dict(entry)
    if isinstance(entry.get("values"), dict):
        after["values"] = dict(entry["values"])
        rename_keys(after["values"], {old: new})
    if entry.get("on") == old:
        after["on"] = new
    if isinstance(entry.get("failure"), list):
        after["failure"] = [new if value == old else value for value in entry["failure"]]
    return after


def _with(branch: StateBranch, state: str, digit: int, value: str) -> tuple[str, ...]:
    facts = branch.facts(state)
    return (*facts[:digit], value, *facts[digit + 1 :])


def _must_have_facts(branch: StateBranch, digit: int) -> None:
    if branch.table and not count_of(branch):
        raise EditRefused(f"the names of the states of {branch.name} carry no facts",
                          advice="Name them such as State_01, or add a fact first.")  # fmt: skip
    count = count_of(branch)
    if not 0 <= digit < count:
        raise EditRefused(f"{branch.name} has {count} facts, so it has no digit {digit}",
                          advice=f"Choose a digit from 0 to {count - 1}." if count else
                          "Add a fact first.")  # fmt: skip


def _must_fit(branch: StateBranch, value: str) -> None:
    """Raise EditRefused for a value that no state of the SB could have."""
    if not value.strip() or not value.isprintable():
        raise EditRefused("a value needs a visible character", advice="Type a value.")
    width = branch.shape.width if branch.table else 0
    if width and len(value) != width:
        letters = "one character" if width == 1 else f"{width} characters"
        raise EditRefused(f"a value of {branch.name} has {letters}, and {value!r} has {len(value)}",
                          advice=f"Type {letters}.")  # fmt: skip
