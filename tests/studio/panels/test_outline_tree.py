"""The tree of the outline: little work for each of very many lines, and none that nobody sees."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.studio.panels.outline_lines import Line
from smsl_studio.studio.panels.outline_tree import OutlineTree
from smsl_studio.studio.theme import LIGHT
from tests.bombs.test_work import steps

LINES = [
    Line(0, f"B{at // 3}", None, f"B{at // 3}", "0")
    if at % 3 == 0
    else Line(1, f"B{at // 3}", at % 3, f"Fact {at % 3}", "")
    for at in range(900)
]


@pytest.fixture
def panel(qtbot: QtBot) -> QWidget:
    made = QWidget()
    qtbot.addWidget(made)
    return made


@pytest.fixture
def tree(panel: QWidget) -> OutlineTree:
    return OutlineTree(LIGHT, panel)


def test_each_line_takes_little_work(tree: OutlineTree) -> None:
    for _ in range(2):  # what Qt makes at the first use is no work of ours
        steps(lambda: tree.show_lines(LINES[:1]))
    assert steps(lambda: tree.show_lines(LINES)) <= 20 * len(LINES)
    assert steps(lambda: tree.show_lines(LINES)) <= 9 * len(LINES)
    tree.item_of("B0")
    assert steps(lambda: [tree.item_of(line.branch, line.digit) for line in LINES]) <= 6 * len(
        LINES
    )


def test_an_item_is_found_by_its_sb_and_fact_and_says_what_it_is(tree: OutlineTree) -> None:
    fault = Line(0, "", None, "gone.json", "not read", fault="There is no file gone.json.")
    tree.show_lines([*LINES, fault])
    found = tree.item_of("B7", 2)
    assert found is not None
    assert found is tree.items()[7 * 3 + 2]
    assert found.toolTip(0) == "Fact 2 of B7: Fact 2"
    assert tree.item_of("") is None
    assert tree.item_of("B300") is None


def test_what_was_closed_stays_closed_where_other_lines_come(tree: OutlineTree) -> None:
    tree.show_lines(LINES)
    tree.items()[3].setExpanded(False)
    tree.show_lines(LINES[:-1])
    assert [item.isExpanded() for item in tree.items()[::3]] == [at != 1 for at in range(300)]
