"""Adding and undoing frees everything: neither objects of ours nor widgets pile up."""

from __future__ import annotations

import gc
from collections import Counter

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QApplication

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

PAIRS = 12


def _add_and_undo(person: Person) -> None:
    person.window.actions_table["add_state"].trigger()
    person.press(Qt.Key.Key_Return)
    assert len(person.steps()) == 1
    person.window.actions_table["undo"].trigger()


def _alive(person: Person) -> Counter[str]:
    """How many objects of each of our classes there are, and of Qt's below the window."""
    person.until_inspected()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    kinds = (type(one) for one in gc.get_objects())
    # The module of a class that is made at run time may be anything.
    found = Counter(k.__name__ for k in kinds if str(k.__module__).startswith("smsl_studio"))
    found["QObject"] = len(person.window.findChildren(QObject))
    found["items of the scene"] = len(person.window.canvas.scene().items())
    return found


def test_a_state_that_is_added_and_undone_leaves_nothing_behind(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    for _ in range(3):
        _add_and_undo(person)
    before = _alive(person)
    assert before["Blueprint"]
    assert before["Sheet"]
    for _ in range(PAIRS):
        _add_and_undo(person)
    more = _alive(person) - before
    assert not {name: count for name, count in more.items() if count >= PAIRS}
