"""Writes facts into ``_states``: values that a person gives, and values for new states."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice, product

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.draft import Draft, branch_of, existing
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import carried, has_only_words, is_plain_word
from smsl_studio.errors import EditRefused

_TRIES = 4096

MOST_KEPT = 200
"""The largest number of states whose facts ``keep_facts`` writes."""


def give_facts(before: Blueprint, after: Blueprint) -> Blueprint:
    """Return ``after`` in which new states have facts in ``_states`` if all others had them there.

    A new state gets the first combination of values that no other state has. If it had none, the
    facts of all states would be read from their names, and ``_states`` would not count any more.
    """
    for branch in after:
        former = before.branches.get(branch.name)
        if former is None or former is branch or not former.table or not branch.table:
            continue
        if former.shape.width == 0 and not former.shape.opaque:
            after = _with_facts(former, after, branch)
    return after


def keep_facts(before: Blueprint, after: Blueprint) -> Blueprint:
    """Return ``after`` in which states keep their facts although a new name carries none.

    Without this each state of the SB would have one fact, its own name. So the facts of all its
    states are written into ``_states``. Two things are left as they are: an SB of more than
    ``MOST_KEPT`` states, and a name that is a plain word in an SB that says nothing of facts.
    """
    for branch in after:
        former = before.branches.get(branch.name)
        if former is None or former is branch or not branch.shape.opaque:
            continue
        names = dict(zip(former.table, branch.table, strict=False))
        fresh = [new for old, new in names.items() if new not in former.table]
        if not _is_rename(former, branch, fresh) or any(is_plain_word(former, n) for n in fresh):
            continue
        draft = Draft(after)
        table = draft.table(branch.name, "_states")
        for old, new in names.items():
            table[new] = {**(table.get(new) or {}), "facts": list(former.facts(old))}
        after = draft.done()
    return after


def _is_rename(former: StateBranch, branch: StateBranch, fresh: Sequence[str]) -> bool:
    """Whether the only change of names is that states of an SB with facts got other ones."""
    gone = former.table.keys() - branch.table.keys()
    if not fresh or len(fresh) != len(gone) or not 3 <= len(branch.table) <= MOST_KEPT:
        return False
    if len(former.table) != len(branch.table) or former.num_facts < 2:
        return False
    return not former.shape.opaque and former.shape.width > 0 and not has_only_words(former)


def give_values(blueprint: Blueprint, branch: str, given: Mapping[str, Sequence[str]]) -> Blueprint:
    """Give states of an SB their facts in ``_states``, independent of their names.

    Facts in ``_states`` only count if every state has some. So states whose names carry facts get
    the same facts there. EditRefused if a value is empty, or if the states would have different
    numbers of facts.
    """
    found = branch_of(blueprint, branch)
    for state in given:
        existing(blueprint, Address(branch, state))
    wanted = {state: tuple(values) for state, values in given.items()}
    if all(found.facts(state) == values for state, values in wanted.items()):
        return blueprint
    for values in wanted.values():
        if not values or not all(value.strip() and value.isprintable() for value in values):
            raise EditRefused("a value needs a visible character", advice="Type each value.")
    there = {name: note.facts for name, note in found.notes.states.items() if note.facts}
    others = {**carried(found), **(there if found.shape.width == 0 else {})}
    counts = {len(facts) for state, facts in others.items() if state not in wanted}
    number = {len(values) for values in wanted.values()}
    if not found.shape.opaque and (len(counts | number) > 1):
        count = min(counts or number)
        raise EditRefused(
            f"the other states of {branch} have another number of facts",
            advice=f"Give {count} {'value' if count == 1 else 'values'}, with commas between.",
        )
    same = {state: facts for state, facts in others.items() if counts == number}
    draft = Draft(blueprint)
    table = draft.table(branch, "_states")
    for state, facts in {**same, **wanted}.items():
        table[state] = {**(table.get(state) or {}), "facts": list(facts)}
    return draft.done()


def _with_facts(former: StateBranch, after: Blueprint, branch: StateBranch) -> Blueprint:
    fresh = [state for state in branch.table if not _given(branch, state)]
    stay = any(_given(branch, state) for state in branch.table)
    if not stay or not fresh or any(state in former.table for state in fresh):
        return after
    count = former.shape.num_facts
    values = [tuple(sorted({*column, *_usual(column)})) for column in former.alphabet]
    taken = {note.facts for note in branch.notes.states.values()}
    free = (facts for facts in islice(product(*values), _TRIES) if facts not in taken)
    draft = Draft(after)
    for state in fresh:
        facts = next(free, tuple(column[0] for column in values))
        table = draft.table(branch.name, "_states")
        table[state] = {**(table.get(state) or {}), "facts": list(facts[:count])}
    return draft.done()


def _given(branch: StateBranch, state: str) -> bool:
    note = branch.state_note(state)
    return note is not None and bool(note.facts)


def _usual(column: tuple[str, ...]) -> tuple[str, ...]:
    return ("0", "1") if set(column) <= {"0", "1"} else ()
