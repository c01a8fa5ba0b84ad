"""Marks in the text: bands behind lines, wavy lines below pieces, and the words of each line."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence

from PySide6.QtGui import QColor, QTextCharFormat, QTextCursor, QTextFormat
from PySide6.QtWidgets import QTextEdit

from smsl_studio.errors import Place, ReadError
from smsl_studio.inspection.finding import Finding
from smsl_studio.studio.icons import severity_colour
from smsl_studio.studio.source.around import tokens
from smsl_studio.studio.source.editor import Editor
from smsl_studio.studio.source.find import Match
from smsl_studio.studio.source.gutter import Mark
from smsl_studio.studio.source.sheet import Sheet
from smsl_studio.studio.words import capital, whole_sentence

Selection = QTextEdit.ExtraSelection
MANY = 400
"""Pieces that are underlined at most."""


def offset_of(sheet: Sheet, place: Place) -> int:
    """The offset in the text of a place in it."""
    start = sheet.offset(sheet.piece_of(place.line - 1), 0)
    return min(start + place.column - 1, len(sheet.text))


def band(editor: Editor, line: int, colour: QColor) -> Selection:
    """A line in another colour, over the whole width."""
    mark = Selection()
    mark.format.setBackground(colour)
    mark.format.setProperty(QTextFormat.Property.FullWidthSelection, True)
    mark.cursor = QTextCursor(editor.document().findBlockByNumber(line))
    return mark


def behind(editor: Editor, start: int, end: int, colour: QColor) -> Selection:
    """A piece of the text on another colour."""
    mark = Selection()
    mark.format.setBackground(colour)
    mark.cursor = editor.cursor_at(start, end)
    return mark


def wavy(editor: Editor, start: int, end: int, severity: str) -> Selection:
    """A piece of the text with a wavy line below it."""
    mark = Selection()
    mark.format.setUnderlineStyle(QTextCharFormat.UnderlineStyle.WaveUnderline)
    mark.format.setUnderlineColor(severity_colour(severity, editor.tokens))
    mark.cursor = editor.cursor_at(start, end)
    return mark


def fault_span(sheet: Sheet, fault: ReadError) -> tuple[int, int]:
    """The offsets between which a fault stands, within its line and one character at least."""
    if fault.place is None:
        return 0, min(1, len(sheet.text))
    start = offset_of(sheet, fault.place)
    line, column = sheet.where(start)
    end = sheet.offset(line, len(sheet.shown_piece(line)))
    if start >= end and column:
        return end - 1, end
    return start, max(start, min(end, start + max(1, fault.length)))


def finding_span(sheet: Sheet, finding: Finding, form: str) -> tuple[int, int]:
    """The offsets of the word a finding is about."""
    start = offset_of(sheet, finding.place)
    line, column = sheet.where(start)
    word = next((one for one in tokens(sheet.shown_piece(line), form) if one.end > column), None)
    return (start, start + word.end - max(word.start, column)) if word else (start, start)


def of_findings(editor: Editor, findings: Sequence[Finding]) -> Iterator[Selection]:
    """The findings of this text, underlined; notes are not."""
    for finding in findings[:MANY]:
        if finding.severity.value != "I":
            start, end = finding_span(editor.sheet, finding, editor.form)
            yield wavy(editor, start, end, finding.severity.value)


def of_faults(editor: Editor, faults: Sequence[ReadError]) -> Iterator[Selection]:
    """The faults of this text, underlined."""
    for fault in faults[:MANY]:
        start, end = fault_span(editor.sheet, fault)
        yield wavy(editor, start, end, "E")


def of_matches(editor: Editor, matches: Sequence[Match]) -> Iterator[Selection]:
    """What was found, on another colour; of very many those in view and around."""
    rows = [line for line, _, _ in editor.rows()] if len(matches) > MANY else []
    first = editor.sheet.offset(rows[0], 0) if rows else 0
    begin = bisect_left(matches, first, key=lambda one: one.start)
    for match in matches[begin : begin + MANY]:
        yield behind(editor, match.start, match.end, editor.tokens.risks)


def by_line(
    sheet: Sheet, findings: Iterable[Finding], faults: Iterable[ReadError]
) -> dict[int, Mark]:
    """The gravest mark of each line, with the words of all of them."""
    found: dict[int, Mark] = {}
    for fault in faults:
        line = sheet.where(fault_span(sheet, fault)[0])[0]
        _add(found, line, Mark("E", f"{capital(fault.sentence)} {fault.advice}".strip()))
    for finding in sorted(findings, key=lambda one: "EWI".index(one.severity.value)):
        line = sheet.where(offset_of(sheet, finding.place))[0]
        words = f"{whole_sentence(finding)} {finding.advice}".strip()
        _add(found, line, Mark(finding.severity.value, words))
    return found


def _add(found: dict[int, Mark], line: int, mark: Mark) -> None:
    before = found.get(line)
    words = f"{before.words}\n{mark.words}" if before else mark.words
    found[line] = Mark(before.severity if before else mark.severity, words)
