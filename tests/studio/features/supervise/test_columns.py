"""The columns of the partial view never overlap, for any width and any names."""

from __future__ import annotations

import itertools

import pytest

from smsl_studio.studio.features.supervise.columns import columns

WIDTHS = (724, 820, 884, 1045, 1524, 2200)
NODES = (108.0, 140.0, 200.0)


@pytest.mark.parametrize(("width", "nodes"), list(itertools.product(WIDTHS, NODES)))
def test_they_follow_each_other_within_the_width(width: int, nodes: float) -> None:
    found = columns(width, (nodes, nodes, nodes))
    placed = (found.previous, found.current, found.cards, found.neighbours)
    for (left, wide), (right, _) in itertools.pairwise(placed):
        assert left + wide + 36 <= right
    last, wide = found.neighbours
    assert last + wide <= width
    assert all(wide >= 90 for _, wide in placed)
