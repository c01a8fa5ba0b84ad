"""The column of the start page: everything on it, and where it stands."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from functools import partial
from itertools import pairwise
from pathlib import Path

from PySide6.QtCore import QRect, QRectF, Qt, Signal
from PySide6.QtGui import QFont, QKeyEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.front.approval_badge import ApprovalWords
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.theme import RADIUS_CARD, Tokens, text_font
from smsl_studio.studio.features.start import cards, recent, samples
from smsl_studio.studio.features.start.arrows import nearest
from smsl_studio.studio.features.start.links import LinkCard
from smsl_studio.studio.features.start.thumbnails import FileLook
from smsl_studio.studio.features.start.tile import ARROWS, Tile, paint_key

WIDE, SIDE = 1120, 24
"""The width of the column, and the least room at its sides (pixels)."""
GAP, LIST = 20, 396
BESIDE = 1180
"""In a page narrower than this the samples stand under the recent files."""
STACKED = 700
"""In a column narrower than this the cards stand below each other."""
TITLE = "Draw a procedure as states and operations. Check it, then run it in physics."
WHO = "Engineers draw it, clinicians review it, and a run steps through it in a simulated world."
HINTS = (
    ("", "Arrows move"),
    ("Enter", "opens"),
    ("Ctrl K", "finds any command"),
    ("F1", "explains what has the focus"),
)


class Column(QWidget):
    """Places the parts for the width that it has, and moves the focus with the arrows."""

    new_wanted = Signal()
    open_wanted = Signal()
    try_wanted = Signal()
    help_wanted = Signal()
    rules_wanted = Signal()
    texts_wanted = Signal()
    file_wanted = Signal(Path)
    sample_wanted = Signal(Path)
    removed = Signal(Path)
    """A recent file shall no longer be listed."""
    focused = Signal()

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.setAccessibleName("Start")
        self.title = self._words(TITLE, "", text_font(24, 600))
        self.who = self._words(WHO, "second", text_font(14))
        self.cards = (
            cards.StartCard(cards.NEW, cards.new_art, tokens, self),
            cards.StartCard(cards.OPEN, cards.open_art, tokens, self),
            cards.StartCard(cards.TRY, cards.try_art, tokens, self),
        )
        self._recent_title = self._words("Recent", "heading", text_font(16, 600))
        self.show_all = QPushButton(self)
        self.show_all.setProperty("role", "link")
        self.rows: tuple[recent.RecentRow, ...] = ()
        self._frame = QRect()
        self._samples_title = self._words("Samples", "heading", text_font(16, 600))
        self._copies = self._words("Each opens as a copy. The original stays.", "small", None)
        self.samples = tuple(
            samples.SampleCard(path, sample, tokens, self)
            for path, sample in samples.shown_samples()
        )
        self.links = LinkCard(tokens, self)
        self._all = False
        self._connect()
        self.arrange()

    def _words(self, text: str, role: str, font: QFont | None) -> Label:
        made = label(text, role, self)
        if font is not None:
            made.setFont(font)
        return made

    def _connect(self) -> None:
        new, opened, tried = self.cards
        new.clicked.connect(self.new_wanted)
        opened.clicked.connect(self.open_wanted)
        tried.clicked.connect(self.try_wanted)
        self.links.help.clicked.connect(self.help_wanted)
        self.links.rules.clicked.connect(self.rules_wanted)
        self.links.texts.clicked.connect(self.texts_wanted)
        self.show_all.clicked.connect(self._show_all)
        for card in self.samples:
            card.clicked.connect(partial(self.sample_wanted.emit, card.path))
        for tile in (*self.cards, *self.samples, *self.links.tiles):
            tile.focused.connect(self._moved)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for tile in self.tiles:
            tile.set_tokens(tokens)
        self.links.set_tokens(tokens)
        self.update()

    @property
    def tiles(self) -> tuple[Tile, ...]:
        """Everything that the arrows reach, in the order of reading."""
        return (*self.cards, *self.rows, *self.samples, *self.links.tiles)

    @property
    def current(self) -> Tile | None:
        """The tile with the keyboard focus."""
        return next((tile for tile in self.tiles if tile.hasFocus()), None)

    # The recent files.

    def show_recent(self, files: Sequence[tuple[Path, datetime | None]]) -> bool:
        """Show these files; returns whether they differ from those that are shown."""
        now = datetime.now().astimezone()
        shown = [(path, recent.opened_words(then, now)) for path, then in files]
        if shown == [(row.path, row.opened) for row in self.rows]:
            return False
        kept = next((at for at, row in enumerate(self.rows) if row.hasFocus()), None)
        for row in self.rows:
            row.hide()
            row.deleteLater()
        self.rows = tuple(recent.RecentRow(*one, self._tokens, self) for one in shown)
        for row in self.rows:
            row.clicked.connect(partial(self.file_wanted.emit, row.path))
            row.remove.clicked.connect(partial(self.removed.emit, row.path))
            row.focused.connect(self._moved)
        self._order()
        self.arrange()
        if kept is not None:
            (*self.rows[kept : kept + 1], *self.rows[-1:], self.cards[0])[0].setFocus()
        return True

    def show_found(self, path: Path, found: FileLook) -> None:
        """Show what was found at a path."""
        for row in self.rows:
            if row.path == path:
                row.show_found(found)
        for card in self.samples:
            if card.path == path:
                card.show_miniature(found.miniature)

    def show_trust(self, path: Path, said: ApprovalWords | None) -> None:
        """Show whether people have signed a recent file; None if it cannot be read."""
        for row in self.rows:
            if row.path == path:
                row.show_trust(said)

    def _show_all(self) -> None:
        self._all = True
        self.arrange()
        self.rows[recent.FIRST].setFocus()

    def _order(self) -> None:
        """Let Tab visit the parts in the order of reading."""
        parts: list[QWidget] = [*self.cards, self.show_all]
        for row in self.rows:
            parts += [row, row.remove]
        parts += [*self.samples, *self.links.tiles]
        for before, after in pairwise(parts):
            self.setTabOrder(before, after)

    # Where everything stands.

    def arrange(self) -> None:
        """Place all parts for the present width."""
        wide = min(WIDE, self.width() - 2 * SIDE)
        left = (self.width() - wide) // 2
        top = self._place_cards(left, wide, self._place_words(left, wide))
        beside = self.width() >= BESIDE
        rows = bool(self.rows)
        narrow = LIST if beside else wide
        ends = self._place_recent(left, narrow, top) if rows else top
        for part in (self._recent_title, self.show_all):
            part.setVisible(rows and (part is not self.show_all or not self._shows_all))
        at = left + LIST + 36 if rows and beside else left
        under = ends + 28 if rows and not beside else top
        ends = max(ends, self._place_samples(at, left + wide - at, under))
        self._hints = QRect(left, ends + 36, wide, 20)
        self.setMinimumHeight(ends + 36 + 20 + 24)
        self.update()

    @property
    def _shows_all(self) -> bool:
        return self._all or len(self.rows) <= recent.FIRST

    def _place_words(self, left: int, wide: int) -> int:
        top = 36
        for part, gap in ((self.title, 10), (self.who, 22)):
            part.setWordWrap(True)
            high = part.heightForWidth(wide)
            part.setGeometry(left, top, wide, high)
            top += high + gap
        return top

    def _place_cards(self, left: int, wide: int, top: int) -> int:
        stacked = wide < STACKED
        each = wide if stacked else (wide - 2 * GAP) // 3
        for at, card in enumerate(self.cards):
            across, down = (0, at) if stacked else (at, 0)
            card.setGeometry(
                left + across * (each + GAP), top + down * (cards.HIGH + 12), each, cards.HIGH
            )
        return top + cards.HIGH + (2 * (cards.HIGH + 12) if stacked else 0) + 34

    def _place_recent(self, left: int, wide: int, top: int) -> int:
        self._recent_title.setGeometry(left, top, wide // 2, 26)
        self.show_all.setText(f"Show all {len(self.rows)}")
        self.show_all.adjustSize()
        self.show_all.move(left + wide - self.show_all.width(), top + 2)
        shown = self.rows if self._shows_all else self.rows[: recent.FIRST]
        first = top + 38
        for at, row in enumerate(self.rows):
            row.setVisible(at < len(shown))
            row.setGeometry(left + 8, first + 4 + at * recent.PITCH, wide - 16, recent.HIGH)
        self._frame = QRect(left, first, wide, len(shown) * recent.PITCH)
        return first + self._frame.height()

    def _place_samples(self, left: int, wide: int, top: int) -> int:
        self._samples_title.setGeometry(left, top, 120, 26)
        self._copies.adjustSize()
        self._copies.move(left + wide - self._copies.width(), top + 6)
        self._copies.setVisible(wide >= 400)
        count = max(1, (wide + GAP) // (samples.WIDE + GAP))
        each = (wide + GAP) // count - GAP
        first = top + 38
        for at, card in enumerate((*self.samples, self.links)):
            across, down = at % count, at // count
            card.setGeometry(
                left + across * (each + GAP),
                first + down * (samples.HIGH + GAP),
                each,
                samples.HIGH,
            )
        lines = -(-(len(self.samples) + 1) // count)
        return first + lines * (samples.HIGH + GAP) - GAP

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place all parts for the new width."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.arrange()

    # Keys and painting.

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows move the focus to the next tile in their direction."""
        tile = self.current
        if event.key() not in ARROWS or tile is None:
            super().keyPressEvent(event)
            return
        there = nearest(tile, [one for one in self.tiles if one.isVisible()], event.key())
        if there is not None:
            there.setFocus(Qt.FocusReason.OtherFocusReason)

    def _moved(self) -> None:
        self.update()
        self.focused.emit()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the ground of the list, the ring around the focus, and the hints."""
        painter, tokens = QPainter(self), self._tokens
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), tokens.canvas)
        if self.rows:
            self._paint_list(painter)
        tile = self.current
        if tile is not None:
            painter.setPen(QPen(tokens.acc, 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            corner = self.mapFromGlobal(tile.mapToGlobal(tile.rect().topLeft()))
            ring = QRectF(corner, tile.size()).adjusted(-3, -3, 3, 3)
            painter.drawRoundedRect(ring, RADIUS_CARD + 3, RADIUS_CARD + 3)
        self._paint_hints(painter)
        painter.end()

    def _paint_list(self, painter: QPainter) -> None:
        tokens, frame = self._tokens, self._frame
        painter.setPen(QPen(tokens.line2, 1))
        painter.setBrush(tokens.surf)
        painter.drawRoundedRect(
            QRectF(frame).adjusted(0.5, 0.5, -0.5, -0.5), RADIUS_CARD, RADIUS_CARD
        )
        painter.setPen(QPen(tokens.line, 1))
        for at in range(1, frame.height() // recent.PITCH):
            y = frame.top() + at * recent.PITCH
            painter.drawLine(frame.left() + 16, y, frame.right() - 16, y)

    def _paint_hints(self, painter: QPainter) -> None:
        tokens, left, top = self._tokens, float(self._hints.left()), self._hints.top()
        for key, words in HINTS:
            if key:
                left += paint_key(painter, left, top, key, tokens) + 6
            painter.setPen(tokens.tx2)
            painter.setFont(text_font(12))
            wide = painter.fontMetrics().horizontalAdvance(words) + 2
            painter.drawText(QRectF(left, top, wide, 20), Qt.AlignmentFlag.AlignVCenter, words)
            left += wide + 16
