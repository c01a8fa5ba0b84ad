"""What assistive tools find of lists, trees, tabs, and combo boxes."""

from __future__ import annotations

import gc
import sys
from typing import Any

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QModelIndex, QObject, QStringListModel
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import (
    QApplication,
    QListView,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.controls import Combo
from smsl_studio.studio.base.tabs import tab_bar
from smsl_studio.studio.shell.accessible_factory import install

NAME = QAccessible.Text.Name


def found(thing: QObject) -> Any:
    return QAccessible.queryAccessibleInterface(thing)


def children(thing: QObject) -> list[Any]:
    """The rows, lines or tabs; the heading of a tree is none."""
    above = found(thing)
    every = [above.child(at) for at in range(above.childCount())]
    assert None not in every
    return [one for one in every if one.role() != QAccessible.Role.ColumnHeader]


def names(thing: QObject) -> list[str]:
    return [one.text(NAME) for one in children(thing)]


class Page(QWidget):
    """A page with a list of three hundred rows, a tree, tabs and a combo box."""

    def __init__(self) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        self.rows, self.tree, self.tabs, self.combo = QListView(), QTreeWidget(), tab_bar(), Combo()
        self.rows.setModel(QStringListModel([f"Row {at}" for at in range(300)], self.rows))
        self.tree.setUniformRowHeights(True)
        for branch in ("A", "B"):
            above = QTreeWidgetItem(self.tree, [branch])
            for fact in "12":
                QTreeWidgetItem(above, [f"{branch}{fact}"])
        for name in ("Facts", "Library"):
            self.tabs.addTab(name)
        self.combo.addItems(["State0", "State1"])
        self.combo.setAccessibleName("Initial state")
        self.parts = (self.rows, self.tree, self.tabs, self.combo)
        for part in self.parts:
            column.addWidget(part)
        self.resize(300, 500)

    def focused(self) -> list[str]:
        """The names of everything in the parts that says that it has the keyboard focus."""
        everything = [one for part in self.parts for one in (found(part), *children(part))]
        return [one.text(NAME) for one in everything if one.state().focused]


@pytest.fixture
def page(qtbot: QtBot, qapp: QApplication) -> Page:
    install(qapp)
    made = Page()
    qtbot.addWidget(made)
    made.show()
    qtbot.waitExposed(made)
    made.activateWindow()
    qtbot.waitUntil(made.isActiveWindow)
    return made


def test_all_rows_of_a_list_are_found_and_none_is_hidden(page: Page) -> None:
    rows = children(page.rows)
    assert [one.text(NAME) for one in rows] == [f"Row {at}" for at in range(300)]
    assert not any(one.state().invisible for one in rows)
    assert not rows[0].state().offscreen
    assert rows[-1].state().offscreen
    assert [found(page.rows).indexOfChild(one) for one in rows] == list(range(300))
    place = rows[1].rect().center()
    assert found(page.rows).childAt(place.x(), place.y()).text(NAME) == "Row 1"
    pressed: list[QModelIndex] = []
    page.rows.clicked.connect(pressed.append)
    rows[299].doAction("Press")
    assert [one.row() for one in pressed] == [299]
    assert rows[299].state().selected
    page.rows.hide()
    assert all(one.state().invisible for one in rows)


def test_a_row_with_other_words_is_another_row(page: Page) -> None:
    rows = children(page.rows)
    model = page.rows.model()
    model.setData(model.index(1, 0), "Other")
    assert names(page.rows)[:3] == ["Row 0", "Other", "Row 2"]
    assert [one.isValid() for one in rows[:3]] == [True, False, True]
    assert children(page.rows)[0] is rows[0]
    model.removeRows(2, 298)
    assert names(page.rows) == ["Row 0", "Other"]
    assert not any(one.isValid() for one in rows[1:])
    assert rows[5].rect().isEmpty()


def test_a_reader_may_ask_by_its_number_for_a_row_that_is_gone(page: Page) -> None:
    """Qt keeps the number, and a pointer: Python must not free what it points to."""
    model = page.rows.model()
    number = QAccessible.uniqueId(found(page.rows).child(1))
    model.setData(model.index(1, 0), "Other")
    assert names(page.rows)[1] == "Other"
    gc.collect()
    assert not QAccessible.accessibleInterface(number).isValid()


def test_the_lines_of_a_tree_are_found_and_opened(page: Page) -> None:
    tree = page.tree
    assert names(tree) == ["A", "B"]
    first = children(tree)[0]
    assert (first.state().expandable, first.state().expanded) == (True, False)
    first.doAction("Expand")
    assert tree.isExpanded(tree.model().index(0, 0))
    assert names(tree) == ["A", "A1", "A2", "B"]
    first = children(tree)[0]
    assert first.state().expanded
    assert "Collapse" in first.actionNames()
    inner = children(tree)[1]
    assert not inner.state().expandable
    inner.doAction("Press")
    assert tree.currentIndex().data() == "A1"
    tree.expandAll()
    assert names(tree) == ["A", "A1", "A2", "B", "B1", "B2"]
    # Qt numbers the lines from 1 in the events that it sends.
    assert [found(tree).indexOfChild(one) for one in children(tree)] == [1, 2, 3, 4, 5, 6]
    tree.clear()
    assert names(tree) == []


def test_one_thing_has_the_keyboard_focus(page: Page) -> None:
    page.rows.setCurrentIndex(page.rows.model().index(2, 0))
    page.tree.setCurrentIndex(page.tree.model().index(1, 0))
    for part, name in ((page.rows, "Row 2"), (page.tree, "B"), (page.tabs, "Facts")):
        part.setFocus()
        assert page.focused() == [name]
        focus = found(part).focusChild()
        assert focus is not None
        assert focus.text(NAME) == name
    page.combo.setFocus()
    assert len(page.focused()) == 1
    page.rows.setFocus()
    page.rows.setCurrentIndex(QModelIndex())
    assert page.focused() == [""], "the list itself"


def test_tabs_say_the_numbers_on_them(page: Page) -> None:
    tabs = children(page.tabs)
    assert [one.text(NAME) for one in tabs] == ["Facts", "Library"]
    assert found(page.tabs).text(NAME) == "Facts"
    tabs[1].doAction("Press")
    assert page.tabs.currentIndex() == 1
    assert [one.state().selected for one in children(page.tabs)] == [False, True]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="others tell the entry apart")
def test_a_combo_box_is_named_by_what_it_chooses(page: Page) -> None:
    assert found(page.combo).text(NAME) == "Initial state: State0"
    page.combo.setCurrentIndex(1)
    assert found(page.combo).text(NAME) == "Initial state: State1"
    assert found(page.combo).text(QAccessible.Text.Value) == "State1"
    entries = found(page.combo).child(0)
    assert [entries.child(at).text(NAME) for at in range(2)] == ["State0", "State1"]


def test_what_is_gone_is_not_asked(page: Page) -> None:
    """A reader keeps the rows that it was told."""
    kept = [found(part).child(1) for part in (page.rows, page.tree, page.tabs)]
    assert all(one.isValid() for one in kept)
    for part in page.parts:
        part.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    for one in kept:
        assert not one.isValid()
        assert one.rect().isEmpty()
        assert one.state().invisible
        assert not one.actionNames()
