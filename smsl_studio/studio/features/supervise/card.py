"""A card of the partial view: one operation of the active state, as a button."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QAbstractButton, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.partial import (
    NEXT,
    NUMBERED,
    ONE_AT_A_TIME,
    PAUSED,
    POSSIBLE,
    PROPOSED,
    PRUNED,
    REFUSED,
    RISKY,
    RUNNING,
    UNKNOWN,
    VETOED,
    WAITS,
    OperationCard,
)
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import ACTOR_ICON, draw
from smsl_studio.studio.base.paint.ink import Type, draw_sub_mark, faded, hatch, pen, rounded_rect
from smsl_studio.studio.base.theme import RADIUS_NODE, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

HEIGHT = 50
ROOM = 160
"""The width from which a reason is shown on the card (pixels).

A chosen card shows it anyway, in the decision.
"""
ACTOR = 17
"""The width of the sign of who acts, with its gap (pixels)."""
INSET = 3
"""Pixels around the border, for the ring of a card that is chosen or has the focus."""
RISKS = {"low": 1, "medium": 2, "high": 3}
BADGES = {
    RUNNING: "running",
    PAUSED: "paused",
    WAITS: "waits for you",
    PROPOSED: "proposed",
    UNKNOWN: "unknown fact",
    PRUNED: "pruned",
    RISKY: "risky",
    VETOED: "vetoed once",
    REFUSED: "not now",
}
ACTORS = {"human": "a person acts", "shared": "a person and the robot act", "robot": "automatic"}


@dataclass(frozen=True)
class CardForecast:
    """What the forecast of an operation says: it agrees, or in ``words`` what differs."""

    edge: Address
    agrees: bool
    words: str = ""

    @property
    def verdict(self) -> str:
        """The word on the card."""
        return "agrees" if self.agrees else "differs"

    @property
    def sentence(self) -> str:
        """The verdict, and what differs."""
        return f"forecast {self.verdict}" + (f": {self.words}" if self.words else "")


class CardButton(QAbstractButton):
    """One operation. A click chooses it, and the decision must still be confirmed."""

    step_wanted = Signal(int)
    """int: give the focus to the card so many places further."""

    def __init__(self, card: OperationCard, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.card, self._tokens = card, tokens
        self._chosen = False
        self.prefix = ""
        """What the names of all operations of the SB begin with."""
        self._forecast: CardForecast | None = None
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.show_card(card, chosen=False)

    def show_card(self, card: OperationCard, chosen: bool) -> None:
        """Show another state of the same operation, or another operation."""
        self.card, self._chosen = card, chosen
        if self._forecast is not None and self._forecast.edge != card.address:
            self._forecast = None
        self._tell()

    def show_forecast(self, told: CardForecast | None) -> None:
        """Show what its forecast says. None shows none."""
        if told != self._forecast:
            self._forecast = told
            self._tell()

    def _tell(self) -> None:
        said, tip = card_words(self.card, self._chosen), _tip(self.card)
        if self._forecast is not None:
            said = f"{said}, {self._forecast.sentence}"
            tip = f"{tip}\nF{self._forecast.sentence[1:]}"
        self.setAccessibleName(plain_text(said))
        self.setToolTip(tip_text(tip))
        self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def sizeHint(self) -> QSize:
        """The size of a card with the room around it."""
        return QSize(265 + 2 * INSET, HEIGHT + 2 * INSET)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows move the focus to the next or previous card; other keys work as usual."""
        steps = {
            Qt.Key.Key_Down: 1, Qt.Key.Key_Right: 1, Qt.Key.Key_Up: -1, Qt.Key.Key_Left: -1,
        }  # fmt: skip
        step = steps.get(Qt.Key(event.key()))
        if step is None:
            super().keyPressEvent(event)
        else:
            self.step_wanted.emit(step)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint background, badge, name and second line."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        box = QRectF(self.rect()).adjusted(INSET, INSET, -INSET, -INSET)
        self._ground(painter, box)
        left = box.left() + 12
        if self.card.mark:
            draw_sub_mark(painter, left + 4, box.top() + 17, self.card.mark, self._tokens.acc,
                          self._tokens.surf)  # fmt: skip
            left += 14
        right = self._badge(painter, box)
        self._name(painter, left, box.top() + 17, right - 8 - left)
        self._second_line(painter, box)
        painter.end()

    def _ground(self, painter: QPainter, box: QRectF) -> None:
        t, standing = self._tokens, self.card.standing
        dashes: tuple[float, ...] = ()
        fill, line, wide = t.surf, t.nl, 1.2
        if standing in (WAITS, RUNNING, PAUSED, PROPOSED):
            fill, line, wide = t.accs, t.acc, 1.6
            dashes = (4.0, 3.0) if standing == PROPOSED else ()
        elif standing == NEXT:
            line, wide, dashes = t.acc, 1.6, (4.0, 3.0)
        elif standing == UNKNOWN:
            dashes = (6.0, 3.0)
        elif standing == PRUNED:
            dashes = (2.0, 3.0)
        elif standing == RISKY:
            line = t.risk
        elif standing in (REFUSED, VETOED):
            fill, line = t.win, t.line2
        if self._chosen or self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(t.acc if self._chosen else t.accl, 2))
            ring = box.adjusted(-2, -2, 2, 2)
            painter.drawRoundedRect(ring, RADIUS_NODE + 2, RADIUS_NODE + 2)
        if self.underMouse() and standing == POSSIBLE:
            line = t.acc
        painter.setPen(pen(line, wide, dashes))
        painter.setBrush(fill)
        painter.drawRoundedRect(box, RADIUS_NODE, RADIUS_NODE)

    def _badge(self, painter: QPainter, box: QRectF) -> float:
        """Paint the badge, or the number key if there is none; returns its left edge (pixels)."""
        t, words = self._tokens, BADGES.get(self.card.standing, "")
        if not words:
            return self._key(painter, box)
        kind = Type(text_font(11, 600))
        sign = {UNKNOWN: "?", PRUNED: "barred", RISKY: "warning"}.get(self.card.standing, "")
        wide = kind.width(words) + 14 + (15 if sign else 0)
        place = QRectF(box.right() - 8 - wide, box.top() + 7, wide, 19)
        fill, line, ink, dashes = {
            RUNNING: (t.acc, t.acc, t.onacc, ()),
            PAUSED: (t.surf, t.acc, t.acc, ()),
            WAITS: (t.acc, t.acc, t.onacc, ()),
            PROPOSED: (t.surf, t.acc, t.acc, (3.0, 2.0)),
            UNKNOWN: (t.unks, t.unk, t.unk, (3.0, 2.0)),
            RISKY: (t.risks, t.risk, t.risk, ()),
        }.get(self.card.standing, (t.sunk, t.line2, t.tx2, ()))
        shape = rounded_rect(place.x(), place.y(), place.width(), place.height(), 5.0)
        painter.fillPath(shape, fill)
        if self.card.standing == UNKNOWN:
            painter.fillPath(shape, hatch(faded(t.unk, 0.25)))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(pen(line, 1.0, dashes))
        painter.drawPath(shape)
        left = place.left() + 7
        if sign == "?":
            kind.draw_from(painter, left + 1, place.center().y(), "?", ink)
        elif sign:
            draw(painter, sign, QRectF(left - 1, place.center().y() - 6, 12, 12), ink, fill)
        kind.draw_from(painter, left + (15 if sign else 0), place.center().y(), words, ink)
        return place.left()

    def _key(self, painter: QPainter, box: QRectF) -> float:
        if self.card.number > NUMBERED:
            return box.right() - 4
        t = self._tokens
        place = QRectF(box.right() - 8 - 24, box.top() + 7, 24, 19)
        painter.setPen(QPen(t.line, 1))
        painter.setBrush(t.win)
        painter.drawRoundedRect(place, 4, 4)
        kind = Type(text_font(11, 500))
        centre = place.center()
        kind.draw(painter, centre.x(), centre.y(), str(self.card.number), t.tx2)
        return place.left()

    def _name(self, painter: QPainter, left: float, middle: float, room: float) -> None:
        t = self._tokens
        font = text_font(13, 600)
        font.setStrikeOut(self.card.standing == PRUNED)
        quiet = self.card.standing in (PRUNED, REFUSED, VETOED)
        kind = Type(font)
        # As on the canvas: what all operations share is left out. The tip has the whole name.
        shown = kind.elided(self.card.name.removeprefix(self.prefix), room)
        kind.draw_from(painter, left, middle, shown, t.tx2 if quiet else t.tx)

    def _second_line(self, painter: QPainter, box: QRectF) -> None:
        t, plain, y = self._tokens, Type(text_font(12)), box.top() + 36
        left = box.left() + 12
        ink = {"low": t.ok, "medium": t.risk, "high": t.bad}.get(self.card.risk, t.tx3)
        for at in range(3):
            filled = at < RISKS.get(self.card.risk, 0)
            _triangle(painter, left + 5 + at * 10, y, ink if filled else None, t)
        end = self._verdict(painter, box, y)
        word, cost = risk_and_cost(self.card, plain.width, end - left - 33 - ACTOR)
        rated = max(plain.width(word), plain.width("medium"))
        plain.draw_from(painter, left + 33, y, word, ink if self.card.risk else t.tx3)
        left += 33 + (rated + 8 if word else 0)
        plain.draw_from(painter, left, y, cost, t.tx2)
        left += max(plain.width(cost), plain.width("cost 0.0")) + 8 if cost else 0
        icon = ACTOR_ICON.get(self.card.actor, "robot")
        draw(painter, icon, QRectF(left, y - 7, 13, 13), t.tx2, t.surf)
        left += ACTOR
        words, (reason, *_) = self.card.needs, (*self.card.reasons, "")
        own = reason and not self.card.unmet and not reason.startswith(ONE_AT_A_TIME)
        if self.card.standing == REFUSED and own and box.right() - 6 - left >= ROOM:
            words = reason
        ink = {"unknown": t.unk, "missing": t.risk}.get(self.card.unmet, t.tx2)
        if self._forecast is not None and self._forecast.words:
            # The strip below has all of it, so a part of a sentence helps nobody here.
            whole = plain_text(self._forecast.words)
            words, ink = whole if plain.width(whole) <= end - left else "", t.bad
        painter.setFont(plain.font)
        painter.setPen(ink)
        elide = Qt.TextElideMode.ElideRight
        shown = plain.metrics.elidedText(plain_text(words), elide, end - left)
        painter.drawText(QPointF(left, y + plain.rise), shown)

    def _verdict(self, painter: QPainter, box: QRectF, middle: float) -> float:
        """Paint what the forecast says at the right; returns where it begins (pixels)."""
        if self._forecast is None:
            return box.right() - 6
        t, kind = self._tokens, Type(text_font(12, 600))
        ink = t.ok if self._forecast.agrees else t.bad
        left = box.right() - 10 - kind.width(self._forecast.verdict)
        kind.draw_from(painter, left, middle, self._forecast.verdict, ink)
        sign = "check" if self._forecast.agrees else "close"
        draw(painter, sign, QRectF(left - 16, middle - 6, 12, 12), ink, t.surf)
        return left - 22


def risk_and_cost(
    card: OperationCard, width: Callable[[str], float], room: float
) -> tuple[str, str]:
    """Return the words for the risk and for the cost that fit into a room (pixels) beside each
    other. A narrow card with a forecast has no room for both; its tip says them, and triangles say
    the risk."""
    word, cost = card.risk or "not rated", f"cost {card.cost}" if card.cost else ""
    rated = max(width(word), width("medium")) + 8
    asked = max(width(cost), width("cost 0.0")) + 8 if cost else 0
    if rated + asked <= room:
        return word, cost
    if asked <= room and cost:
        return "", cost
    return (word, "") if rated <= room else ("", "")


def _triangle(painter: QPainter, x: float, y: float, fill: QColor | None, tokens: Tokens) -> None:
    corners = QPolygonF([QPointF(x, y - 4), QPointF(x + 4.4, y + 4), QPointF(x - 4.4, y + 4)])
    painter.setPen(QPen(fill or tokens.line2, 1))
    painter.setBrush(fill or Qt.BrushStyle.NoBrush)
    painter.drawPolygon(corners)


def card_words(card: OperationCard, chosen: bool = False) -> str:
    """A card in words, for assistive tools."""
    words = [f"{card.number}, {card.name}"]
    words.append(f"stays in {card.target}" if card.stays else f"to {card.target}")
    words += ["chosen"] if chosen else []
    words.append(BADGES.get(card.standing, "on the route" if card.on_route else "possible"))
    words.append(f"risk {card.risk}" if card.risk else "risk not rated")
    words += [f"cost {card.cost}"] if card.cost else []
    words.append(ACTORS.get(card.actor, card.actor))
    if card.needs:
        words.append(f"needs {card.needs}")
    return ", ".join([*words, *card.reasons])


def _tip(card: OperationCard) -> str:
    lines = [str(card.address), f"stays in {card.target}" if card.stays else f"to {card.target}"]
    if card.mark:
        words = {"rise": "turns a sub-SB's fact on", "fall": "turns a sub-SB's fact off",
                 "mixed": "changes a sub-SB's fact with others"}  # fmt: skip
        lines.append(words[card.mark])
    lines += [f"Cost {card.cost}"] if card.cost else []
    lines += [f"Needs {card.needs}"] if card.needs else []
    lines += card.reasons
    if card.number <= NUMBERED:
        lines.append(f"Key {card.number}, then Enter")
    return "\n".join(lines)
