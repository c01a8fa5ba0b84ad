"""The section Layout of the selected operations: their bends, and where their labels are."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.lines.line import FormLine
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.draw.panels.frame import Panel

ADD = "Lead the line through one point more (B). You can also drag the line"


class LineForm(Panel):
    """Says how the lines of operations are drawn by hand, with the verbs that change it."""

    verb_wanted = Signal(str)
    """The id of a window action: add_bend, clear_bends, reset_label."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("Layout", parent)
        self.column.setContentsMargins(12, 0, 12, 12)
        self.column.setSpacing(6)
        words = label("never changes the meaning", "second")
        self.column.addLayout(row(label("Layout", "heading"), words, None))
        self.bends, self.label = Elided(), Elided()
        self.add = self._button("Add bend", "add_bend", ADD)
        self.clear = self._button("Clear bends", "clear_bends", "Remove all bends")
        self.reset = self._button("Reset label", "reset_label", "Put the label where there is room")
        tip = "Points through which the line leads. Drag a handle to move one"
        self._bends = FormLine("Bends", self.bends, tip, self.add, self.clear)
        tip = "Where the label stands. Drag it along its line, or beside it"
        self._label = FormLine("Label", self.label, tip, self.reset)
        self.column.addWidget(self._bends)
        self.column.addWidget(self._label)

    def show_operations(self, blueprint: Blueprint, edges: Sequence[Address]) -> None:
        """Show how the lines of these operations are drawn."""
        drawn = [_layout_of(blueprint, edge) for edge in edges]
        bends = sum(len(layout.bends) for layout in drawn)
        moved = sum(layout.label is not None for layout in drawn)
        one = len(edges) == 1
        where = edges[0].operation if one else counted(
            sum(bool(layout.bends) for layout in drawn), "operation")  # fmt: skip
        self.bends.setText(f"{bends} in {where}" if bends else "None")
        self.add.setVisible(one and not bends)
        self.clear.setVisible(bends > 0)
        words = "Moved by hand" if one else f"{moved} moved by hand"
        self.label.setText(words if moved else "Where there is room")
        self.reset.setVisible(moved > 0)
        for line, said in ((self._bends, self.bends), (self._label, self.label)):
            said.setAccessibleName(plain_text(f"{line.words}: {said.text()}"))

    def _button(self, words: str, verb: str, tip: str) -> QPushButton:
        button = QPushButton(words.split(maxsplit=1)[0])
        button.setAccessibleName(words)
        button.setToolTip(tip)
        button.clicked.connect(lambda: self.verb_wanted.emit(verb))
        return button


def _layout_of(blueprint: Blueprint, edge: Address) -> EdgeLayout:
    drawn = blueprint[edge.branch].notes.edges
    return drawn.get((edge.state, edge.operation), EdgeLayout())
