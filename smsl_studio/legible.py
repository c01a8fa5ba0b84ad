"""Text from outside, made safe to show: one function for each kind of output.

Names come from files, plugins and other programs, and may contain any character: escape sequences
that control a terminal, tags of HTML, marks that change the direction of the text, and invisible
characters. An invisible character is shown as an escape (``\\u202e``) in every kind of output.
Characters with a meaning in one kind of output are escaped for that kind.

==============  ============================================================================
``one_line``    a terminal, or one line of a text
``plain_text``  a label, a tool tip: several lines, no markup, cut if it is too long to be read
``whole_text``  the same, never cut: for printing and measuring
``markup``      HTML, XML, SVG: the content of an element or attribute
``json_text``   JSON: the same values, with hidden characters as escapes
==============  ============================================================================

Data itself (a file that is converted, the value in a field) is never changed.
"""

from __future__ import annotations

from itertools import accumulate, takewhile
from unicodedata import category

DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
"""Characters that change the direction in which other characters are shown."""

_BLANK = frozenset(
    map(
        chr,
        (
            *(0x034F, 0x115F, 0x1160, 0x17B4, 0x17B5, 0x2800, 0x3164, 0xFFA0),
            *range(0x180B, 0x1810),
            *range(0xFE00, 0xFE10),
            *range(0xE0100, 0xE01F0),
        ),
    )
)
"""Characters that count as printable but are invisible."""


def one_line(text: str) -> str:
    """Return a text of one line: line ends, control characters, marks of direction and invisible
    characters are escaped."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(_escaped(char) if _is_hidden(char) else char for char in text)


MOST = 4_000
"""The largest number of characters of one text that a window shows. The view of the source shows
the whole text."""
_TAIL = 40


def plain_text(text: str) -> str:
    """Return a text for a label or a tool tip, with hidden characters escaped.

    Line breaks and tabs stay. A text of more than ``MOST`` characters is cut, and its end tells the
    number of the others. Qt would lay out every character, and nobody reads so many.
    """
    shown = whole_text(text[: MOST + 1])
    if len(shown) <= MOST:
        return shown
    kept = room = MOST - _TAIL
    if whole_text(text[:kept]) != text[:kept]:
        sizes = accumulate(len(whole_text(char)) for char in text[:kept])
        kept = sum(1 for _ in takewhile(lambda size: size <= room, sizes))
    return f"{whole_text(text[:kept])}… and {len(text) - kept:,} characters more"


def whole_text(text: str) -> str:
    """Return the same as ``plain_text``, but never cut."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(
        _escaped(char) if _is_hidden(char) and char not in "\n\t" else char for char in text
    )


def markup(text: str) -> str:
    """Return a text for an element of HTML, XML or SVG, or for an attribute in double quotes."""
    escaped = whole_text(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return escaped.replace('"', "&quot;")


def json_text(text: str) -> str:
    """Return a JSON text with the same values, with hidden characters written as ``\\uXXXX``."""
    if text.isascii() and "\x7f" not in text:
        return text  # JSON escapes the other control characters by itself
    return "".join(_as_json(char) if _is_hidden(char) and char != "\n" else char for char in text)


def _is_hidden(char: str) -> bool:
    if char.isprintable():
        return char in _BLANK
    return category(char) != "Zs"


def _escaped(char: str) -> str:
    return char.encode("unicode_escape").decode("ascii")


def _as_json(char: str) -> str:
    units = char.encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[at]:02x}{units[at + 1]:02x}" for at in range(0, len(units), 2))
