"""Any sequence of edits, typing, undo and redo in a session restores each earlier state exactly."""

from __future__ import annotations

import random
from functools import partial

import pytest

from smsl_studio.studio.document.session import Session
from tests.blueprint.histories import any_blueprint, as_read, stand
from tests.blueprint.test_any_edits import random_edit


def typed(chance: random.Random, text: str) -> str:
    """The text after somebody typed in it."""
    at = chance.randrange(len(text) + 1)
    end = at + chance.choice([0, 0, 1, 5])
    return text[:at] + chance.choice(["", " ", "x", "\n", "}", '"_a": 1,']) + text[end:]


def told(session: Session) -> tuple[str, dict[str, str], bool]:
    return stand(session.blueprint), session.texts, session.broken is not None


@pytest.mark.parametrize("part", range(5))
def test_a_history_of_edits_and_typing_is_exact(qapp: object, part: int) -> None:
    broken = 0
    for seed in range(part * 10, part * 10 + 10):
        chance = random.Random(seed)
        session = Session(any_blueprint(chance))
        seen = [told(session)]
        for _ in range(20):
            kind, at = chance.random(), session.history.index()
            if kind < 0.35:
                session.edit("Edit", partial(random_edit, chance))
            elif kind < 0.6:
                file, text = chance.choice(list(session.texts.items()))
                session.write("Type", typed(chance, text), file)
            elif kind < 0.85:
                session.history.undo()
            else:
                session.history.redo()
            if kind < 0.6 and session.history.index() > at:
                del seen[at + 1 :]
                seen.append(told(session))
                assert stand(as_read(session.blueprint)) == stand(session.blueprint)
            broken += session.broken is not None
            assert told(session) == seen[session.history.index()]
    assert broken
