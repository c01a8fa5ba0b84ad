"""Marks in the text: bands behind lines, wavy lines below words, and the mark of each line."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

from PySide6.QtGui import QColor, QTextCharFormat, QTextCursor, QTextFormat
from PySide6.QtWidgets import QTextEdit

from smsl_studio.errors import Place, ReadError
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.icons import severity_colour
from smsl_studio.studio.base.words import capital, whole_sentence
from smsl_studio.studio.features.draw.source.around import tokens
from smsl_studio.studio.features.draw.source.editor import Editor
from smsl_studio.studio.features.draw.source.find import Match
from smsl_studio.studio.features.draw.source.gutter import Mark
from smsl_studio.studio.features.draw.source.sheet import TextSheet

Selection = QTextEdit.ExtraSelection
MANY = 400
"""At most this many words are underlined."""
MANY_WORDS = 12
"""The words of at most this many marks of one line are shown."""


def offset_of(sheet: TextSheet, place: Place) -> int:
    """The offset in the text of a place (line and column from 1)."""
    start = sheet.offset(sheet.piece_of(place.line - 1), 0)
    return min(start + place.column - 1, len(sheet.text))


def band(editor: Editor, line: int, colour: QColor) -> Selection:
    """A background colour for a line, over the whole width."""
    mark = Selection()
    mark.format.setBackground(colour)
    mark.format.setProperty(QTextFormat.Property.FullWidthSelection, True)
    mark.cursor = QTextCursor(editor.document().findBlockByNumber(line))
    return mark


def behind(editor: Editor, start: int, end: int, colour: QColor) -> Selection:
    """A background colour for a part of the text."""
    mark = Selection()
    mark.format.setBackground(colour)
    mark.cursor = editor.cursor_at(start, end)
    return mark


def wavy(editor: Editor, start: int, end: int, severity: str) -> Selection:
    """A wavy line below a part of the text, in the colour of the severity."""
    mark = Selection()
    mark.format.setUnderlineStyle(QTextCharFormat.UnderlineStyle.WaveUnderline)
    mark.format.setUnderlineColor(severity_colour(severity, editor.tokens))
    mark.cursor = editor.cursor_at(start, end)
    return mark


def fault_span(sheet: TextSheet, fault: ReadError) -> tuple[int, int]:
    """The start and end offset of a fault: within one line, at least one character."""
    if fault.place is None:
        return 0, min(1, len(sheet.text))
    start = offset_of(sheet, fault.place)
    line, column = sheet.where(start)
    end = sheet.offset(line, len(sheet.shown_piece(line)))
    if start >= end and column:
        return end - 1, end
    return start, max(start, min(end, start + max(1, fault.length)))


def word_span(sheet: TextSheet, place: Place, form: str) -> tuple[int, int]:
    """The start and end offset of the word at a place."""
    start = offset_of(sheet, place)
    line, column = sheet.where(start)
    word = next((one for one in tokens(sheet.shown_piece(line), form) if one.end > column), None)
    return (start, start + word.end - max(word.start, column)) if word else (start, start)


def of_findings(editor: Editor, findings: Iterable[Finding], file: str) -> Iterator[Selection]:
    """The underlines for the errors and warnings in this file."""
    shown = (
        (place, finding.severity.value)
        for finding in findings
        if finding.severity.value != "I"
        for place in finding.places_in(file)
    )
    for place, letter in islice(shown, MANY):
        start, end = word_span(editor.sheet, place, editor.form)
        yield wavy(editor, start, end, letter)


def of_faults(editor: Editor, faults: Sequence[ReadError]) -> Iterator[Selection]:
    """The underlines for the faults of this text."""
    for fault in faults[:MANY]:
        start, end = fault_span(editor.sheet, fault)
        yield wavy(editor, start, end, "E")


def of_matches(editor: Editor, matches: Sequence[Match]) -> Iterator[Selection]:
    """The backgrounds of search matches.

    If there are very many, only those in and after the view.
    """
    rows = [line for line, _, _ in editor.rows()] if len(matches) > MANY else []
    first = editor.sheet.offset(rows[0], 0) if rows else 0
    begin = bisect_left(matches, first, key=lambda one: one.start)
    for match in matches[begin : begin + MANY]:
        yield behind(editor, match.start, match.end, editor.tokens.risks)


def by_line(
    sheet: TextSheet, findings: Iterable[Finding], faults: Iterable[ReadError], file: str
) -> dict[int, Mark]:
    """The worst mark of each line, with the words of its first marks."""
    found: dict[int, list[Mark]] = {}
    for fault in faults:
        line = sheet.where(fault_span(sheet, fault)[0])[0]
        words = f"{capital(fault.sentence)} {fault.advice}".strip()
        found.setdefault(line, []).append(Mark("E", words))
    for finding in sorted(findings, key=lambda one: "EWI".index(one.severity.value)):
        words = f"{whole_sentence(finding)} {finding.advice}".strip()
        for place in finding.places_in(file):
            line = sheet.where(offset_of(sheet, place))[0]
            found.setdefault(line, []).append(Mark(finding.severity.value, words))
    return {line: _together(marks) for line, marks in found.items()}


def _together(marks: Sequence[Mark]) -> Mark:
    words = [mark.words for mark in marks[:MANY_WORDS]]
    if len(marks) > MANY_WORDS:
        words.append(f"And {len(marks) - MANY_WORDS:,} more.")
    return Mark(marks[0].severity, "\n".join(words))
