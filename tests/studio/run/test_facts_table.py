"""The table of facts for those who hear it."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from pytestqt.qtbot import QtBot

from smsl_studio.studio.run.facts_table import FactRow, FactsTable
from smsl_studio.studio.theme import DARK


def test_a_blank_cell_is_heard(qtbot: QtBot) -> None:
    table = FactsTable(DARK)
    qtbot.addWidget(table)
    table.show_rows((
        FactRow("SB1", "State100", "", None, "believed", "", group=True),
        FactRow("Fact 1", "1", "1", 0.0, "agrees", "agrees"),
        FactRow("Fact 2", "0", "", None, "believed", "follows SB2, State0", sub=True),
    ))  # fmt: skip
    read = QAccessible.queryAccessibleInterface(table)
    heard = [read.child(at).text(QAccessible.Text.Name) for at in range(1, read.childCount())]
    assert all(heard), heard
    assert heard[-5:] == ["Fact 2", "0", "none", "none", "follows SB2, State0"]
    shown = table.facts.index(2, 2).data(Qt.ItemDataRole.DisplayRole)
    assert shown == ""
