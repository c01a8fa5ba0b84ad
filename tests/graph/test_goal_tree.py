"""The goal tree finds the same routes as the searches and networkx, after any change."""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import pairwise

import networkx as nx
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import search
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph import routing
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.goal_tree import GoalTree
from tests.counts import share_of

PRICES = [0.0, 0.1, 0.1, 0.2, 0.3, 1.0, 2.5]
ENGINES = [0, 10**9]
"""From how many states on scipy spreads: always, never."""


@st.composite
def graphs(draw: st.DrawFn) -> tuple[BranchGraph, list[float], StateBranch]:
    """A random multigraph with parallel edges, self loops, dangling targets, and its costs."""
    names = [f"S{i}" for i in range(draw(st.integers(2, 7)))]
    edges = draw(
        st.dictionaries(
            st.tuples(st.sampled_from(names), st.sampled_from("pqrst")),
            st.sampled_from([*names, "Nowhere"]),
            max_size=22,
        )
    )
    table: dict[str, dict[str, str]] = {name: {} for name in names}
    for (source, operation), target in edges.items():
        table[source][operation] = target
    branch = StateBranch("SB", dict(table))
    graph = graph_of(branch)
    count = len(graph.targets)
    costs = draw(st.lists(st.sampled_from(PRICES), min_size=count, max_size=count))
    return graph, costs, branch


class Oracle:
    """The same questions, answered anew each time by the two searches that there are."""

    def __init__(self, graph: BranchGraph, branch: StateBranch, costs: list[float]) -> None:
        self.graph, self.branch, self.costs = graph, branch, list(costs)
        self.closed: set[int] = set()

    def moves(self, state: int) -> Iterator[search.Move]:
        graph = self.graph
        for edge in set(graph.edges_out(state)) - self.closed:
            name = graph.operations[edge]
            names = lambda name=name: (name,)  # noqa: E731
            yield search.Move(graph.targets[edge], self.costs[edge], 1, names, ("0", name), edge)

    def route(self, state: int, goals: set[int]) -> list[int] | None:
        found = search.cheapest(state, lambda one: one in goals, self.moves)
        return None if found is None else [move.what for move in found]

    def routed(self, state: int, goal: int) -> list[str] | None:
        graph = self.graph
        by = {
            (graph.names[s], o): c
            for s, o, c in zip(graph.sources, graph.operations, self.costs, strict=True)
        }
        avoid = [
            Address(graph.branch, graph.names[graph.sources[e]], graph.operations[e])
            for e in self.closed
        ]
        found = routing.cheapest(
            self.branch,
            graph.names[state],
            graph.names[goal],
            avoid=avoid,
            cost=lambda s, o: by.get((s, o), 0.0),
        )
        return None if found is None else [address.operation for address in found.operations]

    def lengths(self, goals: set[int]) -> dict[int, float]:
        oracle: nx.MultiDiGraph[int] = nx.MultiDiGraph()
        oracle.add_nodes_from(range(len(self.graph)))
        ends = zip(self.graph.sources, self.graph.targets, strict=True)
        for edge, (source, target) in enumerate(ends):
            if edge not in self.closed:
                oracle.add_edge(target, source, weight=self.costs[edge])
        return dict(nx.multi_source_dijkstra_path_length(oracle, goals))

    def agrees(self, tree: GoalTree, goals: set[int], state: int) -> None:
        expected = self.route(state, goals)
        assert tree.route(state) == expected
        assert tree.next(state) == (expected[0] if expected else None)
        cost = self.lengths(goals).get(state)
        assert tree.cost(state) == (None if cost is None else pytest.approx(cost))
        if len(goals) == 1:
            names = self.routed(state, *goals)
            wanted = [self.graph.operations[edge] for edge in expected or ()]
            assert names == (None if expected is None else wanted)


@settings(max_examples=share_of(50))
@given(graphs(), st.sampled_from(ENGINES), st.data())
def test_every_way_is_the_one_that_the_searches_find(
    drawn: tuple[BranchGraph, list[float], StateBranch], large: int, data: st.DataObject
) -> None:
    graph, costs, branch = drawn
    goals = data.draw(st.sets(st.sampled_from(range(len(graph))), min_size=1, max_size=2))
    tree, oracle = GoalTree(graph, goals, costs, large=large), Oracle(graph, branch, costs)
    for state in range(len(graph)):
        oracle.agrees(tree, goals, state)


@settings(max_examples=share_of(100))
@given(graphs(), st.sampled_from(ENGINES), st.data())
def test_after_any_changes_the_ways_are_those_of_a_new_tree(
    drawn: tuple[BranchGraph, list[float], StateBranch], large: int, data: st.DataObject
) -> None:
    graph, costs, branch = drawn
    goals = data.draw(st.sets(st.sampled_from(range(len(graph))), min_size=1, max_size=2))
    tree, oracle = GoalTree(graph, goals, costs, large=large), Oracle(graph, branch, costs)
    edges, states = range(len(graph.targets)), range(len(graph))
    for _ in range(data.draw(st.integers(1, 8)) if edges else 0):
        edge = data.draw(st.sampled_from(edges))
        match data.draw(st.sampled_from(["close", "close", "open", "reprice", "ask"])):
            case "close":
                tree.close(edge)
                oracle.closed.add(edge)
            case "open":
                tree.open(edge)
                oracle.closed.discard(edge)
            case "reprice":
                oracle.costs[edge] = data.draw(st.sampled_from(PRICES))
                tree.reprice({edge: oracle.costs[edge]})
            case _:
                oracle.agrees(tree, goals, data.draw(st.sampled_from(states)))
    for state in data.draw(st.permutations(states)):
        oracle.agrees(tree, goals, state)


@pytest.mark.parametrize("seed", range(share_of(30)))
def test_ties_among_repaired_ways_go_by_name(seed: int) -> None:
    """Layers of states, each joined with most of the next, at equal costs: nothing but ties."""
    dice = random.Random(seed)
    layers = [[f"S{i}{j}" for j in range(3)] for i in range(6)]
    table: dict[str, dict[str, str]] = {}
    for here, onward in pairwise([*layers, ["End"]]):
        for state in here:
            names = dice.sample("pqrstuv", 4)
            table[state] = {name: dice.choice(onward) for name in names}
    branch = StateBranch("SB", {**table, "End": {}})
    graph = graph_of(branch)
    goal, costs = graph.number("End"), [1.0] * len(graph.targets)
    tree, oracle = GoalTree(graph, [goal]), Oracle(graph, branch, costs)
    start = graph.number("S00")
    for _ in range(12):
        way = tree.route(start)
        if way is None:
            break
        failed = dice.choice(way)
        tree.close(failed)
        oracle.closed.add(failed)
        oracle.agrees(tree, {goal}, graph.sources[failed])
        oracle.agrees(tree, {goal}, start)


@pytest.mark.parametrize("large", ENGINES)
def test_a_failed_operation_is_repaired_wherever_the_run_stands(large: int) -> None:
    branch = hanoi(6)["SB1"]
    graph = graph_of(branch)
    goal = graph.number("State_cccccc")
    costs = [1.0] * len(graph.targets)
    tree, oracle = GoalTree(graph, [goal], large=large), Oracle(graph, branch, costs)
    way = tree.route(graph.number("State_aaaaaa"))
    assert way is not None
    assert len(way) == 63
    for edge in way[::7]:
        tree.close(edge)
        oracle.closed.add(edge)
        oracle.agrees(tree, {goal}, graph.sources[edge])
    oracle.agrees(tree, {goal}, graph.number("State_aaaaaa"))
    tree.close(way[31])
    oracle.closed.add(way[31])
    oracle.agrees(tree, {goal}, graph.sources[way[30]])
    for edge in sorted(oracle.closed):
        tree.open(edge)
    assert tree.route(graph.number("State_aaaaaa")) == way


def test_decimal_costs_tie_exactly() -> None:
    branch = StateBranch("SB", {"A": {"y": "M", "x": "B"}, "M": {"y": "B"}, "B": {}})
    tree = GoalTree(graph_of(branch), [2], [0.1, 0.3, 0.2])
    assert tree.route(0) == [1]
    assert tree.cost(0) == 0.3


def test_costs_beyond_what_scipy_counts_are_counted_all_the_same() -> None:
    branch = StateBranch("SB", {"A": {"y": "M", "x": "B"}, "M": {"y": "B"}, "B": {}})
    tree = GoalTree(graph_of(branch), [2], [1e12, 1e12 + 0.25, 0.125], large=0)
    assert tree.route(0) == [0, 2]
    tree.reprice({2: 0.5})
    assert tree.route(0) == [1]
