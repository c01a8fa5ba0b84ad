"""The card over the canvas that explains a finding of the selected element and offers its fix."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QRectF, QTimer, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout

from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import plain_text
from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.keys_back import KeysBack
from smsl_studio.studio.base.overlays.card import Card
from smsl_studio.studio.base.theme import RADIUS_NODE, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is, capital, whole_sentence
from smsl_studio.studio.document.session import Session

WIDTH, EDGE, TOP, RIGHT_TOP, FOOT = 236, 14, 86, 56, 58
STEP = 16
"""Pixels between the places that are tried if no corner is free."""
CROWD = 500
"""With more states than these in view, no free place is searched for."""


class FixCard(Card):
    """The card for the first error or warning with a fix, while its element alone is selected."""

    fix_wanted = Signal(object)
    """Finding: the person asked for its fix."""

    def __init__(self, session: Session, canvas: Canvas, tokens: Tokens) -> None:
        super().__init__(canvas, tokens, RADIUS_NODE)
        self._session, self._canvas = session, canvas
        self._findings: tuple[Finding, ...] = ()
        self._shown: Finding | None = None
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
        KeysBack(self)
        session.selection_changed.connect(lambda *_: self._choose())
        session.blueprint_changed.connect(lambda *_: self.hide())
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

    def _choose(self) -> None:
        selection = self._session.selection
        found = [
            finding
            for finding in self._findings
            if finding.fix is not None
            and finding.severity is not Severity.NOTE
            and len(selection) == 1
            and selection[0] in finding.addresses
        ]
        self._shown = found[0] if found else None
        if self._shown is None or self._shown.fix is None:
            self.hide()
            return
        finding = self._shown
        self._title.setText(capital(finding.advice or finding.message))
        self._body.setText(whole_sentence(finding))
        self._body.setVisible(bool(finding.advice))
        self.fix.setText(as_it_is(self._shown.fix.words))
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
        """Move the card to the first corner where it covers no state, else to the best place."""
        wide, high = self._canvas.width() - WIDTH - EDGE, self._canvas.height() - self.height()
        corners = (
            QPoint(EDGE, TOP),
            QPoint(wide, RIGHT_TOP),
            QPoint(EDGE, high - FOOT),
            QPoint(wide, high - FOOT - 60),
        )
        at = next((at for at in corners if not self._covered(at)), None)
        self.move(at if at is not None else self._elsewhere(corners[0]))

    def _elsewhere(self, corner: QPoint) -> QPoint:
        """The place nearest to a corner where the card covers the fewest states.

        It covers no other floating part. All points are pixels of the canvas.
        """
        overlays = self._canvas.overlays
        far = QPoint(self._canvas.width(), self._canvas.height()) - QPoint(EDGE, EDGE)
        spots = [
            QPoint(x, y)
            for y in range(EDGE, far.y() - self.height() + 1, STEP)
            for x in range(EDGE, far.x() - self.width() + 1, STEP)
            if not overlays.floats_in(QRect(QPoint(x, y), self.size()))
        ]
        nodes = self._nodes_in_view()
        if not spots or len(nodes) > CROWD:
            return corner
        x, y = np.array([(at.x(), at.y()) for at in spots], dtype=np.float64).T[:, :, None]
        left, top, right, bottom = nodes.T
        across = (left < x + self.width()) & (right > x)
        covered = (across & (top < y + self.height()) & (bottom > y)).sum(axis=1).tolist()
        ways = [(at - corner).manhattanLength() for at in spots]
        return spots[min(range(len(spots)), key=lambda i: (covered[i], ways[i]))]

    def _nodes_in_view(self) -> Floats:
        """Left, top, right and bottom of the nodes in the view, in pixels, shape (n, 4)."""
        sheet, view = self._canvas.sheet, self._canvas.viewport().rect()
        if sheet is None:
            return np.empty((0, 4))
        box = self._canvas.mapToScene(view).boundingRect()
        seen = sheet.states_in(box.left(), box.top(), box.right(), box.bottom())
        at, half = sheet.at[seen], sheet.halves()[seen]
        way = self._canvas.viewportTransform()
        return np.hstack([at - half, at + half]) * way.m11() + [way.dx(), way.dy()] * 2

    def _covered(self, at: QPoint) -> int:
        """How many states the card would cover at a point of the view."""
        sheet = self._canvas.sheet
        if sheet is None:
            return 0
        box = self._canvas.mapToScene(QRect(at, self.size())).boundingRect()
        return len(sheet.states_in(box.left(), box.top(), box.right(), box.bottom()))

    def _apply(self) -> None:
        if self._shown is not None:
            self.fix_wanted.emit(self._shown)
