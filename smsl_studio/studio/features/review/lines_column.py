"""The middle column: one part of the reading, line by line."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QApplication, QPushButton, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.front.review_matter import ReviewMatter
from smsl_studio.inspection.reading.sections import ReadingSection
from smsl_studio.inspection.review.review import ReviewComment
from smsl_studio.inspection.review.reviewed import ReviewedLine, ReviewedReading
from smsl_studio.studio.base.controls import Label, label, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.review.comment_view import CommentView
from smsl_studio.studio.features.review.line_card import NARROW, LineCard, LineLooks

_LINES = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Right)
AT_ONCE = 40
"""So many lines are made at once. The others are made when they are asked for."""


class LinesColumn(QScrollArea):
    """The lines of one part. ``at`` is the key of the line at hand."""

    card_made = Signal(object)
    """LineCard: a line was made, so that somebody can listen to it."""
    close_wanted = Signal(object)
    """ReviewComment: close a comment on a line that is gone."""
    next_wanted = Signal()
    size_wanted = Signal()

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.size_factor = 1.0
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("The reading")
        self.cards: list[LineCard] = []
        self.at = ""
        self.torn = ""
        """The key of the line whose field was taken from under the hands of the person, until the
        field is there again, or the person goes elsewhere. In between letters are no keys."""
        self._lines: tuple[ReviewedLine, ...] = ()
        self._looks: Callable[[ReviewedLine], LineLooks] = self._no_looks
        self._make_parts()
        self._width = 0
        self._fit = QTimer(self)
        self._fit.setSingleShot(True)
        self._fit.setInterval(80)
        self._fit.timeout.connect(self._show_cards)
        self.show_hint("")

    def _make_parts(self) -> None:
        """Make the head, the place of the lines, the foot and the hint."""
        self._title, self._lead = _wrapped("readTitle"), _wrapped("readLead")
        self._section, self._about = _wrapped("readHeading"), _wrapped("readLead")
        self.size_button = QPushButton("Aa  Text size")
        self.size_button.setToolTip(tip_text("Larger text (Ctrl++); after the largest the usual"))
        self.size_button.clicked.connect(self.size_wanted)
        self.hint = _wrapped("readLead")
        self.hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._body = QVBoxLayout()
        self._body.setSpacing(0)
        self.more = QPushButton("Show more lines")
        self.more.clicked.connect(self.show_more)
        self._next_words = label("", "readMeta")
        self._next_words.setWordWrap(True)
        self.next = QPushButton("Go there")
        self.next.clicked.connect(self.next_wanted)
        self._foot = QWidget()
        foot = row(self._next_words, self.next, spacing=12)
        foot.setStretch(0, 1)
        foot.setContentsMargins(20, 16, 20, 20)
        self._foot.setLayout(foot)
        self._head = QWidget()
        above = QVBoxLayout(self._head)
        above.setContentsMargins(20, 16, 20, 12)
        above.setSpacing(6)
        title = row(self._title, self.size_button, spacing=16)
        title.setStretch(0, 1)
        title.setAlignment(self.size_button, Qt.AlignmentFlag.AlignTop)
        above.addLayout(title)
        above.addWidget(self._lead)
        self._gone = QVBoxLayout()
        above.addLayout(self._gone)
        above.addSpacing(10)
        above.addWidget(self._section)
        above.addWidget(self._about)
        inner = QWidget()
        inner.setProperty("role", "side")
        column = QVBoxLayout(inner)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._head)
        column.addLayout(self._body)
        column.addWidget(self.more, 0, Qt.AlignmentFlag.AlignHCenter)
        column.addWidget(self._foot)
        column.addWidget(self.hint, 1)
        column.addStretch(1)
        self.setWidget(inner)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.next.setIcon(icon("chevron-right", tokens, 14, tokens.tx))
        self._show_cards()

    def show_hint(self, words: str) -> None:
        """Show a sentence in place of the reading."""
        self._clear()
        self.hint.setText(words)
        self.hint.setVisible(bool(words))
        for part in (self._head, self.more, self._foot):
            part.hide()

    def show_section(
        self, matter: ReviewMatter, seen: ReviewedReading, section: ReadingSection,
        closable: Callable[[ReviewComment], bool],
    ) -> None:  # fmt: skip
        """Show the lines of a part. ``closable`` says which comments this person may close."""
        self.hint.hide()
        for part in (self._head, self._foot):
            part.show()
        self._title.setText(matter.reading.title)
        self._lead.setText(matter.reading.purpose)
        self._section.setText(section.heading)
        self._about.setText(section.lead)
        self._about.setVisible(bool(section.lead))
        self._show_gone(seen.loose, closable)
        self._lines = seen.of_section(section.key)
        changed = matter.changed if matter.former else frozenset()

        def looks(one: ReviewedLine) -> LineLooks:
            """What the card of a line needs."""
            own = frozenset(c.entry.id for c in one.comments if closable(c))
            return LineLooks(
                self._tokens, self.size_factor, self._is_narrow(), one.line.key in changed, own
            )

        self._looks = looks
        if self.at not in {one.line.key for one in self._lines}:
            self.at = self._lines[0].line.key if self._lines else ""
        self._show_cards()

    def _show_gone(
        self, comments: tuple[ReviewComment, ...], closable: Callable[[ReviewComment], bool]
    ) -> None:
        """Show open comments on lines that the reading does not have any more."""
        while (item := self._gone.takeAt(0)) is not None:
            old = item.widget()
            if old is not None:
                old.hide()
                old.deleteLater()
        for comment in comments:
            if comment.is_open:
                view = CommentView(comment, closable(comment), comment.entry.heading)
                view.reply.hide()
                view.close_wanted.connect(self.close_wanted)
                self._gone.addWidget(view)

    def show_next(self, section: ReadingSection | None, lines: int) -> None:
        """Say which part comes next."""
        self.next.setVisible(section is not None)
        if section is None:
            self._next_words.setText("This is the last part.")
        else:
            many = f"{lines} line{'' if lines == 1 else 's'}"
            self._next_words.setText(f"Next: {section.heading}, {many}")

    def show_more(self) -> None:
        """Make the next lines of a long part."""
        made = len(self.cards)
        for one in self._lines[made : made + AT_ONCE]:
            self._add(one)
        self._tell_more()

    def card(self, key: str) -> LineCard | None:
        """The card of a line; it is made first if it is far down. None if the part has no such
        line.
        """
        while key not in {card.reviewed.line.key for card in self.cards}:
            if len(self.cards) == len(self._lines):
                return None
            self.show_more()
        return next(card for card in self.cards if card.reviewed.line.key == key)

    def take(self, key: str, focus: bool) -> None:
        """Make a line the one at hand, and show it."""
        self.at, self.torn = key, ""
        for card in self.cards:
            card.show_here(card.reviewed.line.key == key)
        chosen = self.card(key)
        if chosen is not None:
            chosen.show_here(True)
            if focus and not chosen.hasFocus():
                chosen.setFocus()
            # A card that was just made has its place a moment later.
            QTimer.singleShot(0, chosen, lambda: self.ensureWidgetVisible(chosen, 0, 24))

    def has_focus(self) -> bool:
        """Whether a line, or something in it, has the keyboard focus."""
        focus = QApplication.focusWidget()
        return focus is not None and any(
            card is focus or card.isAncestorOf(focus) for card in self.cards
        )

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave the arrows to the page, which goes from line to line."""
        if event.key() in _LINES:
            event.ignore()
        else:
            super().keyPressEvent(event)

    def show_field(self, card: LineCard) -> None:
        """Scroll so far that the field of a line is seen."""
        field = card.field
        if field is not None:
            QTimer.singleShot(0, field, lambda: self.ensureWidgetVisible(field, 0, 24))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Lay the lines out again if the width has changed much."""
        super().resizeEvent(event)
        if abs(self.viewport().width() - self._width) > 8 and self._lines:
            self._fit.start()

    def _show_cards(self) -> None:
        """Show the lines. A card whose line and looks are as before stays, with what is written in
        it.
        """
        focused = self.has_focus()
        self._width = self.viewport().width()
        many = max(AT_ONCE, len(self.cards))
        wanted = self._lines[:many]
        for place, one in enumerate(wanted):
            old = self.cards[place] if place < len(self.cards) else None
            looks = self._looks(one)
            if old is not None and old.is_of(one, looks):
                continue
            card = LineCard(one, looks)
            self._body.insertWidget(place, card)
            card.show()
            if old is not None:
                if focused and one.line.key == self.at and not self._is_written(old):
                    # First: else the focus of the old card would go to another line.
                    card.setFocus()
                self._drop(old)
                self.cards[place] = card
            else:
                self.cards.append(card)
            self.card_made.emit(card)
            if card.field is not None and old is not None and old.field is not None:
                card.field.stand_as(old.field)
        while len(self.cards) > len(wanted):
            self._drop(self.cards.pop())
        self._tell_more()
        for card in self.cards:
            here = card.reviewed.line.key == self.at
            card.show_here(here)
            if focused and here and card.field is None:
                card.setFocus()
        self._give_back()

    def _give_back(self) -> None:
        """Give the keys back to the field from which they were taken."""
        if not self.torn or QApplication.focusWidget() is not self:
            return
        card = next((one for one in self.cards if one.reviewed.line.key == self.torn), None)
        if card is None or card.field is None:
            card = next((one for one in self.cards if one.field is not None), None)
        if card is not None and card.field is not None:
            card.field.text.setFocus()
            if card.field.text.hasFocus():
                self.torn = ""

    def _is_written(self, card: LineCard) -> bool:
        focus = QApplication.focusWidget()
        return card.field is not None and focus is not None and card.field.isAncestorOf(focus)

    def _is_narrow(self) -> bool:
        return self.viewport().width() < NARROW * self.size_factor

    def _drop(self, card: LineCard) -> None:
        if self._is_written(card):
            # Else the keys would go to whatever comes next, such as another line.
            self.torn = card.reviewed.line.key
            self.setFocus()
        self._body.removeWidget(card)
        card.hide()
        card.deleteLater()

    def _add(self, one: ReviewedLine) -> None:
        card = LineCard(one, self._looks(one))
        self.cards.append(card)
        self._body.addWidget(card)
        card.show()
        self.card_made.emit(card)

    def _tell_more(self) -> None:
        left = len(self._lines) - len(self.cards)
        self.more.setVisible(left > 0)
        self.more.setText(f"Show {min(left, AT_ONCE)} more of {left} lines")

    def _clear(self) -> None:
        for card in self.cards:
            self._drop(card)
        self.cards = []

    def _no_looks(self, one: ReviewedLine) -> LineLooks:
        return LineLooks(self._tokens, self.size_factor, True, False, frozenset())


def _wrapped(role: str) -> Label:
    made = label("", role)
    made.setWordWrap(True)
    return made
