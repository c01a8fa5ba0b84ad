"""Where the rows of a node stand: its name, its title and its facts. Canvas and SVG share them."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.picture.levels import FULL_SIZE
from smsl_studio.picture.picture import Face

TITLED = 148.0
"""A title makes a node at most so wide (pixels); a longer one is shortened."""


@dataclass(frozen=True)
class Rows:
    """Distances below the middle of a node (pixels): the baselines of name and title, the top of
    the facts; and the height of a fact."""

    name: float
    title: float
    chips: float
    chip: float


PLAIN = Rows(19.0 - FULL_SIZE[1] / 2, 0.0, 27.0 - FULL_SIZE[1] / 2, 18.0)
FULL = Rows(15.5 - FULL_SIZE[1] / 2, 27.5 - FULL_SIZE[1] / 2, 31.0 - FULL_SIZE[1] / 2, 15.0)
NAME_ALONE = Rows(4.2, 0.0, 0.0, 0.0)
NAME_AND_TITLE = Rows(-2.0, 15.0, 0.0, 0.0)


def rows_of(face: Face) -> Rows:
    """Return the rows of a full node.

    A title stands between name and facts. The node keeps its height, so that nothing moves.
    """
    if face.chips:
        return FULL if face.title else PLAIN
    return NAME_AND_TITLE if face.title else NAME_ALONE
