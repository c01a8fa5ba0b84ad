"""Tabs of panels: their words are whole."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.tabs import Tabs


def test_no_tab_is_cut_after_a_number_came_while_they_were_hidden(qtbot: QtBot) -> None:
    tabs = Tabs()
    qtbot.addWidget(tabs)
    for name in ("Findings", "Inspection", "History", "Table"):
        tabs.add(name, QWidget())
    tabs.resize(800, 200)
    tabs.show()
    qtbot.waitUntil(lambda: tabs.bar.width() == tabs.bar.sizeHint().width())
    tabs.hide()
    tabs.set_count("Findings", 12)
    tabs.show()
    qtbot.waitUntil(lambda: tabs.bar.width() >= tabs.bar.sizeHint().width())
    last = tabs.bar.tabRect(tabs.bar.count() - 1)
    assert tabs.bar.rect().contains(last)
