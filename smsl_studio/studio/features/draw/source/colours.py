"""Colours of a text: names of SBs and states in the accent, targets green, notes grey.

Each line is coloured on its own just before it is painted. So neither a large file nor a keystroke
in it takes long.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from PySide6.QtGui import QColor, QTextBlock, QTextCharFormat, QTextLayout
from PySide6.QtWidgets import QPlainTextEdit

from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.draw.source.around import TextToken, tokens
from smsl_studio.studio.features.draw.source.shown_text import units

Piece = tuple[int, int, str]
"""(start column, end column, name of the colour in ``Tokens``)."""
_JSON = re.compile(
    r'("(?:[^"\\]|\\.)*")(\s*:)?(\s*\{)?|(-?\d[\d.eE+-]*|\btrue\b|\bfalse\b|\bnull\b)'
)
_HEADER = re.compile(r"\s*(#\s*[^:\s]+\s*:)")


def pieces(line: str, form: str) -> Iterator[Piece]:
    """The coloured pieces of a line; the rest has the colour of text."""
    if form == "json":
        yield from _json(line)
    elif form == "smsl":
        yield from _native(line)
    else:
        yield from _yaml(line)


def _json(line: str) -> Iterator[Piece]:
    for match in _JSON.finditer(line):
        word, colon, brace, plain = match.groups()
        if plain is not None:
            yield match.start(), match.end(), "unk"
        elif not colon:
            yield match.start(), match.start() + len(word), "ok"
        elif word.startswith('"_') or word == '"HEADER"':
            yield match.start(), match.start() + len(word), "tx3"
        elif brace:
            yield match.start(), match.start() + len(word), "acc"


def _native(line: str) -> Iterator[Piece]:
    header = _HEADER.match(line)
    if header:
        yield header.start(1), header.end(1), "tx3"
        return
    found = tokens(line, "smsl")
    for at, token in enumerate(found):
        following = found[at + 1].text if at + 1 < len(found) else ""
        if token.text.startswith(("//", "#")):
            yield token.start, token.end, "tx3"
        elif at and found[at - 1].text == "->":
            yield token.start, token.end, "ok"
        elif following == ":":
            yield token.start, token.end, "acc"


def _yaml(line: str) -> Iterator[Piece]:
    found = [token for token in tokens(line, "yaml") if token.text != "-"]
    for at, token in enumerate(found):
        after = [one.text for one in found[at + 1 : at + 3]]
        if token.text.startswith("#"):
            yield token.start, token.end, "tx3"
        elif after[:1] == [":"]:
            yield from _yaml_key(token, after[1:])
        elif at and found[at - 1].text == ":" and token.text not in ("{", "["):
            yield token.start, token.end, "ok"


def _yaml_key(token: TextToken, value: list[str]) -> Iterator[Piece]:
    if token.name.startswith("_") or token.name == "HEADER":
        yield token.start, token.end, "tx3"
    elif not value or value[0] in ("{", "["):
        yield token.start, token.end, "acc"


MANY = 5_000
"""If more blocks than this have changed, each block is coloured again when it is painted."""


class Colours:
    """Colours the visible blocks with the colours of the theme."""

    def __init__(self, edit: QPlainTextEdit, colours: Tokens) -> None:
        self._edit, self._tokens = edit, colours
        self._form, self._wearing = "json", 1

    def set_tokens(self, colours: Tokens) -> None:
        """Use the colours of another theme; blocks are coloured again when they are painted."""
        self._tokens = colours
        self._wearing += 1

    def set_form(self, form: str) -> None:
        """Use the rules of this written form (json, smsl or yaml)."""
        if form != self._form:
            self._form = form
            self._wearing += 1

    def forget(self, block: QTextBlock, last: int) -> None:
        """Colour the blocks from this one to the number ``last`` again, because they have
        changed."""
        if last - block.blockNumber() > MANY:
            self._wearing += 1
            return
        while block.isValid() and block.blockNumber() <= last:
            block.setUserState(0)
            block = block.next()

    def dress(self, block: QTextBlock, count: int) -> None:
        """Colour ``count`` visible blocks that are about to be painted."""
        while block.isValid() and count > 0:
            if block.isVisible():
                count -= 1
                if block.userState() != self._wearing:
                    self._colour(block)
            block = block.next()

    def _colour(self, block: QTextBlock) -> None:
        line = block.text()
        ranges = []
        for start, end, name in pieces(line, self._form):
            part = QTextLayout.FormatRange()
            part.start = units(line[:start])
            part.length = units(line[start:end])
            part.format = _format(getattr(self._tokens, name))
            ranges.append(part)
        block.setUserState(self._wearing)
        if ranges or block.layout().formats():
            block.layout().setFormats(ranges)
            self._edit.document().markContentsDirty(block.position(), block.length())


def _format(colour: QColor) -> QTextCharFormat:
    made = QTextCharFormat()
    made.setForeground(colour)
    return made
