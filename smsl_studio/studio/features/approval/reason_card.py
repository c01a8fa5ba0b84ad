"""The card of the badge: the reasons in words, what to do, and the trust policy."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QPoint, Qt, Signal, SignalInstance
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout, QWidget

from smsl_studio.front.approval_badge import ApprovalWords
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.tips import tip_text

WIDE = 420
"""The width of the card (pixels)."""
CHANGED = "digest_differs"


class ReasonCard(QFrame):
    """The reasons for what the badge says, and buttons for what can be done here.

    The card closes if the person clicks elsewhere or presses Escape.
    """

    policy_wanted = Signal()
    """The person wants to choose a trust policy."""
    none_wanted = Signal()
    """The person wants to use no trust policy."""
    changes_wanted = Signal()
    """The person wants to see what has changed since the last signature."""

    def __init__(self, parent: QWidget, said: ApprovalWords, policy: Path | None) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setProperty("role", "float")
        self.setFixedWidth(WIDE)
        self.setAccessibleName(plain_text(said.words))
        column = QVBoxLayout(self)
        column.setContentsMargins(14, 12, 14, 12)
        column.setSpacing(8)
        named = f"Trust policy: {policy.name}" if policy else "No trust policy is chosen."
        self.lines = (*said.lines, named)
        for number, text in enumerate(self.lines):
            line = label(text, "" if number == 0 else "second")
            line.setWordWrap(True)
            if text == named and policy is not None:
                line.setToolTip(tip_text(str(policy)))
            column.addWidget(line)
        self.buttons: list[QPushButton] = []
        if any(one.code == CHANGED for one in said.refusals):
            changes = self._offer("Show what changed", self.changes_wanted)
            column.addLayout(row(changes, None))
        choices = [self._offer("Choose a policy…", self.policy_wanted)]
        if policy is not None:
            choices.append(self._offer("Use no policy", self.none_wanted))
        column.addLayout(row(*choices, None, spacing=8))

    def open_below(self, badge: QWidget) -> None:
        """Show the card below a badge, inside the window."""
        self.adjustSize()
        corner = badge.mapToGlobal(QPoint(badge.width() - self.width(), badge.height() + 6))
        self.move(corner)
        self.show()

    def _offer(self, words: str, wanted: SignalInstance) -> QPushButton:
        button = QPushButton(words)
        button.clicked.connect(self.close)
        button.clicked.connect(wanted)
        self.buttons.append(button)
        return button
