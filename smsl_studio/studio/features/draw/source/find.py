"""Searches a text for words or a regular expression, and makes the replacements."""

from __future__ import annotations

import re
from dataclasses import dataclass

from PySide6.QtCore import QRegularExpression

from smsl_studio.studio.features.draw.source.shown_text import from_units

MOST = 10_000
"""At most this many matches are counted."""
_GROUP = re.compile(r"\\([0-9]|\\|n|t)")


@dataclass(frozen=True)
class TextSearch:
    """What to search for: the words, and the three options of the bar."""

    words: str
    case: bool = False
    whole: bool = False
    regular: bool = False


@dataclass(frozen=True)
class Match:
    """A match: its offsets, and the text of each group of the expression."""

    start: int
    end: int
    groups: tuple[str, ...]


@dataclass(frozen=True)
class Found:
    """All matches. ``fault`` says why the search failed; ``more`` that there are more matches."""

    matches: tuple[Match, ...] = ()
    fault: str = ""
    more: bool = False


def find(text: str, search: TextSearch) -> Found:
    """All matches in a text.

    Qt's engine is used because it gives up on expressions that take too long.
    """
    if not search.words:
        return Found()
    expression = _expression(search)
    if not expression.isValid():
        return Found(fault=f"No valid expression: {expression.errorString()}")
    matches: list[Match] = []
    # Qt counts in UTF-16 units; each part of the text is counted once.
    units, at, last = 0, 0, 0
    found = expression.globalMatch(text)
    while found.hasNext():
        match = found.next()
        if len(matches) == MOST:
            return Found(tuple(matches), more=True)
        at += from_units(
            text[at : at + match.capturedStart() - units], match.capturedStart() - units
        )
        units, last = match.capturedStart(), match.capturedEnd()
        end = at + len(match.captured())
        if end > at:
            groups = tuple(match.captured(n) for n in range(match.lastCapturedIndex() + 1))
            matches.append(Match(at, end, groups))
    # After an empty match at the end, the iterator is invalid too.
    if not found.isValid() and not expression.match(text, last).isValid():
        return Found(fault="The expression takes too long")
    return Found(tuple(matches))


def replaced(match: Match, words: str, search: TextSearch) -> str:
    """The replacement of a match. In an expression, ``\\1`` stands for its first group."""
    if not search.regular:
        return words

    def group(mark: re.Match[str]) -> str:
        """The text for a mark such as ``\\1`` or ``\\n``."""
        letter = mark[1]
        if letter.isdigit():
            at = int(letter)
            return match.groups[at] if at < len(match.groups) else ""
        return {"n": "\n", "t": "\t", "\\": "\\"}[letter]

    return _GROUP.sub(group, words)


def _expression(search: TextSearch) -> QRegularExpression:
    pattern = search.words if search.regular else QRegularExpression.escape(search.words)
    if search.whole:
        pattern = rf"(?<![\w-])(?:{pattern})(?![\w-])"
    made = QRegularExpression(pattern)
    options = QRegularExpression.PatternOption.UseUnicodePropertiesOption
    options |= QRegularExpression.PatternOption.MultilineOption
    if not search.case:
        options |= QRegularExpression.PatternOption.CaseInsensitiveOption
    made.setPatternOptions(options)
    return made
