"""The card over the canvas that explains a finding of the selected element and offers its fix."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import one_line, plain_text
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.keys_back import KeysBack
from smsl_studio.studio.base.overlays.card import Card, PassingCard
from smsl_studio.studio.base.theme import RADIUS_NODE, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is, capital, whole_sentence
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.card_places import (
    is_clear,
    least_covering,
    selected_places,
)

WIDTH, EDGE, TOP, RIGHT_TOP, FOOT = 236, 14, 86, 56, 58
RIM = 8
"""In a low view, the space between the card and the selected element above it (pixels)."""


class FixCard(Card):
    """The card for the first error or warning with a fix, while its element alone is selected."""

    fix_wanted = Signal(object)
    """Finding: the person asked for its fix."""

    def __init__(self, session: Session, canvas: Canvas, tokens: Tokens) -> None:
        super().__init__(canvas, tokens, RADIUS_NODE)
        self._session, self._canvas = session, canvas
        self._findings: tuple[Finding, ...] = ()
        self._shown: Finding | None = None
        self._fresh: Address | None = None
        """The state that the last step has made. It is not finished yet."""
        self._title: QLabel = label("", "heading")
        self._body: QLabel = label("", "small")
        for part in (self._title, self._body):
            part.setWordWrap(True)
        self.fix = QPushButton("Fix")
        self.fix.setProperty("role", "primary")
        self.fix.clicked.connect(self._apply)
        self.leave = QPushButton("Close")
        self.leave.setToolTip("Close this card; the finding stays in the list")
        self.leave.clicked.connect(self.hide)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(14, 12, 14, 12)
        layout.setSpacing(6)
        head = row(self._title)
        head.setContentsMargins(22, 0, 0, 0)
        layout.addLayout(head)
        layout.addWidget(self._body)
        layout.addSpacing(4)
        layout.addLayout(row(self.fix, self.leave, None))
        self.setFixedWidth(WIDTH)
        self.float_up()
        canvas.installEventFilter(self)
        canvas.camera.arrived.connect(self._make_way)
        KeysBack(self)
        session.selection_changed.connect(lambda *_: self._selected())
        session.blueprint_changed.connect(self._follow)
        self.hide()

    @property
    def words(self) -> tuple[QLabel, ...]:
        """The labels of the card that are visible."""
        return tuple(part for part in (self._title, self._body) if not part.isHidden())

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Take the findings of the last inspection."""
        self._findings = tuple(findings)
        self._choose()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Move the card when the size of the canvas has changed."""
        if event.type() == QEvent.Type.Resize and not self.isHidden():
            # Later, after the canvas has fitted its drawing into the new size.
            QTimer.singleShot(0, self, self._place)
        return super().eventFilter(watched, event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the border and the icon in the colour of the finding's severity."""
        super().paintEvent(event)
        if self._shown is None:
            return
        letter = self._shown.severity.value
        ink, painter = severity_colour(letter, self.tokens), QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(ink, 1.2))
        box = QRectF(self.rect()).adjusted(0.6, 0.6, -0.6, -0.6)
        painter.drawRoundedRect(box, self.radius, self.radius)
        mark = QRectF(14, self._title.y() + 1, 15, 15)
        draw(painter, SEVERITY_ICON[letter], mark, ink, self.tokens.surf)

    def _follow(self, before: Blueprint, after: Blueprint) -> None:
        """Hide the card, because its finding may be gone. A new state gets a card only when it is
        selected again."""
        self._fresh = None
        self.hide()
        branch = self._session.branch
        if branch in before.branches and branch in after.branches:
            old, new = before[branch].table.keys(), after[branch].table.keys()
            one_more = len(new) == len(old) + 1 and old <= new
            self._fresh = Address(branch, (new - old).pop()) if one_more else None

    def _selected(self) -> None:
        if self._session.selection != (self._fresh,):
            self._fresh = None
        self._choose()

    def _name_fix(self, words: str) -> None:
        """Write the fix on its button, shortened if both buttons would be wider than the card."""
        self.fix.setText(as_it_is(words))
        over = self.fix.sizeHint().width() + self.leave.sizeHint().width() + 8 - (WIDTH - 2 * 14)
        if over > 0:
            metrics = self.fix.fontMetrics()
            room = metrics.horizontalAdvance(words) - over
            shown = metrics.elidedText(words, Qt.TextElideMode.ElideMiddle, room)
            self.fix.setText(as_it_is(shown))

    def _choose(self) -> None:
        selection = self._session.selection
        found = [
            finding
            for finding in self._findings
            if finding.fix is not None
            and finding.severity is not Severity.NOTE
            and len(selection) == 1
            and selection[0] in finding.addresses
            and selection[0] != self._fresh
        ]
        asked = any(not card.isHidden() for card in self._canvas.findChildren(PassingCard))
        self._shown = found[0] if found and not asked else None
        if self._shown is None or self._shown.fix is None:
            self.hide()
            return
        finding = self._shown
        self._title.setText(capital(finding.advice or finding.message))
        self._body.setText(whole_sentence(finding))
        self._body.setVisible(bool(finding.advice))
        self._name_fix(one_line(self._shown.fix.words))
        self.fix.setToolTip(tip_text(f"{self._shown.fix.words} (Ctrl+.)"))
        self.setAccessibleName(plain_text(f"{self._title.text()} {self._body.text()}"))
        layout = self.layout()
        assert layout is not None
        # The layout still holds the height of the title before this one.
        layout.invalidate()
        layout.activate()
        self.setFixedHeight(layout.totalHeightForWidth(WIDTH))
        self._place()
        self.show()
        self.raise_()

    def _place(self) -> None:
        """Move the card to a corner where it covers no state, no note and nothing that is selected.

        If there is no such corner, move it to the place where it covers the fewest.
        """
        chosen = selected_places(self._canvas)
        wide, high = self._canvas.width() - WIDTH - EDGE, self._canvas.height() - self.height()
        corners = (
            QPoint(EDGE, TOP),
            QPoint(wide, RIGHT_TOP),
            QPoint(EDGE, high - FOOT),
            QPoint(wide, high - FOOT - 60),
        )
        areas = [QRect(at, self.size()) for at in corners]
        clear = (
            area.topLeft()
            for area in areas
            if is_clear(self._canvas, area) and not any(map(area.intersects, chosen))
        )
        at = next(clear, None)
        self.move(at or least_covering(self._canvas, self.size(), corners[0], chosen))
        if at is None and any(map(self.geometry().intersects, chosen)):
            self._rise()

    def _rise(self) -> None:
        """Put the card at the bottom of a low view, and scroll the selected element above it."""
        canvas = self._canvas
        top = canvas.height() - self.height() - RIM
        self.move(self.x(), max(top, RIM))
        places = selected_places(canvas)
        over = max(place.bottom() for place in places) - top + RIM
        if 0 < over < min(place.top() for place in places):
            canvas.camera.pan(0.0, -over)

    def _make_way(self) -> None:
        """Move the card away from the selected element after the view has moved."""
        places = selected_places(self._canvas)
        if not self.isHidden() and any(map(self.geometry().intersects, places)):
            self._place()

    def _apply(self) -> None:
        if self._shown is not None:
            self.fix_wanted.emit(self._shown)
