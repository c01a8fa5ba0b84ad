"""The choice of places for labels: all together as one by one, and with few comparisons."""

from __future__ import annotations

import random

import numpy as np
import pytest

from smsl_studio.picture.label_candidates import candidates
from smsl_studio.picture.label_choice import LabelChoice
from smsl_studio.picture.labels import LabelPlaces, Rect, meet
from smsl_studio.picture.line_pieces import LinePieces
from smsl_studio.picture.shape import EdgeShape, rounded

WAYS = ["line", "curve", "lane", "detour", "bent", "stub"]
NO_NODES = np.zeros((0, 4))


def some_shapes(seed: int, count: int = 40) -> dict[int, EdgeShape]:
    """Lines of all kinds, with two to many points."""
    dice = random.Random(seed)
    found = {}
    for edge in range(count):
        corners = [
            (dice.uniform(0, 900), dice.uniform(0, 600)) for _ in range(dice.randrange(2, 6))
        ]
        points = np.array(corners) if dice.random() < 0.4 else rounded(corners, 10.0)
        side, out = dice.choice([-1, 0, 1]), dice.choice([-1, 1])
        found[edge] = EdgeShape(points, dice.choice(WAYS), side, out)
    return found


def places_of(choice: LabelChoice, edges: list[int]) -> dict[int, Rect | None]:
    return {edge: choice.take(edge) for edge in edges}


@pytest.mark.parametrize("compact", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_all_labels_together_get_the_places_that_they_get_one_by_one(
    seed: int, compact: bool
) -> None:
    shapes = some_shapes(seed)
    sizes = [(30.0 + 7.0 * (edge % 9), 15.0) for edge in shapes]
    nodes = np.array([[300.0, 200.0, 54.0, 27.0]])
    places = LabelPlaces(nodes, 1.0)
    together = places_of(LabelChoice(shapes, sizes, places, compact), list(shapes))
    places = LabelPlaces(nodes, 1.0)
    alone: dict[int, Rect | None] = {}
    for edge, shape in shapes.items():
        one = LabelChoice({edge: shape}, [sizes[edge]], places, compact)
        alone[edge] = one.take(edge)
    assert together == alone
    assert sum(rect is not None for rect in alone.values()) > 20


def test_a_label_on_a_line_lies_where_the_line_is() -> None:
    for some in candidates(some_shapes(9), [(40.0, 15.0)] * 40, 1.0, False):
        shapes = some_shapes(9)
        for edge, rects, fits in zip(some.edges, some.rects, some.fits, strict=True):
            first = rects[np.nonzero(some.costs == some.costs.min())[0][0]]
            if fits.any() and not shapes[edge].side:
                middle = (first[0] + first[2]) / 2, (first[1] + first[3]) / 2
                assert shapes[edge].distance(*middle) == pytest.approx(0.0, abs=1e-6)


def test_a_label_gives_way_to_a_line_that_comes_to_run_below_it() -> None:
    shapes = {0: EdgeShape(np.array([[0.0, 0.0], [200.0, 0.0]]))}
    alone = LabelChoice(shapes, [(40.0, 15.0)], LabelPlaces(NO_NODES, 1.0), False).take(0)
    shapes[1] = EdgeShape(np.array([[96.0, -90.0], [96.0, 90.0]]))
    places = LabelPlaces(NO_NODES, 1.0)
    places.lines = LinePieces(shapes)
    choice = LabelChoice(shapes, [(40.0, 15.0)] * 2, places, False)
    first, second = choice.take(0), choice.take(1)
    assert first is not None
    assert second is not None
    assert first != alone, "a word in the gap of an arrow is taken for its name"
    assert first[2] < 96.0 or first[0] > 96.0
    assert not meet(first, second)


def test_a_way_is_crossed_by_other_lines_alone() -> None:
    pieces = LinePieces({7: EdgeShape(np.array([[0.0, 10.0], [50.0, 10.0]]))})
    starts, ends = np.array([[[5.0, 0.0], [60.0, 0.0]]]), np.array([[[5.0, 20.0], [60.0, 20.0]]])
    assert pieces.uncrossed([3], starts, ends).tolist() == [[False, True]]
    assert pieces.uncrossed([7], starts, ends).tolist() == [[True, True]]
