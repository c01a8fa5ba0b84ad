"""The dialog of the automatic supervisors of the next run: which ones, and what a forecast does."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QGridLayout,
    QPlainTextEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.front.agents.asked_agent import asked_agents
from smsl_studio.front.agents.shipped import shipped
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.signature import Signature
from smsl_studio.studio.base.controls import Combo, label, row
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.features.run.next_run import NextRun
from smsl_studio.studio.features.run.supervisor_choice import SupervisorChoice

LEVELS = {
    "": "None in the record",
    "show": "Told before each operation",
    "ask": "A person decides where it differs",
    "hold": "The run holds where it differs",
}
"""The levels of forecasts in words."""


class SupervisorsDialog(QDialog):
    """Asks for the supervisors, one a line. ``choice`` is what was chosen, as soon as it is
    accepted."""

    def __init__(self, choice: SupervisorChoice, loaded: Loaded | None, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("Automatic supervisors")
        self.choice = choice
        self._known = known_supervisors(loaded)
        self.names = QPlainTextEdit("\n".join(choice.agents))
        self.names.setAccessibleName("Supervisors, one a line")
        self.names.setPlaceholderText("limit:risk=0.5")
        self.names.setTabChangesFocus(True)
        self.forecast = Combo()
        self.forecast.setAccessibleName("Forecasts")
        for level, words in LEVELS.items():
            self.forecast.addItem(words, level)
        self.forecast.setCurrentIndex(max(self.forecast.findData(choice.forecast), 0))
        known = label("\n".join(map(_words, self._known.items())), "hint")
        known.setWordWrap(True)
        known.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.refusal = label("", "refusal")
        self.refusal.setWordWrap(True)
        self.refusal.setMinimumHeight(34)
        self.cancel, self.use = QPushButton("Cancel"), QPushButton("Use in the next run")
        self.use.setProperty("role", "primary")
        self.use.setDefault(True)
        self.cancel.clicked.connect(self.reject)
        self.use.clicked.connect(self.accept)
        self.names.textChanged.connect(self._judge)
        grid = QGridLayout()
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(8)
        grid.setColumnStretch(1, 1)
        grid.setRowStretch(0, 1)
        for at, (words, part) in enumerate(
            (("Supervisors", self.names), ("There are", known), ("Forecasts", self.forecast))
        ):
            grid.addWidget(label(words, "second"), at, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(part, at, 1)
        column = QVBoxLayout(self)
        why = "Each is asked before every operation, and the most careful answer counts."
        explained = label(why, "small")
        explained.setWordWrap(True)
        column.addWidget(explained)
        column.addLayout(grid, 1)
        column.addWidget(self.refusal)
        column.addLayout(row(None, self.cancel, self.use, spacing=8))
        open_at(self, 520, 380)
        self._judge()

    @property
    def _lines(self) -> tuple[str, ...]:
        lines = (line.strip() for line in self.names.toPlainText().splitlines())
        return tuple(line for line in lines if line)

    def _judge(self) -> None:
        """Say what is wrong with the names, before anything is begun with them."""
        wrong = ""
        try:
            for one in asked_agents(self._lines):
                if one.name not in self._known:
                    near = did_you_mean(one.name, self._known)
                    wrong = wrong or f"There is no supervisor {one.name}. {near or ''}".strip()
        except UsageError as error:
            wrong = f"{error.sentence[:1].upper()}{error.sentence[1:]}. {error.advice}"
        self.refusal.setText(wrong)
        self.use.setEnabled(not wrong)

    def accept(self) -> None:
        """Take over what was chosen."""
        self.choice = SupervisorChoice(self._lines, self.forecast.currentData() or "")
        super().accept()


def choose_supervisors(following: NextRun, window: QWidget) -> None:
    """Ask for the automatic supervisors of the next run, and keep what was chosen for it."""
    dialog = SupervisorsDialog(following.supervisors, following.loaded, window)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)

    def take() -> None:
        """Keep what was chosen."""
        following.supervisors = dialog.choice

    dialog.accepted.connect(take)
    dialog.open()


def known_supervisors(loaded: Loaded | None) -> Mapping[str, Signature]:
    """Return the parameters of each supervisor: those of the program, then those of plugins."""
    found = {name: one.signature for name, one in shipped().supervisors.items()}
    for plugin in loaded.plugins if loaded is not None else ():
        for name, one in plugin.library.supervisors.items():
            found.setdefault(name, one.signature)
    return found


def _words(known: tuple[str, Signature]) -> str:
    name, signature = known
    return f"{name}: {', '.join(signature.types)}" if signature.types else name
