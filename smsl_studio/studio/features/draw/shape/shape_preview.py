"""ShapePreview: shows a change of the shape before it is made, with a button to make it."""

from __future__ import annotations

from PySide6.QtCore import QTimer, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.comparison import compare
from smsl_studio.legible import plain_text
from smsl_studio.picture.aligned import as_drawn
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.draw.compare.dialog import CompareDialog
from smsl_studio.studio.features.draw.shape.shape_edit import ShapeEdit


class ShapePreview(CompareDialog):
    """The present drawing beside the changed one. It blocks the window until the person decides."""

    apply_wanted = Signal()

    def __init__(self, edit: ShapeEdit, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(tokens, parent)
        self.jump.hide()
        self.said = label(edit.sentence, "second")
        self.said.setWordWrap(True)
        self.apply = QPushButton("Apply")
        self.apply.setDefault(True)
        self.apply.setToolTip("Make this one step, which can be undone")
        self.apply.clicked.connect(self.apply_wanted)
        self.leave = QPushButton("Cancel")
        self.leave.setAutoDefault(False)
        self.leave.clicked.connect(self.reject)
        line = row(self.said, self.leave, self.apply)
        line.setStretch(0, 1)
        line.setContentsMargins(14, 8, 14, 12)
        whole = self.layout()
        assert isinstance(whole, QVBoxLayout)
        whole.addLayout(line)
        # If nearly all names are new, marks of changes would only hide the drawings.
        self.marked = edit.marked
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._link.fit)
        difference = as_drawn(compare(edit.before, edit.after))
        self.show_difference(difference, "as it is drawn", edit.result)
        self.setWindowTitle(plain_text(f"Preview: {edit.words}"))

    def showEvent(self, event: QShowEvent) -> None:
        """Fit both drawings into their sides, and give the button Apply the keyboard focus."""
        super().showEvent(event)
        self._soon.start(0)
        self.apply.setFocus()
