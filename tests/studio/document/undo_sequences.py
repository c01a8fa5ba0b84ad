"""Random sequences of what gestures do to a session, undone whole and redone whole.

Every gesture of the window ends in ``Session.edit`` with one of the edits, so all edits are drawn
here, also those of places, bends, notes and groups. Several may join to one step, as a drag or a
held arrow key does.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import partial

from smsl_studio.studio.document.session import Session
from tests.blueprint.histories import any_blueprint, stand
from tests.blueprint.test_any_edits import random_edit

LONGEST = 8
"""The most gestures of a sequence."""

Told = tuple[str, dict[str, str]]
"""A blueprint with all that belongs to it, and the texts of its files."""


def findings(first: int, last: int) -> Iterator[str]:
    """The sequences, by their numbers, that do not come back to the same bytes."""
    for number in range(first, last):
        chance = random.Random(number)
        session = Session(any_blueprint(chance))
        opened = told(session)
        for _ in range(chance.randrange(1, LONGEST + 1)):
            session.edit("Edit", partial(random_edit, chance), chance.choice([-1, -1, 1]))
        done, steps = told(session), session.history.count()
        session.history.setIndex(0)
        if told(session) != opened:
            yield f"sequence {number}: {steps} steps are undone, and it is not as it was opened"
        session.history.setIndex(steps)
        if told(session) != done:
            yield f"sequence {number}: {steps} steps are redone, and it is not as it was"


def told(session: Session) -> Told:
    """What a session has now."""
    return stand(session.blueprint), dict(session.texts)
