"""The tables of the window for assistive tools: every cell and every heading has a text."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import QModelIndex, Qt
from PySide6.QtGui import QAccessible, QStandardItemModel
from PySide6.QtWidgets import QLineEdit, QTableView, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.front.views.fact_rows import FactRow
from smsl_studio.front.views.monitor_rows import COLUMNS, FACT, MonitorRow
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.theme import DARK
from smsl_studio.studio.features.monitor.table import MonitorTable
from smsl_studio.studio.features.people.level_rows import LevelRow
from smsl_studio.studio.features.people.level_table import LevelModel, LevelTable
from smsl_studio.studio.running.facts_table import FactsTable


def facts() -> QTableView:
    table = FactsTable(DARK)
    table.show_rows((
        FactRow("SB1", "State100", "", None, "believed", "", group=True),
        FactRow("Fact 2", "0", "", None, "believed", "follows SB2, State0", sub=True),
    ))  # fmt: skip
    return table


def levels() -> QTableView:
    model = LevelModel()
    table = LevelTable(model)
    model.setParent(table)
    model.show_rows((LevelRow("key", "layer", "Strategy", "", (), "default"),))
    return table


def monitored() -> QTableView:
    table = MonitorTable(DARK)
    cells = ("Fact 1", *[""] * (len(COLUMNS) - 1))
    table.show_rows((MonitorRow(FACT, ("SB1", "1"), cells, "believed"),))
    return table


@pytest.mark.parametrize("make", [facts, levels, monitored])
def test_blank_cells_have_a_text_for_assistive_tools(
    make: Callable[[], QTableView], qtbot: QtBot
) -> None:
    table = make()
    qtbot.addWidget(table)
    read = QAccessible.queryAccessibleInterface(table)
    # The first is the corner between the heads.
    heard = [read.child(at).text(QAccessible.Text.Name) for at in range(1, read.childCount())]
    assert all(heard), heard
    model = table.model()
    rows, columns = model.rowCount(QModelIndex()), model.columnCount(QModelIndex())
    assert len(heard) == (rows + 1) * (columns + 1) - 1
    shown = [model.index(rows - 1, at).data(Qt.ItemDataRole.DisplayRole) for at in range(columns)]
    assert "" in shown


def focused(table: QTableView) -> list[str]:
    """The names of the parts of a table that say that they have the keyboard focus."""
    read = QAccessible.queryAccessibleInterface(table)
    parts = [read, *(read.child(at) for at in range(read.childCount()))]
    return [one.text(QAccessible.Text.Name) for one in parts if one.state().focused]


@pytest.mark.parametrize("make", [facts, levels, monitored])
def test_a_cell_has_the_focus_only_while_its_table_has_it(
    make: Callable[[], QTableView], qtbot: QtBot
) -> None:
    page, table, field = QWidget(), make(), QLineEdit()
    qtbot.addWidget(page)
    column = QVBoxLayout(page)
    for part in (table, field):
        column.addWidget(part)
    page.show()
    page.activateWindow()
    qtbot.waitUntil(page.isActiveWindow)
    table.setFocus()
    last = table.model().index(table.model().rowCount() - 1, 0)
    table.setCurrentIndex(last)
    chosen = table.selectedIndexes()
    words = last.data(Qt.ItemDataRole.AccessibleTextRole) or last.data()
    assert words in focused(table)
    field.setFocus()
    assert focused(table) == []
    assert table.selectedIndexes() == chosen
    table.setFocus()
    assert table.currentIndex() == last
    assert words in focused(table)


def test_what_is_chosen_without_the_focus_is_told_and_stays(qtbot: QtBot) -> None:
    table, field = QTableView(), QLineEdit()
    model = QStandardItemModel(3, 1, table)
    table.setModel(model)
    table.setSelectionBehavior(QTableView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QTableView.SelectionMode.SingleSelection)
    cell = CurrentCell(table)
    for part in (table, field):
        qtbot.addWidget(part)
    told: list[int] = []
    table.selectionModel().currentChanged.connect(lambda now, before: told.append(now.row()))
    for row in (1, 1, 2):
        cell.choose(model.index(row, 0))
        assert cell.index.row() == row
        assert [one.row() for one in table.selectedIndexes()] == [row]
        assert not table.currentIndex().isValid()
    cell.choose(QModelIndex())
    assert not cell.index.isValid()
    assert table.selectedIndexes() == []
    assert told == [1, 2, -1]
    cell.choose(model.index(1, 0))
    model.removeRow(1)
    assert not cell.index.isValid()
