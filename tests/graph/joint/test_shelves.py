"""The answers that a diagram keeps are freed in small steps, so other threads get their turn."""

from __future__ import annotations

from collections.abc import Iterable
from random import Random

import pytest

from smsl_studio.graph.joint import diagram, saturation
from smsl_studio.graph.joint.diagram import Diagram, Relation
from smsl_studio.graph.joint.saturation import Saturation


@pytest.fixture
def freed(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The sizes of the tables that are freed, each in one step."""
    sizes: list[int] = []
    before = diagram.clear

    def clear(tables: Iterable[dict[tuple[int, int], int]]) -> None:
        """Write down the sizes, then clear."""
        every = tuple(tables)
        sizes.extend(len(one) for one in every)
        before(every)

    monkeypatch.setattr(diagram, "clear", clear)
    monkeypatch.setattr(saturation, "clear", clear)
    return sizes


def _sets(made: Diagram, random: Random) -> list[int]:
    points = [[random.randrange(size) for size in made.sizes] for _ in range(300)]
    return [made.point(one) for one in points]


@pytest.mark.parametrize("work", ["union", "both", "without"])
def test_no_large_table_is_freed_in_one_step(work: str, freed: list[int]) -> None:
    made = Diagram([7] * 6, range(6))
    top, found = made.height - 1, 0
    for one in _sets(made, Random(work)):
        found = made.union(found, one, top)
        getattr(made, work)(found, made.box({0: (1, 2), 3: (4,)}), top)
    del made
    assert sum(freed) > 1_000
    assert 16 * max(freed) < sum(freed)


def test_no_large_table_of_a_search_is_freed_in_one_step(freed: list[int]) -> None:
    made = Diagram([7] * 6, range(6))
    random = Random(6)
    relations = []
    for _ in range(20):
        one, other = random.sample(range(6), 2)
        pairs = {n: frozenset({(random.randrange(7), random.randrange(7))}) for n in (one, other)}
        relations.append(Relation(pairs, range(6)))
    search = Saturation(made, relations)
    for one in _sets(made, random):
        search.closed(one)
    del search
    assert sum(freed) > 1_000
    assert 16 * max(freed) < sum(freed)


def test_a_diagram_that_is_renewed_keeps_its_nodes_and_frees_the_rest(freed: list[int]) -> None:
    made = Diagram([7] * 6, range(6))
    first = made.point([1] * 6)
    made.keep()
    random = Random(7)
    sets = _sets(made, random)
    found = 0
    for one in sets:
        found = made.union(found, one, made.height - 1)
    freed.clear()
    made.renew()
    assert sum(freed) > 500
    assert made.has(first, [1] * 6)
    assert made.point([1] * 6) == first
    assert len(made.children) == first + 1
