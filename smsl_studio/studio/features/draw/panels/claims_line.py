"""The line about hazards and properties in Properties: how many there are, and the way to them."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.frame import Panel

KEYS = {"_hazards": ("hazard", "hazards"), "_properties": ("property", "properties")}
NONE = "None. A hazard names facts that must never hold together."


class ClaimsLine(Panel):
    """Counts the hazards and properties of the whole file. They are written on another page."""

    wanted = Signal()
    """Show the page on which they are written and answered."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__("Hazards and properties", parent)
        self._session = session
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(6)
        self.open = QPushButton("Open Inspection")
        self.open.setProperty("role", "link")
        self.open.setToolTip("Write hazards and properties, and see whether they hold (Ctrl+I)")
        self.open.clicked.connect(self.wanted)
        self.column.addLayout(row(label("Hazards and properties", "heading"), None, self.open))
        self.said = label("", "hint")
        self.column.addWidget(self.said)
        session.afterwards.follow(self._show, session.blueprint_changed)
        self._show()

    def _show(self) -> None:
        parts = [
            counted(many, *words)
            for key, words in KEYS.items()
            if (many := _number(self._session.blueprint, key))
        ]
        self.said.setText(f"{' and '.join(parts)}." if parts else NONE)


def _number(blueprint: Blueprint, key: str) -> int:
    """Return how many entries all files have, also those that cannot be read."""
    found = (one.values.get(key) for one in blueprint.documents)
    return sum(len(entries) for entries in found if isinstance(entries, list))
