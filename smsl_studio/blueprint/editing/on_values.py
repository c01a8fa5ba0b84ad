"""Keeps which value of a fact with a sub-SB counts as on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from smsl_studio.blueprint.editing.notes import change_notes
from smsl_studio.blueprint.model import Blueprint, StateBranch


class TurnedFact(NamedTuple):
    """A fact with a sub-SB whose states are on where they were off, or off where they were on.

    ``digit`` is that of the SB ``branch`` now. ``was`` and ``now`` are the values that count as on.
    """

    branch: str
    digit: int
    was: str
    now: str


def keep_on(before: Blueprint, after: Blueprint) -> Blueprint:
    """Return ``after`` in which the same value of each fact with a sub-SB counts as on.

    Without a word in ``_facts`` the values of all states decide that, so one new state could turn
    over a fact of all states. Nobody has asked for that, so the value is written.
    """
    for turned in turned_facts(before, after):
        key = turned.branch, str(turned.digit)
        after = change_notes(after, "_facts", {key: {"on": turned.was}})
    return after


def turned_facts(before: Blueprint, after: Blueprint) -> Iterator[TurnedFact]:
    """Yield the facts with sub-SBs that an edit has turned over without a word in ``_facts``."""
    for branch in after:
        former = before.branches.get(branch.name)
        if former is None or former is branch or former.shape.opaque or branch.shape.opaque:
            continue
        digits = {sub: digit for digit, sub in former.subs.items()}
        for digit, sub in branch.subs.items():
            note = branch.fact_note(digit)
            if sub not in digits or (note is not None and note.on is not None):
                continue
            was, now = former.on_value(digits[sub]), branch.on_value(digit)
            if was != now and (
                now in _values(former, digits[sub]) or was in _values(branch, digit)
            ):
                yield TurnedFact(branch.name, digit, was, now)


def _values(branch: StateBranch, digit: int) -> tuple[str, ...]:
    """The values of a digit in the states of an SB, none if it does not have the digit."""
    return branch.alphabet[digit] if 0 <= digit < len(branch.alphabet) else ()
