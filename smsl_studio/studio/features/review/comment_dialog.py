"""The engineer's answer to a comment: what was asked, the way to its line, and a field."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QPushButton, QVBoxLayout, QWidget

from smsl_studio.inspection.review.review import ReviewComment
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.features.review.answer_field import AnswerField
from smsl_studio.studio.features.review.comment_view import CommentView


class CommentDialog(QDialog):
    """Shows one comment and takes an answer. The comment stays open until its writer closes it."""

    answered = Signal(object, str)
    """(ReviewComment, str): the answer."""
    line_wanted = Signal(object)
    """ReviewComment: show its line in Review."""
    begun = Signal(object, str)
    """(ReviewComment, str): an answer that is not kept yet, when the dialog shows the line."""

    def __init__(self, comment: ReviewComment, style: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("A comment of the review")
        self.setMinimumWidth(480)
        self.setStyleSheet(style)
        view = CommentView(comment, may_close=False)
        view.reply.hide()
        self.field = AnswerField(f"Answer {comment.entry.person}", "Keep the answer")
        self.field.given.connect(lambda text: self._give(comment, text))
        self.field.left.connect(self.reject)
        self.line = QPushButton("Show the line in Review")
        self.line.clicked.connect(lambda: self._show(comment))
        heading = label(comment.entry.heading, "sideTitle")
        heading.setWordWrap(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(10)
        for part in (heading, view, self.field):
            column.addWidget(part)
        column.addLayout(row(self.line, None))
        self.field.text.setFocus()

    def _give(self, comment: ReviewComment, text: str) -> None:
        self.answered.emit(comment, text)
        self.accept()

    def _show(self, comment: ReviewComment) -> None:
        if self.field.written.strip():
            self.begun.emit(comment, self.field.written)
        self.reject()
        self.line_wanted.emit(comment)
