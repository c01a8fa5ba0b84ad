"""Seats: whether the roles of those who answered can fill the roles that a task needs."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.person_names import same_name


def seated(wanted: Sequence[str], given: Sequence[str], escalation: str = "") -> bool:
    """Return whether everyone in ``given`` gets a seat of their own among the roles ``wanted``.

    An empty role in ``wanted`` is a seat for anybody. A person with the role ``escalation`` may
    take any seat; an empty text means that there is no such role. All orders of seating are tried.
    """
    seats = [same_name(role) for role in wanted]
    persons = [same_name(role) for role in given]
    also = same_name(escalation)

    def seat(index: int, free: frozenset[int]) -> bool:
        """Return whether the persons from ``index`` on can take the free seats."""
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
