"""Finding in a text: plain words or a regular expression, and what replaces what was found."""

from __future__ import annotations

import re
from dataclasses import dataclass

from PySide6.QtCore import QRegularExpression

from smsl_studio.studio.features.draw.source.shown_text import from_units

MOST = 10_000
"""Places that are counted at most."""
_GROUP = re.compile(r"\\([0-9]|\\|n|t)")


@dataclass(frozen=True)
class TextSearch:
    """What is looked for."""

    words: str
    case: bool = False
    whole: bool = False
    regular: bool = False


@dataclass(frozen=True)
class Match:
    """Where something was found, and what each group of the expression stands for."""

    start: int
    end: int
    groups: tuple[str, ...]


@dataclass(frozen=True)
class Found:
    """Everything that was found; ``fault`` says why nothing could be looked for."""

    matches: tuple[Match, ...] = ()
    fault: str = ""
    more: bool = False


def find(text: str, search: TextSearch) -> Found:
    """All places of what is looked for. Qt's engine gives up where an expression goes astray."""
    if not search.words:
        return Found()
    expression = _expression(search)
    if not expression.isValid():
        return Found(fault=f"No valid expression: {expression.errorString()}")
    matches: list[Match] = []
    # Qt counts in UTF-16 units; the text before a match is counted once.
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
    # Behind an empty match at the end the iterator is not valid either.
    if not found.isValid() and not expression.match(text, last).isValid():
        return Found(fault="The expression takes too long")
    return Found(tuple(matches))


def replaced(match: Match, words: str, search: TextSearch) -> str:
    """What stands in place of a match: in expressions ``\\1`` is its first group."""
    if not search.regular:
        return words

    def group(mark: re.Match[str]) -> str:
        """What a mark such as ``\\1`` or ``\\n`` stands for."""
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
