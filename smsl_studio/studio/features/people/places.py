"""The persons who must answer a task: who has answered, and when. Their answers are not shown."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QGridLayout, QSizePolicy, QWidget

from smsl_studio.front.views.card_view import PersonView
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

HEIGHT, LINE, BOXED = 66, 26, 2
"""Height of a box and of a line (pixels); the largest number of places shown as boxes."""


class PersonPlace(QWidget):
    """The place of one person: dashed until they have answered, then filled."""

    def __init__(self, person: PersonView, tokens: Tokens, boxed: bool) -> None:
        super().__init__()
        self._person, self._tokens, self._boxed = person, tokens, boxed
        self.setFixedHeight(HEIGHT if boxed else LINE)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        said = ", ".join(part for part in (person.place, person.name, person.words) if part)
        self.setAccessibleName(plain_text(said))
        self.setToolTip(tip_text(said))

    def sizeHint(self) -> QSize:
        """150 pixels wide, with the fixed height."""
        return QSize(150, self.height())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the box or line of one person."""
        person, tokens = self._person, self._tokens
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        box = QRectF(self.rect()).adjusted(0.75, 0.75, -0.75, -0.75)
        pen = QPen(tokens.line2, 1)
        if not person.answered:
            pen = QPen(tokens.acc if person.you else tokens.nl, 1.2)
            pen.setDashPattern([3, 2])
        painter.setPen(pen)
        painter.setBrush(tokens.sunk if person.answered else tokens.surf)
        painter.drawRoundedRect(box, RADIUS_CONTROL, RADIUS_CONTROL)
        ink = tokens.acc if person.you and not person.answered else tokens.tx
        sign = "check" if person.answered else "person"
        top = 9 if self._boxed else 6
        draw(painter, sign, QRectF(10, top, 14, 14), ink, tokens.surf)
        if not self._boxed:
            said = f"{person.name}, {person.words}" if person.name else person.words
            wide = QFontMetrics(text_font(12, 600)).horizontalAdvance(person.place)
            self._line(painter, 30, 4, person.place, 600, ink)
            self._line(painter, 40 + wide, 4, said, 400, tokens.tx2)
            painter.end()
            return
        self._line(painter, 30, 7, person.place, 600, ink)
        self._line(
            painter,
            10,
            25,
            person.name or "nobody yet",
            400,
            tokens.tx2 if not person.name else tokens.tx,
        )
        self._line(painter, 10, 43, person.words, 400, tokens.tx2)
        painter.end()

    def _line(
        self, painter: QPainter, left: int, top: int, words: str, weight: int, ink: QColor
    ) -> None:
        font = text_font(12, weight)
        painter.setFont(font)
        painter.setPen(ink)
        room = QRectF(left, top, self.width() - left - 8, 18)
        shown = QFontMetrics(font).elidedText(
            plain_text(words), Qt.TextElideMode.ElideRight, int(room.width())
        )
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, shown)


class PersonPlaces(QWidget):
    """All places: up to two boxes side by side, otherwise a line for each."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._shown: tuple[PersonView, ...] = ()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(8)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._rebuild()

    def show_persons(self, persons: tuple[PersonView, ...]) -> None:
        """Show these persons, unless they are the same."""
        if persons != self._shown:
            self._shown = persons
            self._rebuild()

    def _rebuild(self) -> None:
        while (item := self._grid.takeAt(0)) is not None:
            old = item.widget()
            if old is not None:
                old.hide()
                old.deleteLater()
        boxed = len(self._shown) <= BOXED
        self._grid.setSpacing(8 if boxed else 4)
        for at, person in enumerate(self._shown):
            place = PersonPlace(person, self._tokens, boxed)
            self._grid.addWidget(place, 0 if boxed else at, at if boxed else 0)
