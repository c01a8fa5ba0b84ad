"""One line of the reading: what it says, what people have answered, and the buttons to answer."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFocusEvent, QIcon, QMouseEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QVBoxLayout

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.reading.sections import ReadingLine
from smsl_studio.inspection.review.review import ReviewComment
from smsl_studio.inspection.review.reviewed import ReviewedLine
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label, label, row
from smsl_studio.studio.base.icons import icon, pixmap
from smsl_studio.studio.base.notation_part import NotationPart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.review.answer_field import AnswerField
from smsl_studio.studio.features.review.comment_view import CommentView, signed, told
from smsl_studio.studio.features.review.drafts import COMMENT, NOTE, REPLY, ReviewDraft
from smsl_studio.studio.features.review.line_mark import ANSWERED, ASKED, OPEN, LineMark

BUTTONS = 128
"""The width of the buttons at the right of a line (pixels)."""
NARROW = 560
"""Below this width (pixels, at the usual text size) the buttons stand below the text."""
MOST_INNER = 40
"""At most so many inner lines are shown; the report has all of them."""


@dataclass(frozen=True)
class LineLooks:
    """What a line needs besides its words: colours, text size, room, and who may close what.

    ``narrow`` says that the buttons stand below the text.

    ``changed`` says that the line means something else than when it was last signed.
    """

    tokens: Tokens
    size: float
    narrow: bool
    changed: bool
    closable: frozenset[str]


class LineCard(QFrame):
    """A line. It takes the keyboard focus as a whole; the page hears its keys."""

    approve_wanted = Signal(str)
    """str: the note, empty if none is needed."""
    take_back_wanted = Signal()
    comment_wanted = Signal(str)
    reply_wanted = Signal(object, str)
    """(ReviewComment, str): an answer to a comment."""
    close_wanted = Signal(object)
    grew = Signal()
    """A field was opened, so that the line needs more room."""
    entered = Signal()
    """The line has the keyboard focus now, or was clicked."""
    typed = Signal(str, str, str)
    """(kind of a draft, id of a comment, text): a field was opened, or its text is another one."""
    left = Signal()
    """The person leaves the field without keeping its text."""

    def __init__(self, reviewed: ReviewedLine, looks: LineLooks) -> None:
        super().__init__()
        self.reviewed, self._looks = reviewed, looks
        self.field: AnswerField | None = None
        self.may_write: Callable[[], bool] = lambda: True
        """Whether an answer can be kept now. It tells the person if not."""
        self.notation_of: Callable[[tuple[Address, ...]], tuple[str, ...]] = lambda about: ()
        """Returns elements in the notation of the paper."""
        self.notation = NotationPart()
        self.notation.hide()
        self.setProperty("role", "readLine")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(plain_text(spoken(reviewed, looks.changed)))
        self._text = QVBoxLayout()
        self._text.setSpacing(6)
        self._fill()
        self.approve = self._button("Approve", "check", "Approve this line (Y)")
        self.ask = self._button("Comment", "slip", "Write a comment on this line (C)")
        self._dress_buttons()
        self.approve.clicked.connect(self.toggle)
        self.ask.clicked.connect(self.write_comment)
        mark = LineMark(reviewed.line.mark, state_of(reviewed), looks.tokens, looks.size)
        across = QHBoxLayout(self)
        across.setContentsMargins(12, 14, 20, 14)
        across.setSpacing(16)
        across.addWidget(mark, 0, Qt.AlignmentFlag.AlignTop)
        across.addLayout(self._text, 1)
        if looks.narrow:
            self._text.addLayout(row(self.approve, self.ask, None))
        else:
            beside = QVBoxLayout()
            beside.setSpacing(8)
            for button in (self.approve, self.ask):
                button.setFixedWidth(round(BUTTONS * min(looks.size, 1.5)))
                beside.addWidget(button)
            beside.addStretch(1)
            across.addLayout(beside)

    def is_of(self, reviewed: ReviewedLine, looks: LineLooks) -> bool:
        """Whether this card shows exactly this."""
        return self.reviewed == reviewed and self._looks == looks

    def show_here(self, here: bool) -> None:
        """Mark this line as the one at hand, or not."""
        self.setProperty("here", here)
        self.style().unpolish(self)
        self.style().polish(self)
        about = self.reviewed.line.about
        self.notation.show_lines((lambda: self.notation_of(about)) if here and about else None)
        wanted = here and self.reviewed.approval is None
        self.approve.setProperty("role", "primary" if wanted else "")
        self.approve.style().unpolish(self.approve)
        self.approve.style().polish(self.approve)
        self.approve.setIcon(self._icon("check", wanted))

    def toggle(self) -> None:
        """Approve the line, or take the approval back. An open point asks for a note first."""
        if self.reviewed.approval is not None:
            self.take_back_wanted.emit()
        elif self.reviewed.line.open_point:
            self._open(NOTE)
        else:
            self.approve_wanted.emit("")

    def write_comment(self) -> None:
        """Open the field for a comment."""
        self._open(COMMENT)

    def write_reply(self, comment: ReviewComment) -> None:
        """Open the field for an answer to a comment."""
        self._open(REPLY, comment.entry.id)

    def begin(self, draft: ReviewDraft) -> None:
        """Open the field with a text that was begun before; the focus stays where it is."""
        self._show_field(draft.kind, draft.to).begin(draft.text)

    def leave_field(self) -> None:
        """Close the field without keeping its text, with the focus at the line."""
        if self.field is not None:
            # First: else the focus of the hidden field would go to another line.
            self.setFocus()
            self.put_away()

    def put_away(self) -> None:
        """Close the field; whoever asks for it has its text."""
        field, self.field = self.field, None
        if field is not None:
            field.hide()
            field.deleteLater()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Tell that this line is at hand."""
        super().focusInEvent(event)
        self.entered.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """A click anywhere on the line takes it at hand."""
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        event.accept()

    def _open(self, kind: str, to: str = "") -> None:
        """Open a field. One in which something is written stays, whatever it is for."""
        if not self.may_write():
            return
        self.entered.emit()
        if self.field is None or not self.field.written.strip():
            self.put_away()
            self._show_field(kind, to)
            self.typed.emit(kind, to, "")
        if self.field is not None:
            self.field.text.setFocus()
        self.grew.emit()

    def _show_field(self, kind: str, to: str) -> AnswerField:
        comment = next((one for one in self.reviewed.comments if one.entry.id == to), None)
        if kind == NOTE:
            question = "This point is open. Write why it may stay as it is"
            field = AnswerField(question, "Approve with this remark")
            field.given.connect(self.approve_wanted)
        elif comment is not None:
            field = AnswerField(f"Answer {comment.entry.person}", "Keep the answer")
            field.given.connect(lambda text: self.reply_wanted.emit(comment, text))
        else:
            field = AnswerField("Write what is not clear or not right", "Keep the comment")
            field.given.connect(self.comment_wanted)
        field.left.connect(self._leave)
        field.text.textChanged.connect(lambda: self.typed.emit(kind, to, field.written))
        self.field = field
        self._text.addWidget(field)
        # At once: a field that is not shown yet cannot take the focus.
        field.show()
        return field

    def _leave(self) -> None:
        self.leave_field()
        self.left.emit()

    def _button(self, words: str, name: str, tip: str) -> QPushButton:
        made = QPushButton(f" {words}")
        made.setIcon(self._icon(name, False))
        made.setToolTip(tip_text(tip))
        made.setAccessibleName(plain_text(f"{words}: {self.reviewed.line.heading}"))
        return made

    def _icon(self, name: str, primary: bool) -> QIcon:
        tokens = self._looks.tokens
        return icon(name, tokens, 16, tokens.onacc if primary else None)

    def _dress_buttons(self) -> None:
        tokens, one = self._looks.tokens, self.reviewed
        if one.approval is not None:
            self.approve.setText(" Approved")
            self.approve.setProperty("kind", "approved")
            self.approve.setIcon(icon("check", tokens, 16, tokens.ok))
            self.approve.setToolTip(tip_text("Take the approval back (Y)"))
        many = len(one.open_comments)
        if many:
            self.ask.setText(f" {many} comment{'' if many == 1 else 's'}")
            self.ask.setProperty("kind", "asked")
            self.ask.setIcon(icon("slip", tokens, 16, tokens.risk))

    def _fill(self) -> None:
        one, line = self.reviewed, self.reviewed.line
        heading = _wrapped(line.heading, "readHeading")
        self._text.addWidget(heading)
        flags = [label(words, role) for words, role in self._flags()]
        if flags:
            self._text.addLayout(row(*flags, None))
        if line.text:
            self._text.addWidget(_wrapped(" ".join(line.text), "readText"))
        self._add_meta(line)
        self._add_inner(line, 0)
        if one.approval is not None and one.approval.text:
            self._text.addWidget(_wrapped(f"Your remark: {one.approval.text}", "readSmall"))
        for other in one.others:
            note = f": {other.text}" if other.text else ""
            self._text.addWidget(_wrapped(f"Approved by {signed(other)}{note}", "readSmall"))
        for comment in one.comments:
            former = "" if comment.entry.line == line.key else comment.entry.heading
            view = CommentView(comment, comment.entry.id in self._looks.closable, former)
            view.reply_wanted.connect(self.write_reply)
            view.close_wanted.connect(self.close_wanted)
            self._text.addWidget(view)
        self._text.addWidget(self.notation)

    def _flags(self) -> Iterator[tuple[str, str]]:
        if self.reviewed.line.open_point:
            yield "open: needs a remark", "flagOpen"
        if self._looks.changed:
            yield "changed since signed", "flagChanged"
        elif self.reviewed.was_approved:
            yield "changed since you approved it", "flagChanged"

    def _add_meta(self, line: ReadingLine, indent: int = 0) -> None:
        sources = (("slip", words) for words in line.sources)
        for name, words in (("person", line.who), ("eye", line.check), *sources):
            if not words:
                continue
            picture = Label()
            tokens, side = self._looks.tokens, round(16 * self._looks.size)
            picture.setPixmap(pixmap(name, tokens.tx2, tokens.surf, side, self.devicePixelRatioF()))
            across = row(indent, picture, spacing=8)
            across.setAlignment(picture, Qt.AlignmentFlag.AlignTop)
            across.addWidget(_wrapped(words, "readMeta"), 1)
            self._text.addLayout(across)

    def _add_inner(self, line: ReadingLine, depth: int) -> None:
        for one in line.inner[:MOST_INNER]:
            mark = f"{one.mark}  " if one.mark else ""
            across = row(16 * (depth + 1))
            across.addWidget(_wrapped(f"{mark}{one.heading}", "readInner"), 1)
            self._text.addLayout(across)
            if one.text:
                across = row(16 * (depth + 1))
                across.addWidget(_wrapped(" ".join(one.text), "readMeta"), 1)
                self._text.addLayout(across)
            self._add_meta(one, 16 * (depth + 1))
            self._add_inner(one, depth + 1)
        if len(line.inner) > MOST_INNER:
            more = len(line.inner) - MOST_INNER
            self._text.addWidget(_wrapped(f"And {more:,} more; the report has them.", "readMeta"))


def state_of(one: ReviewedLine) -> str:
    """How far the answer of a line is."""
    if one.open_comments:
        return ASKED
    return ANSWERED if one.approval is not None else OPEN


def spoken(one: ReviewedLine, changed: bool) -> str:
    """A line as a screen reader says it."""
    state = {ANSWERED: "approved by you", ASKED: "with an open comment"}
    parts = [
        f"Step {one.line.mark}" if one.line.mark.isdigit() else "",
        state.get(state_of(one), "not answered"),
        "open, needs a remark" if one.line.open_point else "",
        "changed since signed" if changed else "",
        *(words for words in one.line.words if words != one.line.mark),
        *(told(comment) for comment in one.comments),
    ]
    return ". ".join(part.rstrip(".") for part in parts if part)


def _wrapped(text: str, role: str) -> Label:
    made = label(text, role)
    made.setWordWrap(True)
    return made
