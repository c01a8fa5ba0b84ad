"""The status line: what there is, how it is written, where one is, and what this is not."""

from __future__ import annotations

from PySide6.QtWidgets import QLabel, QStatusBar

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.controls import rule
from smsl_studio.studio.theme import STATUS_LINE
from smsl_studio.studio.words import counted

ENDING = "Not a medical device"


class StatusLine(QStatusBar):
    """Counts at the left; form, place and the standing notice at the right."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(STATUS_LINE)
        self.setSizeGripEnabled(False)
        self.setAccessibleName("Status")
        self.counts = [self._left() for _ in range(4)]
        self.run = QLabel()
        self.run.hide()
        self.addWidget(self.run)
        self.form, self.place, self.ending = QLabel(), QLabel(), QLabel(ENDING)
        for at, part in enumerate((self.form, self.place, self.ending)):
            if at:
                self.addPermanentWidget(rule(vertical=True, length=16))
            self.addPermanentWidget(part)

    def show_blueprint(self, blueprint: Blueprint) -> None:
        """How much there is, and how it is written."""
        words = (
            counted(len(blueprint), "State Branch", "State Branches"),
            counted(blueprint.state_count, "state"),
            counted(blueprint.operation_count, "operation"),
        )
        for part, said in zip(self.counts, words, strict=False):
            part.setText(said)
        bom = " with BOM" if blueprint.document.text.startswith("\ufeff") else ""
        ends = ", CRLF" if blueprint.document.newline == "\r\n" else ""
        self.form.setText(f"{blueprint.document.form.upper()}, UTF-8{bom}{ends}")

    def show_findings(self, said: str) -> None:
        """What the findings come to, or that they are being looked for."""
        self.counts[3].setText(said)

    def show_place(self, line: int, column: int) -> None:
        """Where the selected element is written."""
        self.place.setText(f"Line {line}, column {column}")

    def show_run(self, said: str) -> None:
        """How the run stands; the empty text where there is none."""
        self.run.setText(said)
        self.run.setVisible(bool(said))

    @property
    def words(self) -> str:
        """Everything that is said at the left."""
        return " | ".join(part.text() for part in self.counts if part.text())

    def _left(self) -> QLabel:
        part = QLabel()
        self.addWidget(part)
        self.addWidget(rule(vertical=True, length=16))
        return part
