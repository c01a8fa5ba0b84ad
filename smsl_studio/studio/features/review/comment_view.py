"""One comment with its answers, and the buttons to answer and to close it."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout

from smsl_studio.inspection.review.entry import ReviewEntry
from smsl_studio.inspection.review.review import ReviewComment
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label, label, row


class CommentView(QFrame):
    """A comment and its replies. ``may_close`` says whether this person may close it."""

    reply_wanted = Signal(object)
    close_wanted = Signal(object)

    def __init__(self, comment: ReviewComment, may_close: bool, former: str = "") -> None:
        super().__init__()
        self.comment = comment
        self.setProperty("role", "comment")
        self.setProperty("kind", "open" if comment.is_open else "closed")
        column = QVBoxLayout(self)
        column.setContentsMargins(10, 8, 10, 8)
        column.setSpacing(6)
        if former:
            column.addWidget(_words(f"Written on the former words: “{former}”", "readSmall"))
        for entry in (comment.entry, *comment.replies):
            column.addWidget(_words(entry.text, "readNote"))
            column.addWidget(_words(signed(entry), "readSmall"))
        self.reply, self.close_button = QPushButton("Answer"), QPushButton("Close")
        self.close_button.setToolTip("The comment is settled")
        self.reply.clicked.connect(lambda: self.reply_wanted.emit(comment))
        self.close_button.clicked.connect(lambda: self.close_wanted.emit(comment))
        if comment.is_open:
            if not may_close:
                self.close_button.hide()
            column.addLayout(row(self.reply, self.close_button, None))
        elif comment.closed is not None:
            column.addWidget(_words(f"Closed by {signed(comment.closed)}", "readSmall"))
        self.setAccessibleName(plain_text(told(comment)))


def told(comment: ReviewComment) -> str:
    """A comment in one text, for screen readers and rows."""
    state = "answered" if comment.is_answered else "open"
    return f"Comment of {comment.entry.person}, {state if comment.is_open else 'closed'}: " + (
        comment.entry.text
    )


def signed(entry: ReviewEntry) -> str:
    """Who has written an entry, and when."""
    who = f"{entry.person}, {entry.role}" if entry.role else entry.person
    return f"{who}, {entry.time[:10]} {entry.time[11:16]} UTC"


def _words(text: str, role: str) -> Label:
    made = label(text, role)
    made.setWordWrap(True)
    return made
