"""Text from outside, made safe to show: one function for each kind of output.

Names come from files, plugins and other programs, and may hold anything: escape sequences that
steer a terminal, tags that a window or a browser obeys, marks that turn the text around them, and
characters that nobody sees. What cannot be seen is written as an escape (``\\u202e``), in the same
way everywhere; what means something to the reader of the output is escaped for that reader.

==============  ============================================================================
``one_line``    a terminal, or one line of a text
``plain_text``  a label, a tool tip: several lines, no markup, cut where it is too long to be read
``whole_text``  the same, never cut: what is printed, and what is measured
``markup``      HTML, XML, SVG: the content of an element or attribute
``json_text``   JSON: the same values, spelled without what steers
==============  ============================================================================

Data itself (a file that is converted, the value in a field) is never changed.
"""

from __future__ import annotations

from itertools import accumulate, takewhile
from unicodedata import category

DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
"""Characters that change the order in which others are shown."""

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
"""Characters that count as printable and leave nothing on the screen."""


def one_line(text: str) -> str:
    """A text in which nothing ends the line, steers a terminal, turns round or hides."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(_escaped(char) if _is_hidden(char) else char for char in text)


MOST = 4_000
"""So many characters a window shows of one text. The whole stands in the view of the source."""
_TAIL = 40


def plain_text(text: str) -> str:
    """A text for a label or a tool tip, in which nothing turns round or hides.

    Line breaks and tabs stay. A text of more than ``MOST`` characters is cut there, and its end
    says how many more there are: Qt lays out every character, and nobody reads them.
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
    """The same as ``plain_text``, however long it is."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(
        _escaped(char) if _is_hidden(char) and char not in "\n\t" else char for char in text
    )


def markup(text: str) -> str:
    """A text for an element of HTML, XML or SVG, or for an attribute in double quotes."""
    escaped = whole_text(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return escaped.replace('"', "&quot;")


def json_text(text: str) -> str:
    """A JSON text with the same values, in which what is hidden is spelled ``\\uXXXX``."""
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
