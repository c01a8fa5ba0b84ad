"""The card that tells what a pasted table brings, and asks for a yes."""

from __future__ import annotations

from dataclasses import dataclass, replace

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QKeyEvent

from smsl_studio.blueprint.editing.pasted_table import PastedTable, read_states
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import EditRefused
from smsl_studio.studio.base.canvas.branch_view import TOP
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.overlays.change_card import ChangeCard
from smsl_studio.studio.base.words import counted, refusal_words, series
from smsl_studio.studio.features.draw.canvas.free_places import place_near

WIDTH = 340


@dataclass(frozen=True)
class TablePaste:
    """A table that waits for a yes. ``fault`` says why it cannot be pasted. ``under_way`` says that
    it is being pasted.
    """

    text: str
    sentence: str
    lines: tuple[str, ...] = ()
    fault: str = ""
    verb: str = "Paste"
    under_way: bool = False

    @property
    def ready(self) -> bool:
        """Whether it can be pasted."""
        return not self.fault and not self.under_way

    def begun(self) -> TablePaste:
        """The same while it is being pasted."""
        sentence = "The table is being pasted. Cancel calls it off, and nothing is changed."
        return replace(self, sentence=sentence, under_way=True)


def table_paste(branch: StateBranch, text: str) -> TablePaste:
    """What a table would bring to an SB."""
    try:
        table = read_states(branch, text)
    except EditRefused as error:
        fault = refusal_words(error)
        return TablePaste(text, fault, fault=fault)
    if not (table.states or table.operations):
        fault = f"{branch.name} has all states and operations of the table already."
        return TablePaste(text, fault, fault=fault)
    return TablePaste(text, _words(branch, table), _lines(table))


def _words(branch: StateBranch, table: PastedTable) -> str:
    new = [counted(len(table.states), "new state")] if table.states else []
    new += [counted(len(table.operations), "new operation")] if table.operations else []
    words = f"The table brings {series(new)} to {branch.name}."
    if table.known:
        words += f" {counted(table.known, 'operation is', 'operations are')} there already."
    return words


def _lines(table: PastedTable) -> tuple[str, ...]:
    alone = set(table.states)
    for row in table.operations:
        alone -= {row.state, row.target}
    edges = [f"{row.state}: {row.operation} → {row.target}" for row in table.operations]
    return (*edges, *(state for state in table.states if state in alone))


class TableCard(ChangeCard):
    """The card of a pasted table, at the top of the canvas. A press on the canvas closes it."""

    def __init__(self, canvas: Canvas) -> None:
        super().__init__("Pasted table", canvas)
        self._canvas = canvas
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        self.setFixedWidth(WIDTH)
        canvas.pressed.connect(self.close_card)
        self.closed.connect(canvas.setFocus)

    def show_paste(self, paste: TablePaste) -> None:
        """Tell what a table brings."""
        self.propose(paste)
        place_near(self, self._canvas, QPoint((self._canvas.width() - WIDTH) // 2, TOP + 8))
        self.raise_()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Keep keys from the canvas below, where Del would delete the selection."""
        super().keyPressEvent(event)
        event.accept()
