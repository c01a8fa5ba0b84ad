"""Fact chips: small boxes that show the digits of a state in panels."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.legible import plain_text
from smsl_studio.picture.chip_kinds import OFF, ON, VALUE, chip_kind
from smsl_studio.picture.picture import MOST_CHIPS
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text

CHIP, GAP = 20, 5
MOST_VALUES = 8
"""So many values of a fact are named in a tooltip."""


def kind_of(branch: StateBranch, state: str, digit: int) -> str:
    """How to paint a digit of a state: ``on`` (filled), ``off`` (outlined), or ``value`` if
    there are several values."""
    facts = branch.facts(state)
    return chip_kind(branch, digit, facts[digit]) if digit < len(facts) else VALUE


def fact_words(branch: StateBranch, digit: int, value: str) -> str:
    """What a value of a fact says: ``Clamp: fixed (1)``, or ``Clamp: 1`` if it has no meaning."""
    note = branch.fact_note(digit)
    meaning = note.values.get(value, "") if note is not None else ""
    return f"{branch.fact_name(digit)}: {f'{meaning} ({value})' if meaning else value}"


def values_of(branch: StateBranch, digit: int) -> tuple[str, ...]:
    """The values of a fact: those in the states, and those that are only described. A fact that is
    0 or 1 has both.
    """
    note = branch.fact_note(digit) or FactNote()
    seen = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
    found = tuple(dict.fromkeys((*seen, *note.values, *note.failure)))
    return ("0", "1") if set(found) <= {"0", "1"} else found


def paint_chip(
    painter: QPainter, rect: QRectF, text: str, kind: str, tokens: Tokens, *, sub: bool = False
) -> None:
    """Paint one chip; ``sub`` adds the bar below that stands for a sub-SB."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    box = rect.adjusted(0.5, 0.5, -0.5, -0.5)
    painter.setPen(QPen(tokens.line2, 1) if kind == OFF else Qt.PenStyle.NoPen)
    painter.setBrush({ON: tokens.slate, OFF: tokens.surf}.get(kind, tokens.sunk))
    painter.drawRoundedRect(box, 4, 4)
    painter.setPen(tokens.onslate if kind == ON else tokens.tx2 if kind == OFF else tokens.tx)
    painter.setFont(mono_font(12, 500))
    middle = Qt.TextElideMode.ElideMiddle
    shown = painter.fontMetrics().elidedText(
        plain_text(text), middle, max(int(rect.width()) - 4, 12)
    )
    painter.drawText(rect, Qt.AlignmentFlag.AlignCenter, shown)
    if sub:
        bar = QRectF(rect.center().x() - 6.5, rect.bottom() + 2, 13, 2)
        painter.fillRect(bar, tokens.acc)
    painter.restore()


class Chips(QWidget):
    """The facts of states as a row of chips. ``chosen`` carries the digit of a clicked chip."""

    chosen = Signal(int)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._chips: tuple[tuple[str, str, bool], ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFixedHeight(CHIP + 12)
        self._places: list[QRectF] = []

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Emit ``chosen`` for the chip under the pointer."""
        for digit, place in enumerate(self._places):
            if place.contains(event.position()):
                self.chosen.emit(digit)
                return

    def place_of(self, digit: int) -> QRectF:
        """The rectangle in which the chip of a digit was painted last."""
        return self._places[digit]

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_states(self, branch: StateBranch, states: Sequence[str]) -> None:
        """Show the facts of states. A fact in which they differ shows ``…``."""
        facts = [branch.facts(state) for state in states]
        count = min(map(len, facts), default=0)
        chips, said = [], []
        for digit in range(min(count, MOST_CHIPS)):
            values = sorted({one[digit] for one in facts})
            sub = digit in branch.subs
            if len(values) == 1:
                chips.append((values[0], kind_of(branch, states[0], digit), sub))
                said.append(fact_words(branch, digit, values[0]))
            else:
                chips.append(("…", VALUE, sub))
                some = ", ".join(values[:MOST_VALUES]) + ("…" if len(values) > MOST_VALUES else "")
                said.append(f"{branch.fact_name(digit)}: various ({some})")
        if count > MOST_CHIPS:
            said.append(f"and {count - MOST_CHIPS:,} more")
        self._chips = tuple(chips)
        self.setToolTip(tip_text("\n".join([*said, "Click a fact to change its value."])))
        self.setAccessibleName(plain_text(", ".join(said)))
        self.update()

    def sizeHint(self) -> QSize:
        """Wide enough for all chips at their smallest width."""
        return QSize(len(self._chips) * (CHIP + GAP), CHIP + 12)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the chips from the left, as many as fit."""
        painter = QPainter(self)
        metrics = self.fontMetrics()
        x = 0.0
        self._places.clear()
        for text, kind, sub in self._chips:
            natural = max(CHIP, metrics.horizontalAdvance(text) + 8)
            wide = min(float(natural), self.width() - x)
            shown = metrics.elidedText(plain_text(text), Qt.TextElideMode.ElideMiddle, int(wide))
            self._places.append(QRectF(x, 5, wide, CHIP))
            paint_chip(painter, self._places[-1], shown, kind, self._tokens, sub=sub)
            x += wide + GAP
            if x > self.width() - CHIP:
                break
