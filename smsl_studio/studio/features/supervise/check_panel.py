"""The panel below the partial view: the state check by facts, and facts of other SBs."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.fact_rows import as_they_were
from smsl_studio.front.views.partial import OutsideFact, PartialView, outside_facts
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, Label, label
from smsl_studio.studio.base.paint.ink import Ink, Type, draw_unknown
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.supervise.facts import check_view
from smsl_studio.studio.running.facts_table import FactsTable

HEAD = 36


class CheckPanel(QWidget):
    """Shows what the state check is based on: only on sensed facts."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("State check")
        self._state, self._written = label("", "mono"), _Written()
        self._written.setProperty("role", "mono")
        self._verdict = Label()
        self._verdict.setProperty("role", "phase")
        self._verdict.setFixedHeight(24)
        self.table = FactsTable(tokens, quality="Source and quality")
        self._outside = _OutsideLines(tokens)
        self._empty = label("Starts with the run. What an operation returns is not evidence.",
                            "hint")  # fmt: skip
        self._empty.setContentsMargins(12, 4, 12, 4)
        head = QWidget()
        head.setFixedHeight(HEAD)
        across = QHBoxLayout(head)
        across.setContentsMargins(12, 0, 12, 0)
        across.setSpacing(8)
        across.addWidget(label("State check", "heading"))
        across.addWidget(self._state)
        across.addWidget(self._written, 1)
        across.addWidget(self._verdict)
        inner = QWidget()
        inner.setProperty("role", "panel")
        rows = QVBoxLayout(inner)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(0)
        for part in (self._empty, self.table, self._outside):
            rows.addWidget(part)
        rows.addStretch(1)
        scroll = QScrollArea()
        scroll.setWidget(inner)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(head)
        column.addWidget(scroll, 1)
        self.table.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)

    @property
    def words(self) -> str:
        """The state and the verdict of its check."""
        return f"{self._state.text()} {self._verdict.text()}".strip()

    @property
    def outside(self) -> tuple[OutsideFact, ...]:
        """The facts of other SBs that block an operation."""
        return self._outside.lines

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.table.set_tokens(tokens)
        self._outside.set_tokens(tokens)

    def show_status(
        self,
        blueprint: Blueprint | None,
        status: DispatchStatus | None,
        view: PartialView | None,
        lost: bool,
        over: bool = False,
    ) -> None:
        """Show the check of the shown SB.

        ``lost`` says that the world has failed. ``over`` says that the run has ended, so facts have
        no age.
        """
        found = None
        if blueprint is not None and status is not None and view is not None:
            found = check_view(blueprint, status, view.branch, lost)
        for part in (self._state, self._written, self._verdict, self.table):
            part.setVisible(found is not None)
        self._empty.setVisible(found is None)
        lines: tuple[OutsideFact, ...] = ()
        if found is not None and blueprint is not None and status is not None and view is not None:
            lines = outside_facts(blueprint, status, view)
            self._state.setText(f"{found.state}, awaited" if found.awaited else found.state)
            self._written.write(found.written.partition(" := ")[2])
            tip = f"{found.written}\n{found.terms}"
            for part in (self._state, self._written, self._verdict):
                part.setToolTip(tip_text(tip))
            self._show_verdict(found.verdict, found.kind)
            self.table.show_rows(as_they_were(found.rows) if over else found.rows)
            self.table.setMinimumHeight(self.table.maximumHeight())
        self._outside.show_lines(lines)

    def _show_verdict(self, words: str, kind: str) -> None:
        self._verdict.setText(f"✓ {words}" if kind == "good" else words)
        if self._verdict.property("kind") != kind:
            self._verdict.setProperty("kind", kind)
            self._verdict.style().unpolish(self._verdict)
            self._verdict.style().polish(self._verdict)


class _Written(Elided):
    """The check in the paper's notation, shown only if all of it fits.

    The tooltip always has it.
    """

    def write(self, text: str) -> None:
        """Set the text, and show it if it fits."""
        self._whole = text
        self._fit()

    _whole = ""

    def _fit(self) -> None:
        fits = self.fontMetrics().horizontalAdvance(self._whole) <= self.contentsRect().width()
        self.setText(self._whole if fits else "")

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the text only if all of it fits."""
        super().resizeEvent(event)
        self._fit()


class _OutsideLines(QWidget):
    """Facts of other SBs, each with its value, the reason, and the operations it blocks."""

    LINE = 26

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.lines: tuple[OutsideFact, ...] = ()
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_lines(self, lines: tuple[OutsideFact, ...]) -> None:
        """Show these lines; hidden without lines."""
        if lines != self.lines:
            self.lines = lines
            said = "\n".join(
                f"{one.name} {one.words}, blocks {', '.join(one.blocks)}" for one in lines
            )
            self.setToolTip(tip_text(said))
            self.setAccessibleName(plain_text(f"Outside this branch: {said}"))
            self.setVisible(bool(lines))
            self.setFixedHeight(len(lines) * self.LINE + 12)
            self.update()

    def sizeHint(self) -> QSize:
        """A line for each fact."""
        return QSize(200, len(self.lines) * self.LINE + 12)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Paint again, because names are shortened to the width."""
        super().resizeEvent(event)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a line for each fact: name, value, and what it blocks."""
        t, plain, strong = self._tokens, Type(text_font(12)), Type(text_font(13))
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        left = 12 + plain.width("Outside this branch") + 12
        for at, one in enumerate(self.lines):
            y = 6 + at * self.LINE + self.LINE / 2
            if not at:
                plain.draw_from(painter, 12, y, "Outside this branch", t.tx2)
            room = max((self.width() - left) * 0.4, 60)
            name = strong.elided(one.name, room)
            strong.draw_from(painter, left, y, name, t.tx)
            x = left + strong.width(name) + 8
            value = one.term.reading
            if value is None:
                draw_unknown(painter, x + 10, y, 20, Ink(t))
                wide = 20.0
            else:
                kind = Type(mono_font(12, 600))
                wide = max(20.0, kind.width(value) + 10)
                painter.setPen(t.line2)
                painter.setBrush(t.sunk)
                painter.drawRoundedRect(QRectF(x, y - 10, wide, 20), 4, 4)
                kind.draw(painter, x + wide / 2, y, value, t.tx)
            x += wide + 8
            words = f"{one.words}, blocks {', '.join(one.blocks)}"
            painter.setFont(plain.font)
            painter.setPen(t.unk if value is None else t.tx2)
            right = Qt.TextElideMode.ElideRight
            shown = plain.metrics.elidedText(plain_text(words), right, self.width() - 12 - x)
            painter.drawText(round(x), round(y + plain.rise), shown)
        painter.end()
