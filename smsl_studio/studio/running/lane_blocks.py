"""What the timeline shows of the blocks of a lane: which are seen, and how wide their words are."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence

from PySide6.QtGui import QFont, QFontMetricsF

from smsl_studio.front.views.timeline_lanes import Block
from smsl_studio.studio.base.theme import mono_font, text_font


def words_font(kind: str) -> QFont:
    """The font of the words of a block in a lane of this kind."""
    return text_font(12, 600) if kind == "operation" else mono_font(12, 500)


def words_width(kind: str, words: str) -> float:
    """The width of a block's words (pixels)."""
    return QFontMetricsF(words_font(kind)).horizontalAdvance(words) + 6


def seen_blocks(
    blocks: Sequence[Block], starts: Sequence[float], left: float, right: float, pixel: float
) -> Iterator[int]:
    """The blocks between two times.

    If several fall on one pixel, it takes the first and the last, which may continue for long.
    """
    at = max(bisect_right(starts, left) - 1, 0)
    while at < len(blocks) and starts[at] <= right:
        yield at
        end = blocks[at].end
        narrow = end is not None and end - starts[at] < pixel
        at = max(bisect_left(starts, starts[at] + pixel) - 1, at + 1) if narrow else at + 1
