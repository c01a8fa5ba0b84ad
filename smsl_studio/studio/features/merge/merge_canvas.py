"""The drawing of a merge: one SB with what all versions have, and the switches of the versions."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QSize, QTimer, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.merge import Side
from smsl_studio.blueprint.merge.sides import MergeSides
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.overlaid import OverlaidBranch, overlaid
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.controls import Combo, Elided, row
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.merge.conflict_card import SIDES
from smsl_studio.studio.features.merge.open_merge import WORDS, OpenMerge
from smsl_studio.studio.features.merge.side_icons import side_icon

TIPS = {
    "ours": "Show what my version has",
    "theirs": "Show what their version has",
    "base": "Show what both versions come from",
}


class MergeCanvas(QWidget):
    """Shows one SB of the merge. Nothing can be edited here."""

    clicked = Signal(object)
    """Address: the element of the file that was clicked."""

    def __init__(self, merge: OpenMerge, tokens: Tokens) -> None:
        super().__init__()
        self._merge = merge
        self._picture: OverlaidBranch | None = None
        self._result: Blueprint | None = None
        self._selected: tuple[Address, ...] = ()
        self._shown: tuple[object, ...] = ()
        self.branches = Combo()
        self.branches.setAccessibleName("State Branch")
        self.branches.activated.connect(lambda _: self._draw())
        self._words = Elided()
        self._words.setProperty("role", "small")
        self.switches = {side: self._switch(WORDS[side], TIPS[side]) for side in SIDES}
        self.result = self._switch("Result", "Show the file as it would be saved now")
        self.result.setChecked(False)
        self.all = QPushButton("Show all")
        self.all.setProperty("role", "link")
        self.all.setCheckable(True)
        self.all.setAutoDefault(False)
        self.all.setToolTip("Show what did not change as clearly as the rest")
        self.all.clicked.connect(self._draw)
        for button in self.switches.values():
            button.clicked.connect(self._version_switched)
        self.result.clicked.connect(self._result_switched)
        self.canvas = Canvas(tokens)
        self.canvas.editing = False
        self.canvas.collapse.join(SharedCollapse(self))
        self.canvas.setAccessibleName("Canvas of the merge")
        for signal in (self.canvas.node_clicked, self.canvas.edge_clicked):
            signal.connect(self._clicked)
        top = row(self.branches, self._words, self.all, None, *self.switches.values(), self.result)
        top.setContentsMargins(12, 6, 12, 6)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(top)
        column.addWidget(self.canvas, 1)
        self.set_tokens(tokens)

    def _switch(self, words: str, tip: str) -> QPushButton:
        button = QPushButton(words)
        button.setProperty("role", "switch")
        button.setCheckable(True)
        button.setChecked(True)
        button.setToolTip(tip_text(tip))
        button.setAutoDefault(False)
        return button

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.canvas.set_tokens(tokens)
        for side, button in self.switches.items():
            button.setIcon(side_icon(side, tokens))
            button.setIconSize(QSize(16, 16))

    @property
    def words(self) -> str:
        """What stands above the drawing."""
        return self._words.text()

    @property
    def picture(self) -> OverlaidBranch | None:
        """What is drawn now."""
        return self._picture

    def show_result(self, result: Blueprint, selected: Iterable[Address]) -> None:
        """Show another state of the merge, with these elements of the file selected."""
        self._result = result
        sides = self._merge.sides
        if sides is None:
            return
        names = list(dict.fromkeys(
            name for version in (result, sides.ours, sides.theirs, sides.base) if version
            for name in version.branches if name not in version.imported
        ))  # fmt: skip
        touched = {one.path[0] for one in self._merge.conflicts}
        names.sort(key=lambda name: name not in touched)
        if names != [self.branches.itemText(at) for at in range(self.branches.count())]:
            former = self.branches.currentText()
            self.branches.clear()
            self.branches.addItems(names)
            if former in names:
                self.branches.setCurrentText(former)
            self.branches.setMinimumWidth(self.branches.width_of_entries(140, 320))
        self.branches.setVisible(len(names) > 1)
        base_known = sides.base is not None
        self.switches["base"].setEnabled(base_known)
        tip = TIPS["base"] if base_known else "The base is not known"
        self.switches["base"].setToolTip(tip_text(tip))
        self.select(selected)

    def select(self, addresses: Iterable[Address]) -> None:
        """Select elements of the file, and show the first of them."""
        chosen = tuple(addresses)
        if chosen and self.branches.findText(chosen[0].branch) >= 0:
            self.branches.setCurrentText(chosen[0].branch)
        self._selected = chosen
        self._draw()
        lines = self._drawn(chosen)
        # Before the page is shown, the canvas has not its size yet.
        if self.isVisible() and lines and self.canvas.rect_of(lines[0]) is not None:
            self.canvas.reveal(lines[0])

    def showEvent(self, event: QShowEvent) -> None:
        """Show all of the drawing, when it has its size."""
        super().showEvent(event)
        QTimer.singleShot(0, self.canvas, self.canvas.fit)

    def _drawn(self, addresses: Iterable[Address]) -> tuple[Address, ...]:
        if self._picture is None:
            return ()
        return tuple(line for one in addresses for line in self._picture.shown(one))

    def _versions(self) -> tuple[Side, ...]:
        if self.result.isChecked():
            return ()
        return tuple(side for side in SIDES if self.switches[side].isChecked())

    def _draw(self) -> None:
        sides, result, branch = self._merge.sides, self._result, self.branches.currentText()
        if sides is None or result is None or not branch:
            return
        shown = (result, sides, branch, self._versions())
        if shown != self._shown:
            try:
                self._picture = overlaid(result, sides, branch, self._versions())
            except ReadError as error:
                # Only an entry that was written by hand has such values.
                self.canvas.show_banner(f"This State Branch cannot be drawn: {error.sentence}")
                return
            same = self._shown[2:3] == (branch,)
            self._shown = shown
            blueprint, places = self._picture.blueprint, self._picture.places
            self.canvas.show_branch(blueprint, branch, places, keep_view=same)
            self.canvas.show_banner("" if self._picture.blueprint[branch].table else
                                    "These versions do not have this State Branch")  # fmt: skip
        self._mark(sides)

    def _mark(self, sides: MergeSides) -> None:
        assert self._picture is not None
        numbers: dict[Address, str] = {}
        if not self.result.isChecked():
            for number, one in enumerate(self._merge.conflicts, start=1):
                sign = str(number) if self._merge.is_open(one) else "\u2713"
                for line in self._drawn([Address(*Address.split(one.address))]):
                    if line.state:
                        numbers.setdefault(line, sign)
        signs = self._picture.signs
        self.canvas.set_marks(Marks(
            selection=self._drawn(self._selected), changes=signs, conflicts=numbers,
            dimmed=bool(signs or numbers) and not self.all.isChecked(),
        ))  # fmt: skip
        table = self._picture.blueprint[self.branches.currentText()].edges()
        plain = sum(
            1 for edge in table
            if Address(self.branches.currentText(), edge.source, edge.name) not in signs
        )  # fmt: skip
        self.all.setVisible(sides.known and plain > 0 and not self.result.isChecked())
        pale = "shown" if self.all.isChecked() else "pale"
        words = (
            f"{counted(plain, 'unchanged operation')} {pale}"
            if sides.known
            else ("The file tells the conflicts alone: who changed what else is not known")
        )
        self._words.setText(
            "The file as it would be saved now" if self.result.isChecked() else words
        )

    def _version_switched(self) -> None:
        self.result.setChecked(not any(one.isChecked() for one in self.switches.values()))
        self._draw()

    def _result_switched(self) -> None:
        for button in self.switches.values():
            button.setChecked(not self.result.isChecked())
        self._draw()

    def _clicked(self, address: Address) -> None:
        if self._picture is not None:
            self.clicked.emit(self._picture.true_address(address))
