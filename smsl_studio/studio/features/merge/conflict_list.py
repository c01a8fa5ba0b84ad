"""The right side of the page: conflicts, what merged by itself, and what to do with the file."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QProgressBar,
    QPushButton,
    QScrollArea,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.merge import Conflict, Side
from smsl_studio.blueprint.merge.conflict import Path
from smsl_studio.blueprint.merge.sides import ALIKE, MINE, THEIRS, MergeSides, merged_groups
from smsl_studio.studio.base.controls import label, row, rule
from smsl_studio.studio.base.rows import RowsView
from smsl_studio.studio.base.theme import CONTROL, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.merge.conflict_card import ConflictCard
from smsl_studio.studio.features.merge.merged_rows import merged_rows
from smsl_studio.studio.features.merge.open_merge import OpenMerge
from smsl_studio.studio.features.merge.preview_sketch import PreviewSketch

WIDTH = 396
PREVIEW = 106
BY_SIDE = {MINE: "mine", THEIRS: "theirs", ALIKE: "alike"}
HINT = "Point at a version to see the findings that it would give."
MOST = 60
"""So many cards are shown at once; the others follow when these are chosen."""


class ConflictList(QWidget):
    """Cards of the conflicts. The first open one is selected at first."""

    taken = Signal(object, str)
    """(Conflict, version)"""
    previewed = Signal(object, str)
    """(Conflict, version, empty for none)"""
    selected = Signal(object)
    """Conflict"""
    merged_chosen = Signal(object)
    """tuple[Address]: a row of what merged by itself was clicked."""
    save_wanted = Signal()
    leave_wanted = Signal()

    def __init__(self, merge: OpenMerge, tokens: Tokens) -> None:
        super().__init__()
        self._merge, self._tokens = merge, tokens
        self.cards: list[ConflictCard] = []
        self._current: Conflict | None = None
        self._were_open: set[Path] = set()
        self._told: tuple[MergeSides, tuple[Conflict, ...]] | None = None
        split = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(self._upper_part())
        split.addWidget(self._merged_part())
        split.setStretchFactor(0, 3)
        split.setStretchFactor(1, 2)
        split.setSizes([600, 300])
        split.setChildrenCollapsible(False)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self._head())
        column.addWidget(rule())
        column.addWidget(split, 1)
        column.addWidget(rule())
        column.addLayout(self._foot())
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setMinimumWidth(320)

    def _head(self) -> QHBoxLayout:
        self._title, self._chosen = label("Conflicts", "heading"), label("", "small")
        self._bar = QProgressBar()
        self._bar.setTextVisible(False)
        self._bar.setFixedSize(64, 6)
        self._bar.setAccessibleName("Chosen conflicts")
        head = row(self._title, None, self._chosen, self._bar)
        head.setContentsMargins(14, 8, 14, 8)
        return head

    def _upper_part(self) -> QWidget:
        self._stack = QVBoxLayout()
        self._stack.setContentsMargins(0, 0, 0, 0)
        self._stack.setSpacing(0)
        self._more = label("", "small")
        self._more.setContentsMargins(14, 8, 14, 8)
        inner = QWidget()
        inner.setProperty("role", "panel")
        below = QVBoxLayout(inner)
        below.setContentsMargins(0, 0, 0, 0)
        below.setSpacing(0)
        below.addLayout(self._stack)
        below.addWidget(self._more)
        below.addStretch(1)
        self._scroll = QScrollArea()
        self._scroll.setWidgetResizable(True)
        self._scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._scroll.setAccessibleName("Conflicts")
        self._scroll.setWidget(inner)
        self.preview = label(HINT, "small")
        self.preview.setWordWrap(True)
        self.preview.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.preview.setContentsMargins(14, 8, 4, 8)
        self.drawing = PreviewSketch(self._tokens)
        shown = row(self.preview, self.drawing, spacing=0)
        shown.setContentsMargins(0, 0, 8, 0)
        shown.setStretch(0, 1)
        below_cards = QWidget()
        below_cards.setFixedHeight(PREVIEW)
        below_cards.setLayout(shown)
        upper = QWidget()
        over = QVBoxLayout(upper)
        over.setContentsMargins(0, 0, 0, 0)
        over.setSpacing(0)
        over.addWidget(self._scroll, 1)
        over.addWidget(rule())
        over.addWidget(below_cards)
        return upper

    def _merged_part(self) -> QWidget:
        part = QWidget()
        part.setProperty("role", "panel")
        self._merged_title = label("Merged by themselves", "heading")
        self._merged_sides = label("", "small")
        self.merged = RowsView(self._tokens, margin=14)
        self.merged.setAccessibleName("Merged by themselves")
        self.merged.clicked.connect(self._merged_clicked)
        self.merged.activated.connect(self._merged_clicked)
        column = QVBoxLayout(part)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        head = row(self._merged_title, None, self._merged_sides)
        head.setContentsMargins(14, 8, 14, 6)
        column.addLayout(head)
        column.addWidget(self.merged, 1)
        return part

    def _foot(self) -> QVBoxLayout:
        self._left = label("", "small")
        self._left.setWordWrap(True)
        self.leave, self.save = QPushButton("Leave it open"), QPushButton("Save merged file")
        self.leave.setToolTip("Go back to the drawing; open conflicts stay in the file")
        self.save.setProperty("role", "primary")
        for button in (self.leave, self.save):
            button.setMinimumHeight(CONTROL)
            button.setAutoDefault(False)
        self.leave.clicked.connect(self.leave_wanted)
        self.save.clicked.connect(self.save_wanted)
        column = QVBoxLayout()
        column.setContentsMargins(14, 8, 14, 12)
        column.setSpacing(8)
        column.addWidget(self._left)
        column.addLayout(row(self.leave, self.save))
        return column

    # What is shown.

    @property
    def current(self) -> Conflict | None:
        """The selected conflict."""
        return self._current

    @property
    def words(self) -> str:
        """The sentence above the buttons."""
        return self._left.text()

    def show_merge(self) -> None:
        """Show what is open and what was chosen."""
        merge = self._merge
        every = merge.conflicts
        were, self._were_open = self._were_open, {one.path for one in merge.open_ones}
        reopened = [one for one in merge.open_ones if one.path not in were] if were else []
        if len(reopened) == 1:
            # An undo opened it again.
            self._current = reopened[0]
        if self._current not in every:
            self._current = next(iter(merge.open_ones or every), None)
        self._show_cards(every)
        left, chosen = len(merge.open_ones), len(every) - len(merge.open_ones)
        self._title.setText(f"Conflicts {len(every):,}")
        self._chosen.setText(f"{chosen:,} of {len(every):,} chosen")
        self._bar.setRange(0, max(len(every), 1))
        self._bar.setValue(chosen)
        words = f"{counted(left, 'conflict')} to choose. Then the file can be saved."
        self._left.setText(words if left else "All conflicts are chosen. Save the merged file.")
        self.save.setEnabled(not left)
        self.save.setToolTip(tip_text(words if left else "Save the merged file (Ctrl+S)"))
        self.leave.setVisible(bool(left))

    def show_sides(self) -> None:
        """Show what merged by itself."""
        sides = self._merge.sides
        if sides is not None and not self._is_told(sides):
            self._told = sides, self._merge.conflicts
            groups = merged_groups(sides, self._merge.conflicts)
            number = sum(len(one.changes) for one in groups)
            title = "Merged by themselves"
            self._merged_title.setText(f"{title} {number:,}" if number else title)
            counts = dict.fromkeys(BY_SIDE, 0)
            for one in groups:
                counts[one.side] += len(one.changes)
            told = [f"{counts[side]:,} {words}" for side, words in BY_SIDE.items() if counts[side]]
            self._merged_sides.setText(", ".join(told))
            self.merged.show_rows(merged_rows(groups, sides))

    def _is_told(self, sides: MergeSides) -> bool:
        """Whether the list is that of these versions. Comparing large versions takes long."""
        return (
            self._told is not None
            and self._told[0] is sides
            and self._told[1] == self._merge.conflicts
        )

    def select(self, conflict: Conflict) -> None:
        """Select a conflict and scroll to its card."""
        self._current = conflict
        for card in self.cards:
            card.show_current(card.conflict == conflict)
            if card.conflict == conflict:
                self._scroll.ensureWidgetVisible(card, 0, 8)

    def show_preview(self, conflict: Conflict, words: str, side: Side | None = None) -> None:
        """Show what the choice of a version would give; empty text ends that.

        The words have a place of their own, so that no button moves away from the pointer.
        """
        every = self._merge.conflicts
        number = f"Conflict {every.index(conflict) + 1:,}. " if conflict in every else ""
        self.preview.setText(f"{number}{words}" if words else HINT)
        self.preview.setToolTip(tip_text(words))
        self.drawing.show_choice(conflict if words else None, side)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.merged.set_tokens(tokens)
        self.drawing.set_tokens(tokens)
        for card in self.cards:
            card.set_tokens(tokens)

    def _show_cards(self, every: tuple[Conflict, ...]) -> None:
        numbered = list(enumerate(every, start=1))
        # Open ones come first if there are too many for all to be shown.
        order = numbered if len(every) <= MOST else sorted(
            numbered, key=lambda one: not self._merge.is_open(one[1])
        )  # fmt: skip
        wanted = sorted(order[:MOST])
        if [(card.number, card.conflict) for card in self.cards] != wanted:
            for card in self.cards:
                self._stack.removeWidget(card)
                card.hide()
                card.deleteLater()
            self.cards = [self._card(conflict, number) for number, conflict in wanted]
        for card in self.cards:
            card.show_choice(self._merge.is_open(card.conflict), self._merge.side_of(card.conflict))
            card.show_current(card.conflict == self._current)
        # One card is whole in the lowest window, too; the page scrolls there.
        self._scroll.setMinimumHeight(self.cards[0].sizeHint().height() if self.cards else 0)
        rest = len(every) - len(wanted)
        self._more.setText(f"{rest:,} more follow when these are chosen" if rest else "")
        self._more.setVisible(bool(rest))

    def _card(self, conflict: Conflict, number: int) -> ConflictCard:
        card = ConflictCard(conflict, number, self._tokens)
        card.taken.connect(lambda side: self.taken.emit(conflict, side))
        card.previewed.connect(lambda side: self.previewed.emit(conflict, side))
        card.selected.connect(lambda: self.selected.emit(conflict))
        self._stack.addWidget(card)
        return card

    def _merged_clicked(self, index: object) -> None:
        found = self.merged.currentIndex().data(Qt.ItemDataRole.UserRole)
        if found is not None and found.payload:
            self.merged_chosen.emit(found.payload)
