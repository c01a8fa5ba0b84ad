"""Parts of the accessible tree go when what they tell of is gone, and never while Qt needs them."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from functools import partial
from typing import Any
from weakref import ref

import pytest
from PySide6.QtCore import QEventLoop, QStringListModel, QTimer
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QApplication, QListView
from pytestqt.qtbot import QtBot
from shiboken6 import isValid

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import rename
from smsl_studio.studio.base.canvas import accessible_held
from smsl_studio.studio.base.canvas.accessible_held import HELD
from smsl_studio.studio.shell.accessible_factory import install
from tests.stories.at_canvas import Drawer, sample

NAME = QAccessible.Text.Name
STATE = Address("SB1", "State_aa")
FEW = 40
"""So few parts make it look whether some are gone, in place of some hundred."""


class Reading(Drawer):
    """A canvas that is drawn on while a reader walks through it again and again."""

    def walk(self) -> list[str]:
        """The words of all parts; a reader is given the numbers of all of them."""
        tree: Any = QAccessible.queryAccessibleInterface(self.canvas)
        states = [tree.child(at) for at in range(tree.childCount())]
        parts = [*states, *(one.child(at) for one in states for at in range(one.childCount()))]
        self.numbers = [QAccessible.uniqueId(one) for one in parts]
        return [one.text(NAME) for one in parts]

    def first(self) -> Any:
        """What a reader is given for the first operation."""
        tree: Any = QAccessible.queryAccessibleInterface(self.canvas)
        return tree.child(0).child(0)

    def rename_first(self, name: str) -> None:
        """Give the first operation another name."""
        operation = next(iter(self.session.blueprint["SB1"].table[STATE.state]))
        at = Address(STATE.branch, STATE.state, operation)
        self.session.edit("Rename", lambda blueprint: rename(blueprint, at, name))


@pytest.fixture
def reading(qtbot: QtBot, qapp: QApplication, monkeypatch: pytest.MonkeyPatch) -> Iterator[Reading]:
    install(qapp)
    HELD.let_go()
    monkeypatch.setattr(accessible_held, "LEAST", FEW)
    HELD.let_go()
    yield Reading(qtbot, sample("hanoi-2.json"))
    HELD.let_go()


def test_parts_are_bounded_while_somebody_reads_and_draws(reading: Reading) -> None:
    reading.walk()
    HELD.let_go()
    most = 2 * len(HELD) + 2 * len(reading.walk())
    for number in range(100):
        reading.rename_first(f"op {number}")
        assert reading.first().text(NAME).startswith(f"op {number},")
        QApplication.processEvents()
    assert len(HELD) <= most


def test_a_reader_that_asks_for_a_part_that_was_let_go_is_told_that_it_is_gone(
    reading: Reading,
) -> None:
    operation = reading.first()
    number, went = QAccessible.uniqueId(operation), ref(operation)
    reading.rename_first("other")
    assert not QAccessible.accessibleInterface(number).isValid()
    del operation
    HELD.let_go()
    gc.collect()
    assert QAccessible.accessibleInterface(number) is None
    assert went() is None
    assert reading.first().text(NAME).startswith("other,")


def test_parts_that_are_there_stay_with_their_numbers(reading: Reading) -> None:
    before, numbers = reading.walk(), reading.numbers
    reading.rename_first("other")
    HELD.let_go()
    gc.collect()
    after = reading.walk()
    stayed = [(a, n) for a, n in zip(before, numbers, strict=True) if a in after]
    assert len(stayed) == len(before) - 1
    again = zip(after, reading.numbers, strict=True)
    assert [one for one in again if one[0] in before] == stayed


def test_a_part_that_comes_again_is_another_one(reading: Reading) -> None:
    """An edit and its undo: whoever holds the first part does not get it again."""
    held = reading.first()
    name = held.text(NAME)
    reading.rename_first("other")
    HELD.let_go()
    reading.session.history.undo()
    assert not isValid(held)
    assert reading.first() is not held
    assert reading.first().text(NAME) == name


def test_nothing_is_let_go_while_a_part_does_something(reading: Reading) -> None:
    """A menu has an event loop of its own, and Qt goes on with the part after it."""
    operation = reading.first()
    seen: list[bool] = []

    def menu(address: Address, at: object) -> None:
        loop = QEventLoop()
        QTimer.singleShot(0, partial(reading.rename_first, "other"))
        QTimer.singleShot(0, HELD.let_go)
        QTimer.singleShot(0, loop.quit)
        loop.exec()
        seen.append(isValid(operation))

    reading.canvas.context_wanted.connect(menu)
    operation.doAction("ShowMenu")
    assert seen == [True]
    assert not operation.isValid()
    HELD.let_go()
    assert not isValid(operation)


def test_the_rows_of_a_list_that_is_filled_anew_are_let_go(qtbot: QtBot, reading: Reading) -> None:
    rows = QListView()
    qtbot.addWidget(rows)
    model = QStringListModel(["one", "two"], rows)
    rows.setModel(model)
    tree: Any = QAccessible.queryAccessibleInterface(rows)
    HELD.let_go()
    before, number = len(HELD), QAccessible.uniqueId(tree.child(0))
    for at in range(5):
        model.setStringList([f"row {at}"])
        assert tree.child(0).text(NAME) == f"row {at}"
    HELD.let_go()
    assert len(HELD) == before + 1
    assert QAccessible.accessibleInterface(number) is None
