"""The compare view: both sides with linked views, above the list of changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut, QShowEvent
from PySide6.QtWidgets import (
    QDialog,
    QPushButton,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import Difference
from smsl_studio.blueprint.comparison.signs import signs_of
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.legible import plain_text
from smsl_studio.picture.aligned import branch_pairs, changed_pairs, places_of
from smsl_studio.picture.shape import Point
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.controls import Combo, Elided, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.panels import keyed_tool
from smsl_studio.studio.base.rows import LINE, RowsView
from smsl_studio.studio.base.screens import open_at, place_over
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.compare.both_runs import BothRuns
from smsl_studio.studio.features.draw.compare.change_rows import rows_of
from smsl_studio.studio.features.draw.compare.keys import NEXT_KEYS, PREVIOUS_KEYS
from smsl_studio.studio.features.draw.compare.linked_views import LinkedViews
from smsl_studio.studio.features.draw.compare.side import BOTH, Side

UNDO_KEYS, REDO_KEYS = ("Ctrl+Z",), ("Ctrl+Shift+Z", "Ctrl+Y")
SIZE = (1200, 760)
CHOICE = 220, 560
"""Least and greatest width of the choice of SBs, in pixels; it fits the longest name."""
LIST = (96, 240)
"""Least and greatest height of the list at first, in pixels; it fits the rows."""
Pair = tuple[str, str]


class CompareDialog(QDialog):
    """Both sides and the list of changes. Esc closes it.

    It blocks the window when it opens as a dialog, but not after ``stand_alone``.
    """

    element_wanted = Signal(object)
    """Address: the person asked for this element in the drawing."""
    undo_wanted = Signal()
    redo_wanted = Signal()
    """The person pressed the keys of undo or redo.

    The caller changes the drawing, and shows the new difference here.
    """

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowFlag(Qt.WindowType.WindowMaximizeButtonHint, True)
        self.setWindowTitle("Compare")
        self._stands_alone = False
        self.marked = True
        """Whether the drawings show marks of changes."""
        self._difference: Difference | None = None
        self._pairs: list[Pair] = []
        self._shown: Pair | None = None
        self._places: tuple[Mapping[str, Point], Mapping[str, Point]] = {}, {}
        self._build(tokens)
        self._link = LinkedViews(self.before.canvas, self.after.canvas, self)
        self.set_tokens(tokens)
        open_at(self, *SIZE)

    # Building.

    def _build(self, tokens: Tokens) -> None:
        self.shared_collapse = SharedCollapse(self)
        self.before = Side(tokens, "Before", "left", self.shared_collapse)
        self.after = Side(tokens, "After", "right", self.shared_collapse)
        self._words = Elided()
        self.branches = Combo()
        self.branches.setAccessibleName("State Branch")
        self.branches.currentTextChanged.connect(
            lambda name: self.branches.setToolTip(tip_text(name))
        )
        self.branches.activated.connect(self._branch_chosen)
        self.previous = keyed_tool(self, "Previous change", PREVIOUS_KEYS, self.show_previous)
        self.next = keyed_tool(self, "Next change", NEXT_KEYS, self.show_next)
        self.fit = keyed_tool(self, "Fit everything", "F", lambda: self._link.fit())
        self.jump = QPushButton("Show in the drawing")
        self.jump.setAutoDefault(False)
        self.jump.clicked.connect(self._jump)
        self.changes = RowsView(tokens, self)
        self.changes.setAccessibleName("Changes")
        self.changes.selectionModel().currentChanged.connect(self._row_chosen)
        self.changes.activated.connect(lambda _: self._jump())
        for side in (self.before, self.after):
            side.clicked.connect(self._clicked)
        for keys, wanted in ((UNDO_KEYS, self.undo_wanted), (REDO_KEYS, self.redo_wanted)):
            for key in keys:
                QShortcut(QKeySequence(key), self).activated.connect(wanted)
        top = row(self._words, self.branches, self.fit, self.previous, self.next, self.jump)
        top.setContentsMargins(14, 8, 14, 8)
        sides = QSplitter(Qt.Orientation.Horizontal)
        sides.addWidget(self.before)
        sides.addWidget(self.after)
        sides.setSizes([600, 600])
        sides.setChildrenCollapsible(False)
        split = self._split = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(sides)
        split.addWidget(self.changes)
        split.setStretchFactor(0, 1)
        split.setChildrenCollapsible(False)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        self.runs = BothRuns(tokens)
        self.runs.step_shown.connect(self._show_step)
        whole.addLayout(top)
        whole.addWidget(self.runs)
        whole.addWidget(split, 1)

    def stand_alone(self, over: QWidget) -> None:
        """Make it an ordinary window over ``over``, so that either window can come to the front."""
        self._stands_alone = True
        self.setWindowFlags(Qt.WindowType.Window)
        place_over(self, over)

    # What is shown.

    def show_difference(self, difference: Difference, before: str, after: str) -> None:
        """Show what changed between two versions. The chosen SB stays, if it still exists.

        ``before`` and ``after`` name the versions.
        """
        first = self._difference is None
        self.runs.clear()
        self._difference = difference
        self._signs = signs_of(difference)
        self._words.setText(difference.words)
        self._words.setToolTip(tip_text(difference.words))
        self.before.show_version(before)
        self.after.show_version(after)
        self.setWindowTitle(plain_text(f"Compare {before} with {after}"))
        changed = changed_pairs(difference)
        self._pairs = [*changed, *(p for p in branch_pairs(difference) if p not in changed)]
        self.branches.clear()
        for pair in self._pairs:
            same = "" if pair in changed else "  (no difference)"
            self.branches.addItem(f"{_name(pair)}{same}")
        self.branches.setMinimumWidth(self.branches.width_of_entries(*CHOICE))
        self.branches.setVisible(len(self._pairs) > 1)
        self.changes.show_rows(rows_of(difference))
        for button in (self.next, self.previous):
            button.setEnabled(not difference.same)
        kept = self._shown if self._shown in self._pairs else next(iter(self._pairs), None)
        self._shown = None
        if kept is not None:
            self._show_pair(kept, fit=first)
        self._light()

    def show_runs(self, before: Sequence[RunStep], after: Sequence[RunStep]) -> None:
        """Show buttons to walk through a run on both sides, up to a difference.

        Another comparison removes them.
        """
        self.runs.show_runs(before, after)

    def _show_step(self, at: int) -> None:
        """Show a step of the run on both sides, in the SB that moves."""
        steps = self.runs.steps
        for number, side in enumerate(steps):
            operation = side[at].operation if at < len(side) else None
            if operation is not None:
                pairs = (one for one in self._pairs if one[number] == operation.branch)
                self._show_pair(next(pairs, self._shown or ("", "")), fit=False)
                break
        names = self._shown or ("", "")
        for view, side, name in zip((self.before, self.after), steps, names, strict=True):
            view.light_step(side, at, name)

    @property
    def summary(self) -> str:
        """The difference in one sentence, as shown at the top."""
        return self._words.text()

    def _show_pair(self, pair: Pair, fit: bool = True) -> None:
        if pair == self._shown or self._difference is None:
            return
        self._shown = pair
        self.branches.setCurrentIndex(self._pairs.index(pair))
        difference = self._difference
        places = places_of(difference, *pair)
        for side, blueprint, name, where, signs in (
            (self.before, difference.before, pair[0], places[0], self._signs[0]),
            (self.after, difference.after, pair[1], places[1], self._signs[1]),
        ):
            side.show_branch(blueprint, name, where, signs.by_address if self.marked else {})
        self._agree()
        moved = places != self._places and self.before.canvas.camera.fitted
        # Before the first show event, the canvases have no size to fit into.
        if self.isVisible() and (fit or moved):
            self._link.fit()
        self._places = places

    def _agree(self) -> None:
        """If one side is crowded, collapse both, so that they look alike."""
        sides = self.before.canvas.collapse, self.after.canvas.collapse
        if any(side.on for side in sides):
            for side in sides:
                side.turn(True)

    def collapse(self, on: bool | None) -> None:
        """Draw the bundles as one line on both sides (True), or on none (False).

        With None, the drawings are collapsed if they are crowded.
        """
        if on is not None:
            self.shared_collapse.keep(BOTH, on)

    def _branch_chosen(self, number: int) -> None:
        self.changes.setCurrentIndex(QModelIndex())
        self._show_pair(self._pairs[number])

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for side in (self.before, self.after):
            side.canvas.set_tokens(tokens)
        self.changes.set_tokens(tokens)
        self.runs.set_tokens(tokens)
        self.previous.setIcon(icon("chevron-up", tokens))
        self.next.setIcon(icon("chevron-down", tokens))
        self.fit.setIcon(icon("fit", tokens))

    # Going from change to change.

    @property
    def current(self) -> tuple[Address | None, Address | None] | None:
        """The addresses of the chosen change, before and after; None if no change is chosen."""
        change: tuple[Address | None, Address | None] | None = self.changes.current_payload
        return change

    def show_next(self) -> None:
        """Go to the next change; after the last one, to the first."""
        self._step(1)

    def show_previous(self) -> None:
        """Go to the previous change; before the first one, to the last."""
        self._step(-1)

    def _step(self, by: int) -> None:
        rows = self.changes.rows.rows
        numbers = [at for at, one in enumerate(rows) if one.kind == LINE]
        if not numbers:
            return
        now = self.changes.currentIndex().row()
        at = numbers.index(now) + by if now in numbers else (0 if by > 0 else -1)
        self.changes.setCurrentIndex(self.changes.rows.index(numbers[at % len(numbers)]))

    def _row_chosen(self) -> None:
        chosen = self.current
        if chosen is not None:
            pair = next((p for p in self._pairs if _belongs(p, chosen)), None)
            if pair is not None:
                self._show_pair(pair)
        self._light()

    def _light(self) -> None:
        before, after = self.current or (None, None)
        self.before.light(before)
        self.after.light(after)
        # An added or removed element is on one side only; the other view is linked.
        for side, address in ((self.after, after), (self.before, before)):
            if address is not None and side.has(address):
                side.canvas.reveal(address)
                break
        self.jump.setEnabled(after is not None or before is not None)

    def _clicked(self, address: Address) -> None:
        """Choose the row of the element that was clicked."""
        place = 0 if self.sender() is self.before else 1
        for at, one in enumerate(self.changes.rows.rows):
            if one.payload and one.payload[place] == address:
                self.changes.setCurrentIndex(self.changes.rows.index(at))
                return

    def _jump(self) -> None:
        before, after = self.current or (None, None)
        wanted = after or before
        if wanted is not None:
            self.element_wanted.emit(wanted)

    def showEvent(self, event: QShowEvent) -> None:
        """Divide the space, choose the first change and give the list the keyboard focus."""
        super().showEvent(event)
        handle = self.windowHandle()
        if self._stands_alone and handle is not None:
            handle.setTransientParent(None)  # type: ignore[arg-type]
        low = min(max(self.changes.height_of_all() + 8, LIST[0]), LIST[1])
        self._split.setSizes([self._split.height() - low, low])
        if not self.changes.currentIndex().isValid():
            self.show_next()
        # Last, because the first change was revealed before the canvases had a size.
        self._link.fit()
        self.changes.setFocus()
        announce(self, f"{self.windowTitle()}. {self.summary}")


def _name(pair: Pair) -> str:
    before, after = pair
    if before and after and before != after:
        return f"{before} → {after}"
    return after or before


def _belongs(pair: Pair, chosen: tuple[Address | None, Address | None]) -> bool:
    before, after = chosen
    if after is not None:
        return pair[1] == after.branch
    return before is not None and pair[0] == before.branch
