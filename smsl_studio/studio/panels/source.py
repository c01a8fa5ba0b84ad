"""Source: the exact text of the blueprint, following the selection; a click selects the element."""

from __future__ import annotations

import re
from collections.abc import Sequence

from PySide6.QtCore import QPoint, QRect, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QShowEvent,
    QSyntaxHighlighter,
    QTextBlock,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
)
from PySide6.QtWidgets import QPlainTextEdit, QTextEdit, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.finding import Finding
from smsl_studio.studio.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.panels.source_text import SourceText, patches
from smsl_studio.studio.session import Session
from smsl_studio.studio.theme import Tokens, mono_font

LEFT, MARKS = 8, 22
MAX_SQUIGGLES = 400


class Source(QPlainTextEdit):
    """Read-only. Follows the selection while it is visible; patched, never reset, on edits."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._tokens = session, tokens
        self._source = SourceText(session.blueprint)
        self._findings: tuple[Finding, ...] = ()
        self._by_line: dict[int, Finding] = {}
        self._stale, self._following = True, True
        self.setAccessibleName("Source text")
        self.setReadOnly(True)
        self.setUndoRedoEnabled(False)
        self.setTextInteractionFlags(
            Qt.TextInteractionFlag.TextSelectableByMouse
            | Qt.TextInteractionFlag.TextSelectableByKeyboard
        )
        self.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.setFont(mono_font(12))
        self.document().setDocumentMargin(2)
        self._gutter = _Gutter(self)
        self._colours: _Colours | None = None
        self.blockCountChanged.connect(self._place_gutter)
        self.updateRequest.connect(self._scroll_gutter)
        session.blueprint_changed.connect(self._changed)
        session.selection_changed.connect(lambda *_: self._follow())
        session.branch_changed.connect(lambda *_: self._follow())

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        if self._colours is not None:
            self._colours.set_tokens(tokens)
        self._mark()
        self._gutter.update()

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Underline what findings are about, and mark their lines."""
        self._findings = tuple(findings)
        self._by_line = {}
        for finding in sorted(self._findings, key=lambda f: "EWI".index(f.severity.value)):
            self._by_line.setdefault(finding.place.line - 1, finding)
        self._mark()
        self._gutter.update()

    @property
    def marked_lines(self) -> tuple[int, ...]:
        """The lines (from 1) in which the selected elements are written."""
        self._refresh()
        return tuple(sorted(line + 1 for line in self._selected_lines()))

    def _changed(self, before: Blueprint, after: Blueprint) -> None:
        if before.document is not after.document:
            self._stale = True
            self._by_line = {}
        if self.isVisible():
            self._refresh()
            self._mark()

    def _refresh(self) -> None:
        """Bring the shown text up to date, replacing only what differs."""
        if not self._stale:
            return
        self._stale = False
        self._source = SourceText(self._session.blueprint)
        new, old = self._source.shown, self.toPlainText()
        if self._colours is None:
            self._colours = _Colours(self._tokens, self.document())
        if not old:
            self.setPlainText(new)
            return
        found = patches(old, new)
        cursor = QTextCursor(self.document())
        # Few patches one by one: a block of edits is coloured anew from its first line to its last.
        together = len(found) > MAX_SQUIGGLES
        if together:
            cursor.beginEditBlock()
        for start, end, text in found:
            cursor.setPosition(_utf16(old, start))
            cursor.setPosition(_utf16(old, end), QTextCursor.MoveMode.KeepAnchor)
            cursor.insertText(text)
        if together:
            cursor.endEditBlock()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._refresh()
        self._follow()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        if event.button() is Qt.MouseButton.LeftButton and not self.textCursor().hasSelection():
            self._select_at(event.position().toPoint())

    def _select_at(self, at: QPoint) -> None:
        cursor = self.cursorForPosition(at)
        block = cursor.block()
        column = len(block.text().encode("utf-16-le")[: cursor.positionInBlock() * 2]
                     .decode("utf-16-le", "ignore"))  # fmt: skip
        address = self._source.address_at(block.blockNumber(), column)
        if address is None:
            return
        self._following = False
        try:
            self._session.show_branch(address.branch)
            self._session.select((address,) if address.state else ())
        finally:
            self._following = True
        self._mark()

    def _follow(self) -> None:
        """Show the selected element (or the SB's beginning) and mark its lines."""
        if not self.isVisible():
            return
        self._refresh()
        self._mark()
        lines = self._selected_lines()
        if self._following and lines:
            self._reveal(min(lines))

    def _reveal(self, line: int) -> None:
        block = self.document().findBlockByNumber(line)
        cursor = QTextCursor(block)
        self.setTextCursor(cursor)
        first = self.firstVisibleBlock().blockNumber()
        shown = range(first + 2 if first else 0, self._last_visible() - 2)
        if line not in shown:
            self.centerCursor()

    def _last_visible(self) -> int:
        return self.cursorForPosition(QPoint(0, self.viewport().height() - 4)).blockNumber()

    def _selected_lines(self) -> set[int]:
        found: set[int] = set()
        for address in self._session.selection[:50]:
            lines = self._source.lines_of(address)
            if lines is not None:
                found.update(range(lines.first, min(lines.last, lines.first + 4000) + 1))
        return found

    def _mark(self) -> None:
        if self._stale or not self.isVisible():
            return
        marks = [self._band(line) for line in sorted(self._selected_lines())]
        marks += [
            mark for finding in self._findings[:MAX_SQUIGGLES] for mark in self._squiggle(finding)
        ]
        self.setExtraSelections(marks)
        self._gutter.update()

    def _band(self, line: int) -> QTextEdit.ExtraSelection:
        mark = QTextEdit.ExtraSelection()
        mark.format.setBackground(self._tokens.accs)
        mark.format.setProperty(QTextFormat.Property.FullWidthSelection, True)
        mark.cursor = QTextCursor(self.document().findBlockByNumber(line))
        return mark

    def _squiggle(self, finding: Finding) -> list[QTextEdit.ExtraSelection]:
        if finding.severity.value == "I":
            return []
        block = self.document().findBlockByNumber(finding.place.line - 1)
        match = _KEY.match(block.text(), max(0, finding.place.column - 1))
        if not block.isValid() or match is None:
            return []
        cursor = QTextCursor(block)
        cursor.setPosition(block.position() + match.start())
        cursor.setPosition(block.position() + match.end(), QTextCursor.MoveMode.KeepAnchor)
        mark = QTextEdit.ExtraSelection()
        mark.format.setUnderlineStyle(QTextCharFormat.UnderlineStyle.WaveUnderline)
        mark.format.setUnderlineColor(severity_colour(finding.severity.value, self._tokens))
        mark.cursor = cursor
        return [mark]

    # The gutter.

    def gutter_width(self) -> int:
        digits = max(3, len(str(self.blockCount())))
        return LEFT + self.fontMetrics().horizontalAdvance("0") * digits + MARKS

    def paint_gutter(self, event: QPaintEvent) -> None:
        """Numbers, and the gravest finding of each line."""
        tokens, painter = self._tokens, QPainter(self._gutter)
        painter.fillRect(event.rect(), tokens.surf)
        painter.setFont(mono_font(12))
        selected = self._selected_lines() if not self._stale else set()
        block: QTextBlock = self.firstVisibleBlock()
        top = self.blockBoundingGeometry(block).translated(self.contentOffset()).top()
        wide = self.gutter_width()
        while block.isValid() and top <= event.rect().bottom():
            height = self.blockBoundingRect(block).height()
            number = block.blockNumber()
            band = QRectF(0, top, wide + 3, height)
            finding = self._by_line.get(number)
            grave = finding is not None and finding.severity.value != "I"
            if number in selected:
                painter.fillRect(band, tokens.accs)
            colour: QColor = tokens.tx3
            if finding is not None and grave:
                colour = severity_colour(finding.severity.value, tokens)
                mark = QRectF(wide - MARKS + 4, top + (height - 13) / 2, 13, 13)
                draw(painter, SEVERITY_ICON[finding.severity.value], mark, colour, tokens.surf)
            painter.setPen(colour)
            room = band.adjusted(0, 0, -MARKS - 3, 0)
            right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(room, right, str(number + 1))
            top += height
            block = block.next()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._place_gutter()

    def _place_gutter(self, _: int = 0) -> None:
        wide = self.gutter_width()
        self.setViewportMargins(wide, 0, 0, 0)
        inside = self.contentsRect()
        self._gutter.setGeometry(QRect(inside.left(), inside.top(), wide + 3, inside.height()))

    def _scroll_gutter(self, rect: QRect, down: int) -> None:
        if down:
            self._gutter.scroll(0, down)
        else:
            self._gutter.update(0, rect.y(), self._gutter.width(), rect.height())


class _Gutter(QWidget):
    def __init__(self, editor: Source) -> None:
        super().__init__(editor)
        self._editor = editor

    def sizeHint(self) -> QSize:
        return QSize(self._editor.gutter_width(), 0)

    def paintEvent(self, event: QPaintEvent) -> None:
        self._editor.paint_gutter(event)


_KEY = re.compile(r'"(?:[^"\\]|\\.)*"')
_TOKEN = re.compile(
    r'("(?:[^"\\]|\\.)*")(\s*:)?(\s*\{)?|(-?\d[\d.eE+-]*|\btrue\b|\bfalse\b|\bnull\b)'
)


class _Colours(QSyntaxHighlighter):
    """Names of SBs and states in the accent, targets in green, what readers skip in grey."""

    def __init__(self, tokens: Tokens, document: QTextDocument) -> None:
        super().__init__(document)
        self._tokens = tokens

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self.rehighlight()

    def highlightBlock(self, text: str) -> None:
        tokens = self._tokens
        for match in _TOKEN.finditer(text):
            word, colon, brace, plain = match.groups()
            if plain is not None:
                self.setFormat(match.start(), len(plain), tokens.unk)
            elif not colon:
                self.setFormat(match.start(), len(word), tokens.ok)
            elif word.startswith('"_') or word == '"HEADER"':
                self.setFormat(match.start(), len(word), tokens.tx3)
            elif brace:
                self.setFormat(match.start(), len(word), tokens.acc)


def _utf16(text: str, at: int) -> int:
    """Qt counts in UTF-16 units."""
    if text.isascii():
        return at
    return len(text[:at].encode("utf-16-le", "surrogatepass")) // 2
