"""Facts for a new state in ``_states``, if all other states have their facts there."""

from __future__ import annotations

from itertools import islice, product

from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.model import Blueprint, StateBranch

_TRIES = 4096


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
