"""The steps of an arrangement: cycles, orders, places and costs, and that they never depend on the
machine.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph import spread
from smsl_studio.graph.arrangement import MOST_STATES, arranged, ties_for
from smsl_studio.graph.brandes_koepf import heights
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.column_order import columns_of, in_order
from smsl_studio.graph.compaction import compacted
from smsl_studio.graph.crossings import CROSSING, THROUGH, Floats, Ties, cost_of, costs_at, is_clear
from smsl_studio.graph.layers import by_chains, by_steps
from smsl_studio.graph.local_search import settle
from smsl_studio.stop import Stopped, heeding
from tests.graph.test_layout import covers

Pairs = list[tuple[int, int]]


def branch_of(pairs: Pairs, size: int) -> StateBranch:
    table: dict[str, dict[str, str]] = {f"S{i}": {} for i in range(size)}
    for number, (a, b) in enumerate(pairs):
        table[f"S{a}"][f"o{number}"] = f"S{b}"
    return StateBranch("SB", dict(table))


def ties(pairs: Pairs, size: int) -> Ties:
    return ties_for(branch_of(pairs, size))


def test_a_cycle_is_broken_at_the_way_back_to_initial() -> None:
    graph = graph_of(branch_of([(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)], 4))
    assert by_chains(graph, 0) == [0, 1, 2, 3]
    assert by_steps(graph, 0) == [0, 1, 1, 2]


def test_what_leads_into_a_chain_stands_just_before_it() -> None:
    graph = graph_of(branch_of([(0, 1), (1, 2), (2, 3), (4, 3)], 5))
    assert by_chains(graph, 0) == [0, 1, 2, 3, 2]
    assert by_steps(graph, 0) == [0, 1, 2, 3, 2]


def test_an_order_without_crossings_is_found() -> None:
    """Two columns in opposite order, and a line that passes the column between."""
    pairs = [(0, 5), (0, 4), (0, 3), (3, 8), (4, 7), (5, 6), (0, 1), (1, 2), (2, 9), (0, 9)]
    layer = [0, 1, 2, 1, 1, 1, 2, 2, 2, 3]
    found = in_order(columns_of(ties(pairs, 10), layer))
    assert sorted(v for column in found.columns for v in column if v < 10) == list(range(10))
    assert sum(v >= 10 for column in found.columns for v in column) == 2
    for one, other in pairwise(found.columns):
        lines = [(i, other.index(u)) for i, v in enumerate(one) for u, _ in found.right[v]]
        assert not [1 for a, b in lines for c, d in lines if a < c and b > d]


def test_passing_lines_are_straight_and_nothing_overlaps() -> None:
    pairs = [(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)]
    found = in_order(columns_of(ties(pairs, 5), [0, 1, 2, 3, 4]))
    y = heights(found, [100] * 5 + [50] * 3)
    assert len({y[knot] for knot in (5, 6, 7)}) == 1
    assert all(abs(y[a] - y[b]) >= 75 for a, b in found.columns[1:4])


def test_the_cost_counts_crossings_nodes_in_the_way_and_length() -> None:
    two = ties([(0, 1), (2, 3)], 4)
    apart = np.array([[0, 0], [600, 0], [0, 400], [600, 400]], dtype=float)
    assert cost_of(two, apart) == 1200.0
    crossed = apart[[0, 3, 2, 1]]
    assert cost_of(two, crossed) == CROSSING + 2 * 721.0
    through = np.array([[0, 0], [600, 0], [300, 0], [300, 400]], dtype=float)
    assert cost_of(two, through) > THROUGH
    for at in (apart, crossed, through):
        every = [costs_at(two, at, state, at[state : state + 1])[0] for state in range(4)]
        assert max(every) <= cost_of(two, at)


def test_a_place_that_is_too_dear_costs_no_more_than_that() -> None:
    """The cost of a state at each place is the same, whether a limit is known or not."""
    some = ties([(i, (i * 5 + 2) % 23) for i in range(23)] + [(3, 9), (0, 7)], 23)
    chance = np.random.default_rng(8)
    at = np.round(chance.random((23, 2)) * (12, 9)) * some.step
    places = np.round(chance.random((40, 2)) * (12, 9)) * some.step
    for state in range(23):
        whole = costs_at(some, at, state, places)
        most = float(np.sort(whole)[20])
        assert (
            costs_at(some, at, state, places, most) == np.where(whole < most, whole, np.inf)
        ).all()


def test_what_a_state_costs_less_elsewhere_the_whole_layout_costs_less() -> None:
    some = ties([(i, (i * 7 + 3) % 19) for i in range(19)] + [(1, 9), (0, 7)], 19)
    chance = np.random.default_rng(3)
    at = np.round(chance.random((19, 2)) * (40, 40)) * some.step
    for state in range(19):
        moved = at.copy()
        moved[state] = np.round(chance.random(2) * (40, 40)) * some.step
        here, there = costs_at(some, at, state, np.stack([at[state], moved[state]]))
        assert cost_of(some, moved) - cost_of(some, at) == there - here


def test_a_gap_that_nothing_needs_is_closed() -> None:
    two = ties([(0, 1), (1, 2)], 3)
    at = np.array([[0, 0], [218, 0], [1090, 550]], dtype=float)
    near = compacted(two, at)
    assert near.tolist() == [[0, 0], [218, 0], [327, 110]]
    assert compacted(two, near).tolist() == near.tolist()
    assert (compacted(two, at, across=False)[:, 0] == at[:, 0]).all()
    assert not covers({str(i): (x, y) for i, (x, y) in enumerate(near.tolist())})


def test_states_settle_where_no_lines_cross_and_only_they_move() -> None:
    four = ties([(0, 1), (2, 3)], 4)
    at = np.array([[0, 0], [654, 416], [0, 416], [654, 0]], dtype=float)
    free = settle(four, at)
    assert not is_clear(four, at)
    assert is_clear(four, free)
    one = settle(four, at, stays=(0, 1, 2))
    assert (one[:3] == at[:3]).all()
    assert cost_of(four, one) < cost_of(four, at)
    columns = settle(four, at, across=False)
    assert (columns[:, 0] == at[:, 0]).all()
    assert is_clear(four, columns)


def test_settling_can_be_called_off() -> None:
    def stop() -> None:
        raise Stopped

    with pytest.raises(Stopped), heeding(stop):
        arranged(branch_of([(i, (i * 7 + 3) % 40) for i in range(40)], 40))


def test_a_sum_in_another_order_gives_the_same_layout_by_distances() -> None:
    """The numbers are rounded so that each sum is exact, as another machine would make it."""
    branch = branch_of([(i, i ^ 1 << bit) for i in range(64) for bit in range(6)], 64)
    _, steps = spread._pivot_distances(graph_of(branch), 0)
    found = spread._pivot_mds(steps)
    order = np.random.default_rng(3).permutation(len(steps) - 1) + 1
    order = np.concatenate([[0], order])
    again: Floats = spread._pivot_mds(steps[order])
    assert (again == found[order]).all()


PROGRAM = """
import sys
from tests.graph.test_arrangement import printed
sys.stdout.write(printed())
"""


def printed() -> str:
    """The digest of the places of two SBs, one that settles and one that is too large."""
    small = branch_of([(i, (i * 5 + 2) % 23) for i in range(23)] + [(3, 9), (0, 7)], 23)
    size = MOST_STATES + 30
    large = branch_of([(i, (i * 3 + 1) % size) for i in range(size)], size)
    places = json.dumps([arranged(small), arranged(large)])
    return hashlib.sha256(places.encode()).hexdigest()


def test_another_process_with_another_hash_order_finds_the_same_places() -> None:
    environment = {**os.environ, "PYTHONHASHSEED": "77", "OPENBLAS_CORETYPE": "Prescott"}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout == printed()
