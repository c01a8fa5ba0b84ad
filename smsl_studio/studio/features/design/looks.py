"""How stages look: the icons of makers, verdicts and standings, and the words for times."""

from __future__ import annotations

from datetime import datetime

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from smsl_studio.front.design import stages
from smsl_studio.studio.base.paint.ink import hatch
from smsl_studio.studio.base.theme import Tokens

MAKERS = {
    stages.PERSON: "person", stages.RULES: "rules", stages.PHYSICS: "robot", stages.MODEL: "model",
}  # fmt: skip
"""The icon of each kind of maker."""
MARKS = {
    stages.GOOD: "check", stages.BAD: "error", stages.WARNING: "warning",
    stages.UNKNOWN: "unknown", stages.PLAIN: "dot",
}  # fmt: skip
FEET = {
    stages.SETTLED: "check", stages.UNINSPECTED: "shield", stages.OUTDATED: "clock",
    stages.INCOMPLETE: "error", stages.EMPTY: "plus",
}  # fmt: skip
COUNTED = {
    stages.SETTLED: "settled", stages.UNINSPECTED: "not inspected",
    stages.OUTDATED: "out of date", stages.INCOMPLETE: "incomplete", stages.EMPTY: "not begun",
}  # fmt: skip
"""The words for a number of stages that stand so."""


def mark_colour(mark: str, tokens: Tokens) -> QColor:
    """The colour of a verdict."""
    return {
        stages.GOOD: tokens.ok, stages.BAD: tokens.bad, stages.WARNING: tokens.risk,
        stages.UNKNOWN: tokens.unk,
    }.get(mark, tokens.tx2)  # fmt: skip


def foot_colours(standing: str, tokens: Tokens) -> tuple[QColor, QColor]:
    """Ink and ground of the foot of a card."""
    return {
        stages.SETTLED: (tokens.ok, tokens.oks),
        stages.UNINSPECTED: (tokens.risk, tokens.risks),
        stages.OUTDATED: (tokens.unk, tokens.unks),
        stages.INCOMPLETE: (tokens.bad, tokens.bads),
    }.get(standing, (tokens.tx2, tokens.sunk))


def paint_strip(painter: QPainter, box: QRectF, kind: str, tokens: Tokens) -> None:
    """Paint the strip of a kind of stage: hatched, solid or broken; none for what people decide."""
    if kind == stages.GENERATIVE:
        painter.setPen(QPen(tokens.acc, 1))
        painter.setBrush(hatch(tokens.acc))
        painter.drawRoundedRect(box, 2, 2)
    elif kind == stages.DETERMINISTIC:
        painter.fillRect(box, tokens.slate)
    elif kind == stages.SITE:
        pen = QPen(tokens.slate, box.width())
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        pen.setDashPattern([1, 0.6])
        painter.setPen(pen)
        middle = box.center().x()
        painter.drawLine(
            QRectF(middle, box.top(), 0, box.height()).topLeft(),
            QRectF(middle, box.top(), 0, box.height()).bottomLeft(),
        )


def when_words(when: float | None, now: datetime) -> str:
    """A time for people: ``today, 10:41`` or ``19 Nov, 11:02``; empty if it is not known."""
    if when is None:
        return ""
    try:
        then = datetime.fromtimestamp(when).astimezone()
    except (OverflowError, OSError, ValueError):
        return ""
    if then.date() == now.date():
        return f"today, {then:%H:%M}"
    year = "" if then.year == now.year else f" {then.year}"
    return f"{then.day} {then:%b}{year}, {then:%H:%M}"


def digest_words(digest: str) -> str:
    """The beginning of a digest, in two groups: ``9a40 7c1e``."""
    return f"{digest[:4]} {digest[4:8]}" if digest else ""
