"""The dialog that lists what “Fix all” will do, before it is done."""

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
    """The certain fixes in the order in which they are made.

    One button makes all of them as one step.

    ``left`` counts the errors whose fixes delete or guess; a person has to make those.
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
        # The list holds for this blueprint only.
        session.blueprint_changed.connect(self.reject)

    def _apply(self) -> None:
        words = f"Fix {counted(len(self._repair.mended), 'finding')}"
        self._session.blueprint_changed.disconnect(self.reject)
        self.accept()
        self._session.edit(words, self._mended)

    def _mended(self, blueprint: Blueprint) -> Blueprint:
        """The blueprint with the listed fixes.

        If a field that lost the focus has changed the blueprint, the fixes are computed anew.
        """
        same = blueprint is self._of
        return self._repair.blueprint if same else mend_errors(blueprint).blueprint
