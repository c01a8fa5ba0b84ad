"""Paints the rows of the findings list: two lines for an error, one for other findings."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath
from typing import Any

from PySide6.QtCore import (
    QAbstractListModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRect,
    QRectF,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QFontMetricsF, QMouseEvent, QPainter, QPen
from PySide6.QtWidgets import QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital, counted, series, subject
from smsl_studio.studio.features.draw.panels.unfinished import to_finish

Index = QModelIndex | QPersistentModelIndex
LOW, HIGH, BUTTON = 35, 52, 26
MARK_X, RULE_X, TEXT_X, ADDRESS = 13, 37, 84, 216
LEAST = 0.28
"""The share of a row that a wide button of a fix keeps beside a long sentence; the tip has the
words of both."""
RIGHT = Qt.TextElideMode.ElideRight
WORDS = {"E": "Error", "W": "Warning", "I": "Note"}
NAMED = 6
"""So many further places of a finding are named; the others are counted."""


class _Model(QAbstractListModel):
    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.findings: tuple[Finding, ...] = ()

    def show(self, findings: tuple[Finding, ...]) -> None:
        """Replace all findings."""
        self.beginResetModel()
        self.findings = findings
        self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """How many findings there are; a finding has no rows below it."""
        return 0 if parent.isValid() else len(self.findings)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The finding, its text, the text for assistive tools, or the tip with place and fix."""
        finding = self.findings[index.row()]
        if role == Qt.ItemDataRole.UserRole:
            return finding
        if role in {Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole}:
            said = f"{named(finding)}, {finding.address}: {sentence(finding)}"
            also = also_told(finding) if role == Qt.ItemDataRole.AccessibleTextRole else ""
            return f"{said} {also}" if also else said
        if role == Qt.ItemDataRole.ToolTipRole:
            fix = f"\nCtrl+. {finding.fix.words}" if finding.fix else ""
            also = f", {finding.also}" if finding.also else ""
            return tip_text(f"{sentence(finding)}\n{place_of(finding)}{also}{fix}")
        return None


class FindingsView(QListView):
    """The list of findings. ``fix_wanted`` carries the finding whose button was pressed."""

    fix_wanted = Signal(object)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._model = _Model(self)
        self.setModel(self._model)
        self.delegate = FindingDelegate(tokens, self)
        self.setItemDelegate(self.delegate)
        self.setAccessibleName("Findings")
        FocusLine(self)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollMode(QListView.ScrollMode.ScrollPerPixel)
        self.delegate.pressed.connect(self.fix_wanted)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.delegate.tokens = tokens
        self.viewport().update()

    def show_findings(self, findings: Sequence[Finding]) -> None:
        """Replace the list. The current finding stays current, if it is still there."""
        at = self.currentIndex().row()
        current = self._model.findings[at] if at >= 0 else None
        self._model.show(tuple(findings))
        if current is not None:
            for row, finding in enumerate(findings):
                if finding.rule == current.rule and finding.address == current.address:
                    self.setCurrentIndex(self._model.index(row))

    def button_rect(self, row: int) -> QRect:
        """The box of a row's fix button, in pixels of the viewport."""
        index = self._model.index(row)
        return self.delegate.button(QRectF(self.visualRect(index)), self._model.findings[row])


class FindingDelegate(QStyledItemDelegate):
    """Paints a finding with its fix button. ``pressed`` carries the finding."""

    pressed = Signal(object)

    def __init__(self, tokens: Tokens, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.tokens = tokens

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """The height of a row: two lines for an error, one for the rest."""
        finding: Finding = index.data(Qt.ItemDataRole.UserRole)
        return QSize(10, HIGH if finding.severity is Severity.ERROR else LOW)

    def button(self, rect: QRectF, finding: Finding) -> QRect:
        """The box of the button in a row; empty if the finding has no fix."""
        if finding.fix is None:
            return QRect()
        wide = QFontMetricsF(text_font(12, 500)).horizontalAdvance(finding.fix.words) + 22
        room = rect.width() - TEXT_X - 24 - _text_width(finding)
        wide = min(wide, rect.width() / 2, max(room, rect.width() * LEAST))
        return QRectF(
            rect.right() - 12 - wide, rect.center().y() - BUTTON / 2, wide, BUTTON
        ).toRect()

    def editorEvent(
        self, event: QEvent, model: Any, option: QStyleOptionViewItem, index: Index
    ) -> bool:
        """Emit ``pressed`` on a click on the button of a finding."""
        if isinstance(event, QMouseEvent) and event.type() == QEvent.Type.MouseButtonRelease:
            finding: Finding = index.data(Qt.ItemDataRole.UserRole)
            box = self.button(QRectF(option.rect), finding)
            if event.button() is Qt.MouseButton.LeftButton and box.contains(
                event.position().toPoint()
            ):
                self.pressed.emit(finding)
                return True
        return super().editorEvent(event, model, option, index)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint a finding with its icon and button."""
        finding: Finding = index.data(Qt.ItemDataRole.UserRole)
        tokens, rect = self.tokens, QRectF(option.rect)
        state = option.state
        chosen = bool(state & QStyle.StateFlag.State_Selected)
        painter.save()
        if chosen:
            painter.fillRect(rect, tokens.accs)
        elif state & QStyle.StateFlag.State_MouseOver:
            painter.fillRect(rect, tokens.win)
        painter.fillRect(QRectF(rect.left(), rect.bottom(), rect.width(), 1), tokens.line)
        letter = finding.severity.value
        mark = QRectF(rect.left() + MARK_X, rect.center().y() - 7.5, 15, 15)
        draw(painter, SEVERITY_ICON[letter], mark, severity_colour(letter, tokens), tokens.surf)
        rule = rect.adjusted(RULE_X, 0, 0, 0)
        paint_text(painter, rule, finding.rule, TextInk(tokens.tx2, 12, mono=True))
        box = QRectF(self.button(rect, finding))
        right = (box.left() if finding.fix else rect.right()) - 12
        if finding.severity is Severity.ERROR:
            self._high(painter, rect, finding, right)
        else:
            self._low(painter, rect, finding, right)
        if finding.fix is not None:
            self._button(painter, box, finding.fix.words, chosen)
        painter.restore()

    def _high(self, painter: QPainter, rect: QRectF, finding: Finding, right: float) -> None:
        tokens = self.tokens
        upper = QRectF(rect.left() + TEXT_X, rect.top() + 7, right - rect.left() - TEXT_X, 20)
        used = 0.0
        about = subject(finding)
        if about:
            used = paint_text(painter, upper, f"{about} ", TextInk(tokens.tx, 13, 600))
            text = sentence(finding)
            text = text[:1].lower() + text[1:]
        else:
            text = sentence(finding)
        room = upper.adjusted(used, 0, 0, 0)
        paint_text(painter, room, text, TextInk(tokens.tx), elide=RIGHT)
        where = "  ·  ".join((_path(finding, " / ", True), place_of(finding)))
        paint_text(painter, upper.translated(0, 18), where, TextInk(tokens.tx2, 12))

    def _low(self, painter: QPainter, rect: QRectF, finding: Finding, right: float) -> None:
        tokens = self.tokens
        wide = ADDRESS if rect.width() > 800 else ADDRESS * 0.7
        if right - rect.left() - TEXT_X - wide < _words_width(_low_words(finding)):
            # A short address leaves its room to the sentence.
            wide = min(wide, _address_width(finding))
        address = QRectF(rect.left() + TEXT_X, rect.top(), wide - 12, rect.height())
        paint_text(painter, address, _path(finding, " / ", False), TextInk(tokens.tx2))
        text = QRectF(
            rect.left() + TEXT_X + wide,
            rect.top(),
            right - rect.left() - TEXT_X - wide,
            rect.height(),
        )
        paint_text(painter, text, _low_words(finding), TextInk(tokens.tx), elide=RIGHT)

    def _button(self, painter: QPainter, box: QRectF, words: str, primary: bool) -> None:
        tokens = self.tokens
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(tokens.acc if primary else tokens.accl, 1))
        painter.setBrush(tokens.acc if primary else tokens.accs)
        painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 6, 6)
        ink = tokens.onacc if primary else tokens.acc
        inner = box.adjusted(11, 0, -6, 0)
        paint_text(painter, inner, words, TextInk(ink, 12, 500), elide=RIGHT)


def sentence(finding: Finding) -> str:
    """The message and the advice of a finding, as sentences."""
    advice = f" {capital(finding.advice)}" if finding.advice else ""
    return f"{capital(finding.message)}{advice}"


def named(finding: Finding) -> str:
    """The severity and the rule of a finding: ``Warning R14``, ``To finish: R10``."""
    kind = "To finish:" if to_finish(finding) else WORDS[finding.severity.value]
    return f"{kind} {finding.rule}"


def also_told(finding: Finding) -> str:
    """The further places of a finding by their names: ``Also at State1/Op_1 and State2/Op_2.``

    Names and not lines, because this is read out. Empty if there are none.
    """
    others = [one for one in finding.addresses if one != finding.address]
    if not others:
        return f"{capital(finding.also)}." if finding.also else ""
    shown = [place_in(finding, one) for one in others[:NAMED]]
    left = len(others) - len(shown) + finding.more
    shown += [counted(left, "more place")] if left else []
    return f"Also at {series(shown)}."


def place_in(finding: Finding, address: Address) -> str:
    """An address in the words of a finding: without the SB if the finding is about this SB."""
    inside = address.branch == finding.address.branch and address.state
    return "/".join(address.path[1:]) if inside else str(address)


def place_of(finding: Finding) -> str:
    """``hanoi.json:73:13``: file name without folder, line and column."""
    place = finding.place
    return f"{PurePath(place.file).name}:{place.line}:{place.column}"


def _low_words(finding: Finding) -> str:
    """The sentence of a row of one line."""
    said = capital(finding.message)
    return f"To finish: {said[:1].lower()}{said[1:]}" if to_finish(finding) else said


def _words_width(words: str) -> float:
    return QFontMetricsF(text_font(13)).horizontalAdvance(words) + 2


def _address_width(finding: Finding) -> float:
    return _words_width(_path(finding, " / ", False)) + 24


def _text_width(finding: Finding) -> float:
    """The width that the text of a row needs to be whole (pixels)."""
    if finding.severity is not Severity.ERROR:
        return _address_width(finding) + _words_width(_low_words(finding))
    about = QFontMetricsF(text_font(13, 600)).horizontalAdvance(f"{subject(finding)} ")
    return about + _words_width(sentence(finding)) + 8


def _path(finding: Finding, between: str, whole: bool) -> str:
    path = finding.address.path
    return between.join(path if whole or len(path) == 1 else path[1:])
