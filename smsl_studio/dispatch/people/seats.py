"""Seats: whether the roles of those who answered can fill the roles that a task needs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from smsl_studio.blueprint.person_names import same_name


def seated(wanted: Sequence[str], given: Sequence[str], escalation: str = "") -> bool:
    """Return whether everyone in ``given`` gets a seat of their own among the roles ``wanted``.

    An empty role in ``wanted`` is a seat for anybody. A person with the role ``escalation`` may
    take any seat; an empty text means that there is no such role.
    """
    seats = [same_name(role) for role in wanted]
    also = same_name(escalation)
    persons = [same_name(role) for role in given]
    bound = Counter(role for role in persons if not also or role != also)
    own = bound & Counter(seat for seat in seats if seat)
    # Whoever finds no seat of the own role needs an open one.
    standing = bound.total() - own.total()
    return len(persons) <= len(seats) and standing <= seats.count("")
