"""How the results of runs are drawn: parts with counts, and shares with their intervals."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from smsl_studio.front.campaign_tally import FAILED, REFUSED, CampaignShare
from smsl_studio.front.fault_foresight import HELD, REACHED
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens, text_font

ICONS: Mapping[str, str] = {REACHED: "check", REFUSED: "barred", HELD: "pause", FAILED: "close"}
WORDS: Mapping[str, str] = {
    REACHED: "reached", REFUSED: "refused", HELD: "held", FAILED: "failed",
}  # fmt: skip


def inks(kind: str, tokens: Tokens) -> tuple[QColor, QColor]:
    """Return the ink and the ground of a kind of end."""
    return {
        REACHED: (tokens.ok, tokens.oks),
        REFUSED: (tokens.tx2, tokens.sunk),
        HELD: (tokens.risk, tokens.risks),
        FAILED: (tokens.bad, tokens.bads),
    }[kind]


def counts_words(counts: Mapping[str, int]) -> str:
    """Return counts in words, such as ``18 reached, 2 held``."""
    return ", ".join(f"{number:,} {WORDS[kind]}" for kind, number in counts.items() if number)


def paint_counts(painter: QPainter, box: QRectF, counts: Mapping[str, int], tokens: Tokens) -> None:
    """Paint a part for each kind of end, with its sign and its number. The gravest is the last."""
    told = {kind: number for kind, number in counts.items() if number}
    painter.setFont(text_font(11, 500))
    metrics = QFontMetricsF(painter.font())
    needs = {kind: 19.0 + metrics.horizontalAdvance(f"{n:,}") for kind, n in told.items()}
    spare = max(box.width() - sum(needs.values()), 0.0)
    left = box.left()
    most = max(told, key=lambda kind: told[kind], default="")
    for kind, number in told.items():
        ink, ground = inks(kind, tokens)
        wide = needs[kind] + (spare if kind == most else 0.0)
        part = QRectF(left, box.top(), min(wide, box.right() - left), box.height())
        painter.setPen(QPen(ink, 1))
        painter.setBrush(ground)
        painter.drawRoundedRect(part.adjusted(0.5, 0.5, -0.5, -0.5), RADIUS_CHIP, RADIUS_CHIP)
        draw(
            painter,
            ICONS[kind],
            QRectF(part.left() + 4, part.center().y() - 5, 10, 10),
            ink,
            ground,
        )
        painter.setPen(ink)
        room = part.adjusted(16, 0, -2, 0)
        painter.drawText(
            room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, f"{number:,}"
        )
        left = part.right()


TICKS = 10.0
"""The room for the ticks of a cell (pixels)."""


def paint_ticks(painter: QPainter, box: QRectF, differs: bool, tokens: Tokens) -> None:
    """Paint two ticks at the right of a cell: the upper one for what was foreseen, the lower
    one for what was seen. They stand one above the other if both are the same."""
    x, half = box.right() - 5, box.height() / 2 - 2
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(tokens.tx)
    painter.drawRect(QRectF(x, box.top() + 1, 2, half))
    painter.setBrush(tokens.bad if differs else tokens.tx)
    painter.drawRect(QRectF(x - (4 if differs else 0), box.bottom() - 1 - half, 2, half))


def paint_waiting(painter: QPainter, box: QRectF, words: str, tokens: Tokens) -> None:
    """Paint a cell that is not finished: dashed, with how far it is if it has begun."""
    ink = tokens.acc if words else tokens.line2
    painter.setPen(QPen(ink, 1, Qt.PenStyle.DashLine))
    painter.setBrush(tokens.accs if words else Qt.BrushStyle.NoBrush)
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), RADIUS_CHIP, RADIUS_CHIP)
    if words:
        painter.setFont(text_font(11, 500))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, words)


def paint_share(painter: QPainter, box: QRectF, share: CampaignShare, tokens: Tokens) -> None:
    """Paint a share from 0 to 100 % as a tick, with its 95 % interval as a bar. Without runs there
    is only the line."""
    middle = box.center().y()
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(tokens.line2)
    painter.drawRect(QRectF(box.left(), middle - 1, box.width(), 2))
    if not share.runs:
        return
    painter.setBrush(tokens.accl)
    low, high = (box.left() + box.width() * one for one in (share.low, share.high))
    painter.drawRect(QRectF(low, middle - 3, max(high - low, 1), 6))
    painter.setBrush(tokens.acc)
    at = box.left() + box.width() * share.reached / share.runs
    painter.drawRect(QRectF(min(max(at - 1, box.left()), box.right() - 2), middle - 6, 2, 12))
