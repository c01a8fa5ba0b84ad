"""The search by typing in 59,049 states: the index, and each keystroke of typical searches."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from benches.row import Row, median_ms
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.generate.rules import hanoi
from smsl_studio.studio.features.draw.find.places import PlaceIndex

TYPED = (
    "State_abcabc",
    "op_10",
    "abc cba",
    "ccccccccca",
    "zqx",
    "State_aaaaaaaaaa/Op_1",
    "s a b c",
)
MOST, BOUND = 40, 50.0


def rows() -> Iterator[Row]:
    """Measure the rows of this bench."""
    blueprint = hanoi(10)
    yield Row("find: index of 59,049 states", median_ms(lambda: _indexed(blueprint), runs=5),
              bound="once a blueprint")  # fmt: skip
    places = _indexed(blueprint)
    places.find("warm", MOST)
    times = []
    for typed in TYPED:
        for end in range(1, len(typed) + 1):
            times.append(median_ms(partial(places.find, typed[:end], MOST), runs=3))
    yield Row("find: a keystroke in 59,049 states, the slowest of "
              f"{len(times)}", max(times), bound=f"under {BOUND:g} ms")  # fmt: skip


def _indexed(blueprint: Blueprint) -> PlaceIndex:
    places = PlaceIndex()
    places.show(blueprint)
    return places
