"""The text of the active state beside the partial view, read only: the proposed line is marked."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QBrush, QIcon, QPixmap
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.partial import PartialView
from smsl_studio.front.views.state_text import StateTexts
from smsl_studio.legible import plain_text
from smsl_studio.smsl.document import WORDS
from smsl_studio.studio.base.controls import Elided, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.frames import HEAD

LONGEST = 240
"""So many characters of a line are shown."""
LEAST = 96
"""The smallest height (pixels)."""
ADDRESS = Qt.ItemDataRole.UserRole


def _blank() -> QIcon:
    """An icon that is not seen, so that all lines begin at the same place."""
    pixels = QPixmap(12, 12)
    pixels.fill(Qt.GlobalColor.transparent)
    return QIcon(pixels)


class TextPanel(QWidget):
    """Shows the lines of the active state. A click on an operation chooses it; nothing is
    edited here."""

    chosen = Signal(object)
    """Address: the person clicked on the line of this operation."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._texts: tuple[Blueprint, StateTexts] | None = None
        self._told: object = None
        self._marked: QListWidgetItem | None = None
        self._form = 0
        self._changing: dict[str, str] = {}
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Text of the active state")
        self.setMinimumHeight(LEAST)
        self.tabs = [QToolButton(), QToolButton()]
        for at, tab in enumerate(self.tabs):
            tab.setProperty("role", "branch")
            tab.setCheckable(True)
            tab.clicked.connect(lambda _=False, at=at: self._turn(at))
        self.words = Elided()
        self.words.setProperty("role", "small")
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        head = QWidget()
        head.setFixedHeight(HEAD)
        across = row(*self.tabs, self.words)
        across.setStretchFactor(self.words, 1)
        across.setContentsMargins(8, 0, 12, 0)
        head.setLayout(across)
        self.list = QListWidget()
        self.list.setFrameShape(QFrame.Shape.NoFrame)
        self.list.setFont(mono_font(12))
        self.list.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.list.setUniformItemSizes(True)
        self.list.setIconSize(QSize(12, 12))
        self.list.setAccessibleName("Lines of the active state")
        self.list.itemClicked.connect(self._choose)
        self.list.itemActivated.connect(self._choose)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(head)
        column.addWidget(self.list, 1)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens, self._told = tokens, None

    def show_changing(self, changing: dict[str, str]) -> None:
        """Mark the lines of these operations of the active state. Each has words for the tip: which
        chosen fact it changes. They are seen with the next ``show_state``."""
        self._changing = changing

    def show_state(
        self,
        blueprint: Blueprint | None,
        view: PartialView | None,
        subject: Address | None,
        at_work: bool,
    ) -> None:
        """Show the active state of a view. ``subject`` is the operation that is proposed, chosen,
        or ``at_work``."""
        told = (
            blueprint and id(blueprint), view and (view.branch, view.state), subject, at_work,
            self._form, tuple(self._changing.items()),
        )  # fmt: skip
        if not self.isVisible() or told == self._told:
            return
        self._told = told
        self.list.clear()
        self._marked = None
        if blueprint is None or view is None:
            self.words.setText("Starts with the run")
            return
        if self._texts is None or self._texts[0] is not blueprint:
            self._texts = (blueprint, StateTexts(blueprint))
        texts = self._texts[1]
        forms = texts.forms(view.branch)
        for at, (tab, form) in enumerate(zip(self.tabs, forms, strict=True)):
            tab.setText(WORDS[form])
            tab.setChecked(at == self._form)
        found = texts.lines(view.branch, view.state, forms[self._form])
        where = f"{view.state}, " if found.lines else ""
        self.words.setText(plain_text(f"{where}{found.words}"))
        for line in found.lines:
            edge = Address(view.branch, view.state, line.operation) if line.operation else None
            self._add(f"{line.number:>4}  {line.text}", edge, edge == subject, at_work)
        if self._marked is not None:
            # In the middle, because a low list may cut its last line.
            self.list.scrollToItem(self._marked, QListWidget.ScrollHint.PositionAtCenter)

    def _add(self, words: str, edge: Address | None, marked: bool, at_work: bool) -> None:
        item = QListWidgetItem(plain_text(words[:LONGEST].replace("\t", "    ")))
        item.setData(ADDRESS, edge)
        item.setFlags(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable)
        marked = marked and edge is not None
        item.setIcon(icon("play", self._tokens, 12, self._tokens.acc) if marked else _blank())
        if marked:
            said = "running" if at_work else "proposed"
            item.setBackground(QBrush(self._tokens.accs))
            item.setToolTip(tip_text(f"{edge} is {said}"))
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{plain_text(words)}, {said}")
        elif edge is not None and edge.operation in self._changing:
            said = self._changing[edge.operation]
            item.setIcon(icon("layers", self._tokens, 12, self._tokens.acc))
            item.setBackground(QBrush(self._tokens.sunk))
            item.setToolTip(tip_text(f"{edge} {said}"))
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{plain_text(words)}, {said}")
        self.list.addItem(item)
        if marked:
            self._marked = item

    def _choose(self, item: QListWidgetItem) -> None:
        edge = item.data(ADDRESS)
        if edge is not None:
            self.chosen.emit(edge)

    def _turn(self, at: int) -> None:
        self._form = at
        for number, tab in enumerate(self.tabs):
            tab.setChecked(number == at)
        self.turned.emit()

    turned = Signal()
    """A person chose another form of the text. The lines must be shown again in it."""
