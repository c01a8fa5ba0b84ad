"""Text in a picture: its width, and how it is shortened.

No font can be asked. The widths are those of the font Inter plus 3 %. Another font that replaces it
is seldom wider.
"""

from __future__ import annotations

from itertools import accumulate
from unicodedata import east_asian_width

from smsl_studio.legible import one_line, whole_text

_SPARE = 1.03
_ASCII = (
    25, 31, 40, 64, 65, 84, 66, 27, 39, 39, 54, 67, 32, 47, 32, 38, 67, 64, 65, 65, 67, 65, 65, 64,
    65, 65, 34, 34, 67, 67, 67, 54, 100, 72, 70, 74, 77, 63, 59, 77, 75, 29, 56, 68, 57, 91, 75, 79,
    64, 79, 69, 65, 66, 73, 72, 101, 69, 70, 68, 39, 38, 39, 67, 50, 50, 61, 63, 58, 63, 62, 38, 63,
    63, 28, 28, 58, 28, 97, 63, 62, 63, 63, 41, 55, 39, 63, 59, 84, 59, 59, 56, 39, 36, 39, 67,
)  # fmt: skip
"""The widths of the characters from the space to the tilde, in hundredths of the font size."""
_OTHER, _WIDE = 70, 104
MONO = 0.61
FAMILY = "Inter, 'Noto Sans', 'DejaVu Sans', 'Noto Sans CJK SC', sans-serif"
MONO_FAMILY = "'JetBrains Mono', 'Noto Sans Mono', 'DejaVu Sans Mono', monospace"


def width(text: str, size: float) -> float:
    """Return the largest width of a text at a font size (pixels)."""
    return sum(map(_width, whole_text(text))) * size * _SPARE / 100.0


def mono_width(text: str, size: float) -> float:
    """Return the same for the monospaced font of facts."""
    return sum(1.0 if _is_wide(char) else MONO for char in whole_text(text)) * size * _SPARE


def elided(text: str, size: float, room: float) -> str:
    """Return the text, shortened in its middle if it is wider than ``room``. Beginning and end
    stay, because they distinguish names.
    """
    # A far too long text is cut first, so that its length does not matter.
    most = int(room / size * 5) + 2
    long = len(text) > 2 * most
    text = whole_text(f"{text[:most]}{text[-most:]}" if long else text)
    if len(text) <= 2 or (not long and width(text, size) <= room):
        return text
    unit = size * _SPARE / 100.0
    heads = list(accumulate(map(_width, text), initial=0))
    tails = list(accumulate(map(_width, reversed(text)), initial=0))
    for kept in range(len(text) - 1, 1, -1):
        left = (kept + 1) // 2
        if (heads[left] + _width("…") + tails[kept - left]) * unit <= room:
            return f"{text[:left]}…{text[len(text) - (kept - left) :]}"
    return f"{text[:1]}…"


def broken(text: str, size: float, room: float, most: int) -> list[str]:
    """Return the first ``most`` lines of a text, none wider than ``room``. Lines break at spaces,
    or in a word that is too long. The last one ends with … if something is left out.
    """
    unit = size * _SPARE / 100.0
    longest = int(room / (min(_ASCII) * unit)) + 1
    lines: list[str] = []
    for paragraph in text[: (longest + 1) * (most + 1)].expandtabs(4).splitlines():
        rest = one_line(paragraph)
        while len(lines) <= most:
            kept = _fitting(rest, room / unit, longest)
            lines.append(rest[:kept].rstrip())
            rest = rest[kept:].lstrip()
            if not rest:
                break
    if len(lines) > most or len(text) > (longest + 1) * (most + 1):
        lines = lines[:most]
        last = lines[-1]
        while last and width(f"{last}…", size) > room:
            last = last[:-1]
        lines[-1] = f"{last}…"
    return lines


def _fitting(text: str, room: float, longest: int) -> int:
    """Return how many characters fit into a line (hundredths of the font size), at least one."""
    fits = sum(1 for end in accumulate(map(_width, text[: longest + 1])) if end <= room)
    if fits >= len(text):
        return len(text)
    space = text.rfind(" ", 0, fits + 1)
    return space + 1 if space > 0 else max(fits, 1)


def _width(char: str) -> int:
    at = ord(char) - 32
    if 0 <= at < len(_ASCII):
        return _ASCII[at]
    return _WIDE if _is_wide(char) else _OTHER


def _is_wide(char: str) -> bool:
    return ord(char) > 0x10FF and east_asian_width(char) in "WF"
