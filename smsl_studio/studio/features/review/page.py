"""The body of the mode Review: contents, the reading in lines, changes and signing.

Nothing here edits the blueprint. The page hears the keys: arrows go from line to line, Y approves,
C comments, Ctrl with plus and minus changes the size of the text.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QRect, Qt, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QApplication, QHBoxLayout, QStackedWidget, QWidget

from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords
from smsl_studio.inspection.review.review import ReviewComment
from smsl_studio.inspection.review.review_file import LONG_NAME, MOST_ABOUT
from smsl_studio.inspection.review.reviewed import ReviewedLine
from smsl_studio.studio.base.drawer import Drawer
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.review.answer_field import AnswerField
from smsl_studio.studio.features.review.contents import WIDE as CONTENTS
from smsl_studio.studio.features.review.contents import ContentsColumn
from smsl_studio.studio.features.review.drafts import ReviewDraft, ReviewDrafts
from smsl_studio.studio.features.review.line_card import LineCard
from smsl_studio.studio.features.review.lines_column import LinesColumn
from smsl_studio.studio.features.review.open_review import OpenReview
from smsl_studio.studio.features.review.review_bar import ReviewBar
from smsl_studio.studio.features.review.review_style import SIDE, TextSize, review_sheet
from smsl_studio.studio.features.review.side_column import WIDE as BESIDE
from smsl_studio.studio.features.review.side_column import SideColumn

NOTHING = "Nothing to review yet. Draw the first state, or open a procedure."
MAKING = "The procedure is being read. A large one takes some seconds."
TIGHT = 1120
"""In a narrower page (pixels) the contents are a drawer, which a button of the bar opens."""


class ReviewPage(QWidget):
    """The page. ``bar`` is its row of the mode bar."""

    sign_wanted = Signal(bool)
    """bool: whether the signature rejects."""
    watch_wanted = Signal(object)
    """ReviewedLine: play this step."""
    print_wanted = Signal()

    def __init__(
        self, review: OpenReview, drafts: ReviewDrafts, settings: Settings, tokens: Tokens
    ) -> None:
        super().__init__()
        self._review, self._tokens = review, tokens
        self._drafts, self._person = drafts, ""
        self.setAccessibleName("Review")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.bar = ReviewBar(tokens)
        self.contents, self.side = ContentsColumn(tokens), SideColumn(tokens)
        self.reading = LinesColumn(tokens)
        self.right = QStackedWidget()
        self.right.addWidget(self.side)
        self.approval: ApprovalWords = UNINSPECTED
        self.blocked = ""
        """Why nobody may sign, besides what is open in the review itself."""
        self._section = self._sought = ""
        self._size = TextSize(settings)
        self.drawer = Drawer(self, self._drawer_area, lambda: self, "Contents")
        across = self._across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(1)
        across.addWidget(self.contents)
        across.addWidget(self.reading, 1)
        across.addWidget(self.right)
        self._connect()
        self._dress()
        self.refresh()

    def _connect(self) -> None:
        self._review.changed.connect(self.refresh)
        self.contents.section_wanted.connect(self.show_section)
        self.contents.watch_wanted.connect(self.watch)
        self.contents.print_wanted.connect(self.print_wanted)
        self.reading.card_made.connect(self._listen)
        self.reading.next_wanted.connect(self._to_next_section)
        self.reading.close_wanted.connect(self._review.close)
        self.reading.size_wanted.connect(self.next_size)
        self.bar.contents_wanted.connect(self.drawer.toggle)
        self.drawer.toggled.connect(self.bar.contents.setChecked)
        self.bar.previous_wanted.connect(lambda: self.step(-1))
        self.bar.next_wanted.connect(self.next_open)
        self.side.hazard_wanted.connect(self.show_line)
        self.side.sign_wanted.connect(lambda: self.sign_wanted.emit(False))
        self.side.reject_wanted.connect(lambda: self.sign_wanted.emit(True))

    # What is shown.

    def refresh(self) -> None:
        """Show the present reading and its answers."""
        review, author = self._review, self._review.author
        self.bar.show_person(author.person, author.role)
        if author.person != self._person:
            self._person = author.person
            for card in self.reading.cards:
                card.put_away()
        if self.isVisible():
            review.read()
        seen, matter = review.seen, review.matter
        if seen is None or matter is None:
            self.reading.show_hint(review.fault or (MAKING if review.is_making else NOTHING))
            self.contents.show_seen(None, "")
        else:
            keys = [one.key for one in seen.sections]
            if self._section not in keys:
                self._section = keys[0] if keys else ""
            at = next((one for one in seen.sections if one.key == self._section), None)
            if at is None:
                self.reading.show_hint(NOTHING)
            else:
                self.reading.show_section(matter, seen, at, self._may_close)
                for card in self.reading.cards:
                    self._restore(card)
                place = keys.index(at.key) + 1
                after = seen.sections[place] if place < len(keys) else None
                self.reading.show_next(after, len(seen.of_section(after.key)) if after else 0)
            self.contents.show_seen(seen, self._section)
            if self._sought:
                self.show_comment(self._sought)
        self.side.show_matter(matter, seen)
        self._show_signing()
        self.side.reject.setEnabled(seen is not None)
        for button in (self.bar.previous, self.bar.next):
            button.setEnabled(seen is not None)

    def _show_signing(self) -> None:
        seen, fault = self._review.seen, self._review.fault
        reasons = seen.why_not_signed() if seen is not None else ("There is no reading yet.",)
        if fault and seen is not None:
            reasons = (fault, *reasons)
        if self.blocked and seen is not None:
            reasons = (self.blocked, *reasons)
        begun = [one.heading for one in self._drafts.begun(self._person)]
        if begun:
            reasons = (f"What you write at “{begun[0]}” is not kept yet.", *reasons)
        self.side.show_signing(reasons, self.approval, self._person)

    def show_approval(self, said: ApprovalWords) -> None:
        """Show who has signed."""
        self.approval = said
        self.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for part in (self.bar, self.contents, self.side, self.reading):
            part.set_tokens(tokens)
        self._dress()
        self.refresh()

    def showEvent(self, event: QShowEvent) -> None:
        """Make the reading, and look for answers of others."""
        super().showEvent(event)
        self._review.look()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Make a drawer of the contents in a narrow page."""
        super().resizeEvent(event)
        self._fit()

    # Where the person is.

    @property
    def line(self) -> ReviewedLine | None:
        """The line at hand; None if there is none."""
        seen = self._review.seen
        lines = () if seen is None else seen.of_section(self._section)
        return next((one for one in lines if one.line.key == self.reading.at), None)

    def show_section(self, key: str) -> None:
        """Show the lines of a part, from its first one."""
        self._section, self.reading.at = key, ""
        self.drawer.close_drawer()
        self.refresh()
        self.reading.verticalScrollBar().setValue(0)
        self.take_hand()

    def show_line(self, key: str) -> None:
        """Show a line, in whatever part it is."""
        seen = self._review.seen
        found = next((o for o in seen.lines if o.line.key == key), None) if seen else None
        if found is not None:
            if found.section.key != self._section:
                self._section, self.reading.at = found.section.key, key
                self.refresh()
            self.reading.take(key, focus=True)

    def show_comment(self, name: str) -> None:
        """Show the line that has a comment; ``name`` is the id of the comment."""
        seen = self._review.seen
        self._sought = "" if seen is not None else name
        for one in seen.lines if seen is not None else ():
            if any(comment.entry.id == name for comment in one.comments):
                self.show_line(one.line.key)
                return

    def step(self, by: int) -> None:
        """Go so many lines on, also into another part."""
        lines = self._review.seen.lines if self._review.seen is not None else ()
        keys = [one.line.key for one in lines]
        if not keys:
            return
        here = keys.index(self.reading.at) if self.reading.at in keys else -by
        self.show_line(keys[max(0, min(len(keys) - 1, here + by))])

    def next_open(self) -> None:
        """Go to the next line without an answer; after the last one, to the first."""
        lines = self._review.seen.lines if self._review.seen is not None else ()
        keys = [one.line.key for one in lines]
        start = keys.index(self.reading.at) + 1 if self.reading.at in keys else 0
        for one in (*lines[start:], *lines[:start]):
            if not one.is_answered:
                self.show_line(one.line.key)
                return

    def watch(self) -> None:
        """Ask to play the step at hand."""
        one = self.line
        if one is not None:
            self.watch_wanted.emit(one)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Hear the keys of the page."""
        key, held = event.key(), event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        card = self.reading.card(self.reading.at) if self.reading.at else None
        call: Callable[[], object] | None = None
        if held in (Qt.KeyboardModifier.ControlModifier, _CTRL_SHIFT):
            call = {
                Qt.Key.Key_Plus: lambda: self.set_size(1),
                Qt.Key.Key_Equal: lambda: self.set_size(1),
                Qt.Key.Key_Minus: lambda: self.set_size(-1),
                Qt.Key.Key_0: lambda: self.set_size(0),
            }.get(Qt.Key(key))
        elif not held and key in _ON_LINE and not self._hears_letters():
            call = self._go_on_writing
        elif not held:
            call = {
                Qt.Key.Key_Down: lambda: self.step(1),
                Qt.Key.Key_Up: lambda: self.step(-1),
                Qt.Key.Key_Right: self.next_open,
                Qt.Key.Key_Y: card.toggle if card is not None else None,
                Qt.Key.Key_C: card.write_comment if card is not None else None,
                Qt.Key.Key_W: self.watch,
            }.get(Qt.Key(key))
        if call is None:
            super().keyPressEvent(event)
        else:
            call()

    def _hears_letters(self) -> bool:
        """Whether a letter is a key of the page: the page or a line has the focus, and nobody
        writes."""
        focus = QApplication.focusWidget()
        here = focus in (self, self.reading) or self.reading.has_focus()
        return here and not self.reading.torn and self._open_field() is None

    def _open_field(self) -> AnswerField | None:
        return next((card.field for card in self.reading.cards if card.field is not None), None)

    def _go_on_writing(self) -> None:
        """Lead the keys to the field that is open, instead of taking a letter for an answer."""
        card = next((one for one in self.reading.cards if one.field is not None), None)
        if card is not None and card.field is not None:
            card.field.text.setFocus()
            self.reading.show_field(card)

    # The size of the text.

    def next_size(self) -> None:
        """Choose the next larger text; after the largest the usual one."""
        self._resize(self._size.next())

    def set_size(self, by: int) -> None:
        """Choose larger (1) or smaller (-1) text, or the usual one (0)."""
        self._resize(self._size.step(by))

    def _resize(self, changed: bool) -> None:
        if changed:
            self._dress()
            self.refresh()

    def _dress(self) -> None:
        factor = self.reading.size_factor = self._size.factor
        self.setStyleSheet(review_sheet(self._tokens, factor))
        side = min(factor, SIDE)
        self.contents.setFixedWidth(round(CONTENTS * side))
        self._fit()

    def _fit(self) -> None:
        narrow = self.width() < TIGHT * min(self._size.factor, 1.2)
        if narrow != self.bar.contents.isVisibleTo(self.bar):
            self.drawer.close_drawer()
            self.bar.contents.setVisible(narrow)
            if narrow:
                self.drawer.take(self.contents)
            else:
                self._across.insertWidget(0, self.contents)
            self.contents.show()
        self.right.setFixedWidth(min(round(self.width() * 0.34), BESIDE + 60))

    def _drawer_area(self) -> QRect:
        return QRect(0, 0, self.contents.width() + 2, self.height())

    # What is asked of a line.

    def _listen(self, card: LineCard) -> None:
        review = self._review
        card.entered.connect(lambda: self._entered(card))
        card.grew.connect(lambda: self.reading.show_field(card))
        card.typed.connect(lambda kind, to, text: self._typed(card, kind, to, text))
        card.left.connect(lambda: self._left(card.reviewed))
        card.may_write, card.notation_of = review.may_answer, review.notation_of
        card.approve_wanted.connect(lambda note: self._approve(card, note))
        card.take_back_wanted.connect(lambda: review.take_back(card.reviewed))
        card.comment_wanted.connect(lambda text: self._say(card, text))
        card.reply_wanted.connect(lambda comment, text: self._reply(card, comment, text))
        card.close_wanted.connect(review.close)
        self._restore(card)

    def _entered(self, card: LineCard) -> None:
        key = card.reviewed.line.key
        for other in self.reading.cards:
            if other is not card and other.field is not None and not other.field.written.strip():
                other.put_away()
                self._left(other.reviewed)
        if key != self.reading.at:
            self.reading.take(key, focus=False)

    def _approve(self, card: LineCard, note: str) -> None:
        kept = self._review.approve(card.reviewed, note)
        if note:
            self._close_field(card, kept)

    def _say(self, card: LineCard, text: str) -> None:
        self._close_field(card, self._review.comment(card.reviewed, text))

    def _reply(self, card: LineCard, comment: ReviewComment, text: str) -> None:
        self._close_field(card, self._review.reply(comment, text))

    # What is written and not kept yet.

    def _typed(self, card: LineCard, kind: str, to: str, text: str) -> None:
        at = card.reviewed
        about = tuple(str(one)[:LONG_NAME] for one in at.line.about[:MOST_ABOUT])
        heading = at.line.heading[:LONG_NAME]
        self._drafts.put(
            ReviewDraft(kind, self._person, at.line.key, at.section.key, heading, about, to, text)
        )
        self._show_signing()

    def _left(self, at: ReviewedLine) -> None:
        self._drafts.drop(self._person, at.line.key)
        self._show_signing()

    def _close_field(self, card: LineCard, kept: bool) -> None:
        """Close the field of a line if its text is kept; else the text stays."""
        if kept:
            self._left(card.reviewed)
            # The answer may have made another card of this line.
            now = self.reading.card(card.reviewed.line.key)
            if now is not None:
                now.leave_field()

    def _restore(self, card: LineCard) -> None:
        """Open the field of a line again if something was begun there."""
        seen = self._review.seen
        if seen is None or card.field is not None:
            return
        draft = self._drafts.of_line(card.reviewed, seen.lines, self._person)
        if draft is not None:
            card.begin(draft)

    def _may_close(self, comment: ReviewComment) -> bool:
        return self._review.author.may_close(comment)

    def _to_next_section(self) -> None:
        seen = self._review.seen
        keys = [one.key for one in seen.sections] if seen is not None else []
        place = keys.index(self._section) + 1 if self._section in keys else len(keys)
        if place < len(keys):
            self.show_section(keys[place])

    def take_hand(self) -> None:
        """Let the chosen line have the keys."""
        if self.reading.at:
            self.reading.take(self.reading.at, focus=True)


_ON_LINE = (Qt.Key.Key_Y, Qt.Key.Key_C, Qt.Key.Key_W)
_CTRL_SHIFT = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
