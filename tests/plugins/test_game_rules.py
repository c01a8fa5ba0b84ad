"""What river and chess permit is what the rules of their tasks permit, in every state."""

from __future__ import annotations

import itertools

from benches.layouts.procedures import NEAR, chess, river
from plugins.chess.board import NEAR as BESIDE
from plugins.river.crossing import ITEMS, PLACES, forbidden


def test_the_crossing_permits_what_the_task_permits() -> None:
    table = river()
    permitted = 0
    for state, item, (start, end) in itertools.product(
        table, ITEMS, (("0", "B"), ("B", "0"), ("B", "1"), ("1", "B"))
    ):
        places = dict(zip(ITEMS, state.removeprefix("State_"), strict=True))
        if places[item] != start:
            continue
        name = f"move_{item}_from_{PLACES[start]}_to_{PLACES[end]}"
        assert (not forbidden(places, item, end)) == (name in table[state]), (state, name)
        permitted += name in table[state]
    assert permitted == 92


def test_blocks_beside_each_other_are_those_of_the_task() -> None:
    assert {one: set(near) for one, near in BESIDE.items()} == {
        one: set(near) for one, near in NEAR.items()
    }
    assert len(chess()) == 90
