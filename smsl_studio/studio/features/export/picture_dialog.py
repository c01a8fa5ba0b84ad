"""PictureDialog: what the dialogs for files and for paper share: choices, a preview, work."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeVar

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QGridLayout,
    QHBoxLayout,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.errors import StudioError
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.controls import Combo, label, row
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import refusal_words
from smsl_studio.studio.features.export.preview import Preview
from smsl_studio.studio.features.export.subject import ALL, BRANCH, SELECTION, VIEW, Subject

Came = TypeVar("Came")
WORDS = {VIEW: "What is in view", SELECTION: "The selection", BRANCH: "This State Branch",
         ALL: "All State Branches"}  # fmt: skip
BUNDLING = {"Each by itself": False, "Bundled": True}
"""How operations between the same two states are drawn."""


class PictureDialog(QDialog):
    """Choices at the left, a preview at the right, and work in the background.

    ``subjects`` has what can be chosen, in the order of the list. Cancel first calls off what is
    being done; once more, or if nothing is done, it closes the dialog.
    """

    def __init__(
        self, subjects: Mapping[str, Subject], title: str, verb: str, tokens: Tokens,
        parent: QWidget,
    ) -> None:  # fmt: skip
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(title)
        self.setModal(True)
        self.subjects = subjects
        self.beside = Beside(self)
        self.preview = Preview(tokens)
        self.facts = label("", "hint")
        self.said = label("", "small")
        self.refusal = label("", "refusal")
        self.refusal.hide()
        self.bar = QProgressBar()
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(6)
        self.bar.setAccessibleName("Progress")
        self.go = QPushButton(verb)
        self.go.setDefault(True)
        self.cancel = QPushButton("Cancel")
        self.cancel.setAutoDefault(False)
        self.cancel.clicked.connect(self.reject)
        self._grid = QGridLayout()
        self._grid.setHorizontalSpacing(12)
        self._grid.setVerticalSpacing(8)
        self.what = self.choice("Picture of", {WORDS[what]: what for what in subjects})
        self.bundling = self.choice("Operations", BUNDLING)
        self.bundling.setCurrentIndex(int(any(one.collapsed for one in subjects.values())))
        self.show_work("")

    def choice(self, words: str, entries: Mapping[str, object]) -> Combo:
        """Add a line with a choice among ``entries``, words with their values."""
        combo = Combo()
        combo.setAccessibleName(words)
        for shown, value in entries.items():
            combo.addItem(shown, value)
        combo.setMinimumWidth(combo.width_of_entries(160, 220))
        at = self._grid.rowCount()
        said = label(words, "label")
        said.setBuddy(combo)
        self._grid.addWidget(said, at, 0)
        self._grid.addWidget(combo, at, 1)
        return combo

    def lay_out(self) -> None:
        """Put everything into its place, after all choices were added."""
        left = QVBoxLayout()
        left.setSpacing(8)
        left.addLayout(self._grid)
        left.addWidget(self.facts)
        left.addWidget(self.refusal)
        left.addStretch(1)
        side = QWidget()
        side.setLayout(left)
        left.setContentsMargins(0, 0, 0, 0)
        side.setFixedWidth(300)
        body = QHBoxLayout()
        body.setSpacing(16)
        body.addWidget(side)
        body.addWidget(self.preview, 1)
        work = QVBoxLayout()
        work.setSpacing(4)
        work.addWidget(self.said)
        work.addWidget(self.bar)
        foot = row(None, self.cancel, self.go)
        foot.insertLayout(0, work, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(16)
        column.addLayout(body, 1)
        column.addLayout(foot)
        open_at(self, 960, 600)

    @property
    def subject(self) -> Subject:
        """What is chosen to be drawn, and how."""
        chosen = self.subjects[str(self.what.currentData())]
        return replace(chosen, collapsed=bool(self.bundling.currentData()))

    @property
    def busy(self) -> bool:
        """Whether the file or the paper is being made."""
        return not self.go.isEnabled()

    def work(
        self,
        words: str,
        do: Callable[[], Came],
        then: Callable[[Came], object],
        blocks: bool = False,
    ) -> None:
        """Do something in the background in the place of what was begun there.

        ``then`` gets its result. An expected error is shown. ``blocks`` switches the choices off.
        """
        self.beside.drop()
        self.show_refusal(None)
        self.show_work(words, blocks)

        def done(came: Came | StudioError) -> None:
            self.show_work("")
            if isinstance(came, StudioError):
                self.show_refusal(came)
            else:
                then(came)

        self.beside.do(lambda: _tried(do), done)

    def show_work(self, words: str, blocks: bool = False, done: int = 0, of: int = 0) -> None:
        """Show what is done and how far; with empty words, that nothing is."""
        self.said.setText(words)
        self.bar.setVisible(bool(words))
        self.bar.setRange(0, of)
        self.bar.setValue(done)
        self.go.setEnabled(not blocks)
        for combo in self.findChildren(Combo):
            combo.setEnabled(not blocks)

    def show_refusal(self, error: StudioError | None) -> None:
        """Show why something was not done, and what to do; None for no error."""
        words = refusal_words(error) if error is not None else ""
        self.refusal.setText(words)
        self.refusal.setVisible(bool(words))

    def reject(self) -> None:
        """Call off what is being made, or close the dialog."""
        if self.busy:
            self.call_off()
        else:
            super().reject()

    def call_off(self) -> None:
        """Call off what is being made."""
        self.beside.drop()
        self.show_work("")
        self.facts.setText("Called off. Nothing was written.")

    def done(self, result: int) -> None:
        """Close the dialog and end its work."""
        self.beside.stop()
        super().done(result)


def _tried(do: Callable[[], Came]) -> Came | StudioError:
    try:
        return do()
    except StudioError as error:
        return error
