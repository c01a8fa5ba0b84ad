"""States with plain names, such as Idle and Ready: their letters are no facts."""

from __future__ import annotations

import re
from itertools import islice, product

from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch

_WORD = re.compile(r"[^\W\d_]{2}")
_TRIES = 4096


def keep_plain_names(before: Blueprint, after: Blueprint) -> Blueprint:
    """Return ``after`` in which plain names that came with the edit are not read as facts.

    If only plain names stand in an SB now, and their letters would be read as facts, NUM_FACTS 0 is
    written. If all states had their facts in ``_states``, new ones get the next free values there.
    An SB in which names of letters carried facts before is left alone.
    """
    for branch in after:
        former = before.branches.get(branch.name)
        if former is branch or not branch.table:
            continue
        if former is not None and former.table and former.shape.width == 0:
            after = _with_facts(former, after, branch)
        if _became_facts(former, after[branch.name]):
            draft = Draft(after)
            draft.header(branch.name)["NUM_FACTS"] = 0
            after = draft.done()
    return after


def is_plain(name: str) -> bool:
    """Return whether a state's name looks like a word and not like a row of digits."""
    text = fact_string(name, None)
    if name.startswith("State"):
        return False
    return bool(_WORD.search(text)) or text[:1].isupper()


def _became_facts(former: StateBranch | None, branch: StateBranch) -> bool:
    """Return whether an edit made plain names of an SB be read as facts."""
    declared = branch.header.num_facts is not None or "NUM_FACTS" in branch.header.odd
    if declared or branch.notes.facts or branch.shape.width == 0:
        return False
    if not all(map(is_plain, branch.table)):
        return False
    told = former is not None and former.table and former.shape.width != 0
    return not (told and former is not None and all(map(is_plain, former.table)))


def _with_facts(former: StateBranch, after: Blueprint, branch: StateBranch) -> Blueprint:
    """Return the blueprint in which new states of an SB have facts in ``_states``, as the others
    have."""
    fresh = [state for state in branch.table if not _given(branch, state)]
    stay = any(_given(branch, state) for state in branch.table)
    if former.shape.opaque or not stay or any(state in former.table for state in fresh):
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
    return draft.done() if fresh else after


def _given(branch: StateBranch, state: str) -> bool:
    note = branch.state_note(state)
    return note is not None and bool(note.facts)


def _usual(column: tuple[str, ...]) -> tuple[str, ...]:
    return ("0", "1") if set(column) <= {"0", "1"} else ()
