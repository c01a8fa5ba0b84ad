"""The tables of the window for assistive tools: every cell and every heading has a text."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import QModelIndex, Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QTableView
from pytestqt.qtbot import QtBot

from smsl_studio.front.views.fact_rows import FactRow
from smsl_studio.front.views.monitor_rows import COLUMNS, FACT, MonitorRow
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
