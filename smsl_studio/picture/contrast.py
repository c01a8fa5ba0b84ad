"""The contrast of two colours, and the pairs of colours that people must tell apart.

The ratio is that of WCAG 2.2 (1 to 21). Text needs 4.5, in the high-contrast theme 7. Lines and
marks need 3.
"""

from __future__ import annotations

from typing import NamedTuple

from smsl_studio.picture.colours import CONTRAST, DARK, LIGHT, Colours

THEMES: dict[str, Colours] = {"light": LIGHT, "dark": DARK, "contrast": CONTRAST}
TEXT, MARK = 4.5, 3.0
MORE = 7.0
"""The least contrast of text in the high-contrast theme."""
_GROUNDS = ("win", "surf", "sunk", "canvas")
_TINTED = {"acc": "accs", "ok": "oks", "bad": "bads", "unk": "unks", "risk": "risks"}


class Pair(NamedTuple):
    """A colour on a ground. ``least`` is the contrast that it needs in light and dark."""

    ink: str
    ground: str
    least: float


def _pairs() -> tuple[Pair, ...]:
    inks = ("tx", "tx2", "tx3", *_TINTED)
    found = [Pair(ink, ground, TEXT) for ink in inks for ground in _GROUNDS]
    found += [Pair("tx", ground, TEXT) for ground in _TINTED.values()]
    found += [Pair(ink, ground, TEXT) for ink, ground in _TINTED.items()]
    found += [Pair("onacc", "acc", TEXT), Pair("onslate", "slate", TEXT)]
    found += [Pair("white", "stop", TEXT), Pair("stop", "win", MARK)]
    found += [Pair("nl", "surf", MARK), Pair("edge", "canvas", MARK), Pair("slate", "surf", MARK)]
    return tuple(found)


PAIRS = _pairs()
"""All pairs of text, marks and lines with what they lie on."""


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours that are written as ``#RRGGBB``."""
    dark, light = sorted((_luminance(one), _luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def measured(pair: Pair, theme: str) -> float:
    """Return the contrast of a pair in a theme."""
    colours = {"white": "#FFFFFF", **THEMES[theme]}
    return contrast(colours[pair.ink], colours[pair.ground])


def least(pair: Pair, theme: str) -> float:
    """Return the contrast that a pair needs in a theme. The red of Stop is the same in all."""
    if theme == "contrast" and pair.least == TEXT and "stop" not in pair:
        return MORE
    return pair.least


def table() -> list[str]:
    """Return the rows of the table of contrasts, as Markdown."""
    rows = [f"| colour on ground | {' | '.join(THEMES)} | needs |", "|---|---|---|---|---|"]
    for pair in PAIRS:
        figures = " | ".join(f"{measured(pair, theme):.1f}" for theme in THEMES)
        rows.append(f"| {pair.ink} on {pair.ground} | {figures} | {pair.least:.1f} |")
    return rows


def _luminance(colour: str) -> float:
    red, green, blue = (_linear(int(colour[at : at + 2], 16) / 255) for at in (1, 3, 5))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def _linear(share: float) -> float:
    return share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4
