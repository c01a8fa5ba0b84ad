"""What the page Merge shows for a text with the conflict markers of a merge by lines."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.studio.base.controls import label, row

WIDE = 560
WHY = (
    "git merged the file line by line and left both versions between markers, so it is no "
    "blueprint now. The versions can be put together again and merged by what they mean: what "
    "only one side changed is taken, and you choose the rest here. The file on the disk stays as "
    "it is until you save, and an undo brings back the markers."
)


class MarkedNotice(QWidget):
    """Says what the text is, and offers to merge it by meaning."""

    merge_wanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._head, self._why = label("", "title"), label(WHY, "second")
        self._error = label("", "refusal")
        for words in (self._head, self._why, self._error):
            words.setWordWrap(True)
            words.setMaximumWidth(WIDE)
        self.merge = QPushButton("Merge by meaning")
        self.merge.setProperty("role", "primary")
        self.merge.setAutoDefault(False)
        self.merge.clicked.connect(self.merge_wanted)
        column = QVBoxLayout()
        column.setSpacing(12)
        for part in (self._head, self._why, self._error):
            column.addWidget(part)
        column.addLayout(row(self.merge, None))
        whole = QVBoxLayout(self)
        whole.addStretch(1)
        whole.addLayout(row(None, _held(column), None))
        whole.addStretch(2)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.show_error("")

    @property
    def words(self) -> str:
        """What is said now."""
        return " ".join(filter(None, (self._head.text(), self._error.text())))

    def show_marked(self, head: str, error: str, can_merge: bool) -> None:
        """Say what the text is, and why it cannot be merged, if it cannot."""
        self._head.setText(head)
        self.show_error(error)
        self.show_busy(False)
        self.merge.setEnabled(can_merge)

    def show_error(self, error: str) -> None:
        """Say why the merge was not possible; empty text hides it."""
        self._error.setText(error)
        self._error.setVisible(bool(error))

    def show_busy(self, busy: bool) -> None:
        """Say that the merge is being made."""
        self.merge.setEnabled(not busy)
        self.merge.setText("Merging by meaning" if busy else "Merge by meaning")


def _held(column: QVBoxLayout) -> QWidget:
    inner = QWidget()
    column.setContentsMargins(16, 16, 16, 16)
    inner.setLayout(column)
    inner.setFixedWidth(WIDE + 32)
    return inner
