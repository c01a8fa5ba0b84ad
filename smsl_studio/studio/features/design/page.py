"""The page Design cycle: the board of nine stages, and the chosen one at the right."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.design.cycle import DesignCycle
from smsl_studio.front.design.generation import NewGeneration
from smsl_studio.front.design.stages import FSM
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.design.board import StageBoard
from smsl_studio.studio.features.design.generation_bar import GenerationBar
from smsl_studio.studio.features.design.sections import sections_of
from smsl_studio.studio.features.design.side import StageSide
from smsl_studio.studio.running.frames import split

BOARD, SIDE = 884, 340
"""The width of the board with four cards in a row, and the least width of the side (pixels)."""


class CyclePage(QWidget):
    """Shows a design cycle. It finds nothing out and changes nothing by itself."""

    looked_at = Signal(bool)
    """bool: whether the page is seen now."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.setAccessibleName("Design cycle")
        self.cycle: DesignCycle | None = None
        self.new: NewGeneration | None = None
        """A generation that waits until somebody takes it."""
        self.number = FSM
        self._blueprint: Blueprint | None = None
        self.board, self.side, self.bar = StageBoard(tokens), StageSide(tokens), GenerationBar()
        self.side.bar.addWidget(self.bar)
        self.area = QScrollArea()
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setWidgetResizable(True)
        self.area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.area.setWidget(self.board)
        self.area.setMinimumWidth(self.board.minimumWidth())
        self._whole = split(
            Qt.Orientation.Horizontal, (self.area, self.side), (BOARD, SIDE), (0, 1)
        )
        self._whole.splitterMoved.connect(lambda *_: self._let_be())
        self._is_placed = False
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(self._whole)
        self.board.chosen.connect(self.choose)
        self.board.next.chosen.connect(self.choose)
        self.board.choose(self.number)
        self.setFocusProxy(self.board.cards[self.number - 1])

    def show_cycle(self, cycle: DesignCycle, blueprint: Blueprint) -> None:
        """Show another design cycle. The same stage stays chosen."""
        self.cycle, self._blueprint = cycle, blueprint
        self.board.show_cycle(cycle)
        self.refresh()

    def choose(self, number: int) -> None:
        """Show a stage at the right."""
        self.number = number
        self.board.choose(number)
        card = self.board.cards[number - 1]
        self.area.ensureWidgetVisible(card, 8, 8)
        self.setFocusProxy(card)
        self.refresh()

    def refresh(self) -> None:
        """Show the chosen stage as it is now."""
        if self.cycle is None or self._blueprint is None:
            return
        waiting = self.new.changes if self.new is not None and self.new.is_whole else None
        sections = sections_of(self.cycle, self.number, self._blueprint, waiting)
        self.side.show_stage(self.cycle.stage(self.number), sections)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.board.set_tokens(tokens)
        self.side.set_tokens(tokens)

    def _let_be(self) -> None:
        """Leave the widths alone, because a person has chosen them."""
        self._is_placed = True

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the board the room of four cards, as long as nobody has chosen another width."""
        super().resizeEvent(event)
        if not self._is_placed:
            board = min(BOARD, max(self.area.minimumWidth(), self.width() - SIDE))
            self._whole.setSizes([board, self.width() - board])

    def showEvent(self, event: QShowEvent) -> None:
        """Tell that the page is seen."""
        super().showEvent(event)
        self.looked_at.emit(True)

    def hideEvent(self, event: QHideEvent) -> None:
        """Tell that the page is not seen any more."""
        super().hideEvent(event)
        self.looked_at.emit(False)
