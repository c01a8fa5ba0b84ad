"""Seats: whether the roles of those who answered can be the roles a task asks for."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.dispatch.people.names import same_name


def seated(wanted: Sequence[str], given: Sequence[str], escalation: str = "") -> bool:
    """Whether everyone in ``given`` finds a seat of their own among the roles ``wanted``.

    A seat without a role is anybody's; the ``escalation`` role (empty: there is none) may take
    any. Nobody is turned away as long as some order of seating leaves room for all.
    """
    seats = [same_name(role) for role in wanted]
    persons = [same_name(role) for role in given]
    also = same_name(escalation)

    def seat(index: int, free: frozenset[int]) -> bool:
        """Whether the persons from ``index`` on can be seated in the seats that are free."""
        if index == len(persons):
            return True
        role = persons[index]
        jumps = bool(also) and role == also
        return any(
            seat(index + 1, free - {one})
            for one in sorted(free)
            if jumps or not seats[one] or seats[one] == role
        )

    return len(persons) <= len(seats) and seat(0, frozenset(range(len(seats))))
