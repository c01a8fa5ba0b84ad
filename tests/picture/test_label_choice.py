"""The choice of places for labels: all together as one by one, and with few comparisons."""

from __future__ import annotations

import random

import numpy as np
import pytest

from smsl_studio.generate.rules import hanoi
from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.label_candidates import candidates
from smsl_studio.picture.labels import LabelChoice, LabelPlaces, LinePieces, Rect
from smsl_studio.picture.shape import EdgeShape, rounded
from tests.studio.base.canvas.test_labels import geometry_of, shown

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
    lines, nodes = LinePieces(shapes), np.array([[300.0, 200.0, 54.0, 27.0]])
    places = LabelPlaces(nodes, 1.0)
    together = places_of(LabelChoice(shapes, sizes, places, lines, compact), list(shapes))
    places = LabelPlaces(nodes, 1.0)
    alone: dict[int, Rect | None] = {}
    for edge, shape in shapes.items():
        one = LabelChoice({edge: shape}, [sizes[edge]], places, lines, compact)
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


def test_labels_of_a_picture_are_compared_with_its_lines_together(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[int] = []
    covered = LinePieces.covered

    def counted(self: LinePieces, edge: int, rects: list[Rect]) -> list[int]:
        asked.append(edge)
        return covered(self, edge, rects)

    monkeypatch.setattr(LinePieces, "covered", counted)
    geometry = geometry_of(hanoi(4), "SB1", (64.0, 24.0), LineStyle(1.3, True))
    assert len(shown(geometry)) > 200
    assert len(asked) < 120, "a zoom lays out 240 labels anew"


def test_a_place_that_a_line_crosses_is_counted_for_each_label() -> None:
    shapes = {0: EdgeShape(np.array([[0.0, 0.0], [100.0, 0.0]]))}
    shapes[1] = EdgeShape(np.array([[50.0, -40.0], [50.0, 40.0]]))
    lines = LinePieces(shapes)
    rects = [(40.0, -7.0, 60.0, 7.0), (40.0, -7.0, 60.0, 7.0), (52.0, -7.0, 60.0, 7.0)]
    assert lines.covered_by_each([0, 1, 0], rects, 4.0) == [(1, 1), (1, 1), (0, 1)]
    assert lines.covered_by_each([], [], 4.0) == []
    assert LinePieces({}).covered_by_each([0], rects[:1], 4.0) == [(0, 0)]
