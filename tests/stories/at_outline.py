"""The outline as a person uses it: what it shows, and where to click on it."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex
from PySide6.QtTest import QTest

from smsl_studio.studio.features.draw.panels.outline_lines import OutlineLine
from smsl_studio.studio.features.draw.panels.outline_nodes import OutlineNodes
from smsl_studio.studio.features.draw.panels.outline_tree import OutlineTree, line_of
from tests.stories.person import LEFT


def shown(tree: OutlineTree) -> list[QModelIndex]:
    """Every line that one can scroll to, from top to bottom; what is closed is left out."""
    found = []
    index = tree.lines.index(0, 0)
    while index.isValid():
        found.append(index)
        index = tree.indexBelow(index)
    return found


def lines(tree: OutlineTree) -> list[OutlineLine]:
    """What these lines are."""
    return [line_of(index) for index in shown(tree)]


def texts(tree: OutlineTree) -> list[str]:
    """What these lines say."""
    return [line.text for line in lines(tree)]


def everything(nodes: OutlineNodes) -> list[tuple[int, OutlineLine]]:
    """Every line of a small blueprint, open or closed, with how many stand above it."""
    stack = [(0, node) for node in reversed(nodes.top)]
    found = []
    while stack:
        above, node = stack.pop()
        found.append((above, nodes.line(node, {})))
        stack += [(above + 1, below) for below in reversed(nodes.below(node))]
    return found


def click_line(tree: OutlineTree, text: str) -> None:
    """Click the first line that says this."""
    index = shown(tree)[texts(tree).index(text)]
    QTest.mouseClick(tree.viewport(), LEFT, pos=tree.visualRect(index).center())
