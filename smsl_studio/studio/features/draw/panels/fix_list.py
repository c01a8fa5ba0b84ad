"""What "Fix all" will do, listed before it is done."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.repair import Repair, mend_errors
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session


class FixList(QDialog):
    """The fixes that are certain, in the order in which they are made; one button makes them all
    as one step. ``left`` errors have fixes that delete or guess, and stay for a person.
    """

    def __init__(
        self, session: Session, repair: Repair, left: int, tokens: Tokens, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Fix all")
        self.setModal(True)
        self._session, self._repair = session, repair
        self._of = session.blueprint
        self.rows = RowsView(tokens, self)
        self.rows.setAccessibleName("Fixes")
        self.rows.show_rows(
            [
                ListRow(
                    finding.fix.words, finding, "check", str(finding.address), tip=finding.message
                )
                for finding in repair.mended
                if finding.fix is not None
            ]
        )
        number = len(repair.mended)
        self.apply = QPushButton("Make this fix" if number == 1 else f"Make these {number} fixes")
        self.apply.setDefault(True)
        self.apply.clicked.connect(self._apply)
        cancel = QPushButton("Cancel")
        cancel.clicked.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(8)
        self.said = label("These are certain and lose nothing. They are one step to undo.", "hint")
        column.addWidget(self.said)
        column.addWidget(self.rows, 1)
        self.left = label(
            f"{counted(left, 'more error has a fix', 'more errors have fixes')} that would delete "
            "something or choose for you. Their own buttons make them, one by one.",
            "hint",
        )
        self.left.setVisible(left > 0)
        column.addWidget(self.left)
        column.addLayout(row(None, cancel, self.apply))
        open_at(self, 560, 320)
        # What is listed is made for this drawing alone.
        session.blueprint_changed.connect(self.reject)

    def _apply(self) -> None:
        words = f"Fix {counted(len(self._repair.mended), 'finding')}"
        self._session.blueprint_changed.disconnect(self.reject)
        self.accept()
        self._session.edit(words, self._mended)

    def _mended(self, blueprint: Blueprint) -> Blueprint:
        """What was listed; a field that was left just now may have changed the drawing once more,
        and then the fixes are made for that."""
        same = blueprint is self._of
        return self._repair.blueprint if same else mend_errors(blueprint).blueprint
