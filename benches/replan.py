"""Routes to the goal in an SB of 59,049 states and 177,144 operations (Hanoi, 10 disks).

scipy and networkx answer the same question over the same edges: the distance of every state from
the goal, by one Dijkstra over the reversed graph. Ours also counts operations and breaks ties by
names, so it does the work of scipy and more. After a failure, the time to close the edge and find
the next route is measured: at every 3rd operation of the route of 1,023, one after the other, the
median and the worst tenth. scipy and networkx have no repair: they start anew.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Iterator
from typing import Any

import networkx as nx
import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from benches.row import Row, median_ms
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.dispatch.route.course import Course
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.goal_tree import GoalTree
from smsl_studio.host.protocol import Bound

DISKS = 10
START, GOAL = "State_" + "a" * DISKS, "State_" + "c" * DISKS


def rows() -> Iterator[Row]:
    """Measure a first plan, a new plan, one step, and the cost of a failure."""
    blueprint = hanoi(DISKS)
    graph = graph_of(blueprint["SB1"])
    start, goal = graph.number(START), graph.number(GOAL)
    tree = GoalTree(graph, [goal])
    way = tree.route(start) or []
    scipys, networkxs = _scipy(graph, goal), _networkx(graph, goal)
    size = f"{len(graph):,} states"
    peers = (("scipy, reverse Dijkstra", scipys), ("networkx", networkxs))
    promise = "within 2x of scipy"
    yield Row(f"all ways to a goal, {size}", _anew(tree, way, start), "ms", peers, promise)
    yield Row(f"the next operation, {size}", _next(tree, graph, way), "us", (), "below 1 us")
    times = sorted(_failures(tree, graph, way))
    peers = (("scipy", scipys * 1000), ("networkx", networkxs * 1000))
    middle, worst = statistics.median(times), times[len(times) * 9 // 10]
    promise = "100x quicker than scipy"
    yield Row(f"the current operation failed, {size}: next one", middle, "us", peers, promise)
    yield Row("the same, the worst tenth", worst, "us", peers)
    yield Row("the same in a run, the route of 1,024 told", _in_a_run(), "ms", peers_ms(peers))


def peers_ms(peers: tuple[tuple[str, float], ...]) -> tuple[tuple[str, float], ...]:
    return tuple((name, us / 1000) for name, us in peers)


def _anew(tree: GoalTree, way: list[int], start: int) -> float:
    """A move of the largest disk is restored, and the first operation asked for."""
    middle = way[len(way) // 2]

    def work() -> object:
        tree.open(middle)
        return tree.next(start)

    times = []
    for _ in range(21):
        tree.close(middle)
        tree.next(start)
        times.append(median_ms(work, runs=1, warmup=0))
    return statistics.median(times)


def _next(tree: GoalTree, graph: BranchGraph, way: list[int]) -> float:
    states = [graph.sources[edge] for edge in way]
    ask = tree.next
    tree.route(states[0])

    def work() -> object:
        for state in states:
            ask(state)
        return None

    return median_ms(work) * 1000 / len(states)


def _failures(tree: GoalTree, graph: BranchGraph, way: list[int]) -> Iterator[float]:
    """Return the microseconds of each failure. The edge is restored after it."""
    for edge in way[::3]:
        tree.route(graph.sources[way[0]])
        state = graph.sources[edge]
        begin = time.perf_counter()
        tree.close(edge)
        tree.next(state)
        yield (time.perf_counter() - begin) * 1e6
        tree.open(edge)


def _in_a_run() -> float:
    """The course of a run tags the first operation risky and gives the next, with its whole leg."""
    blueprint = hanoi(DISKS)
    function = Bound("bench", False, "hold", 1.0)
    bound = {edge.address: function for edge in blueprint["SB1"].edges()}
    course = Course(Hierarchy(blueprint), [Address("SB1", GOAL)], bound, {})
    here = {"SB1": START}
    failed = next(edge.address for edge in blueprint["SB1"].edges() if edge.source == START)
    course.next_step(here)

    def work() -> object:
        course.tag_risky(failed, "it failed")
        found = course.next_step(here)
        course.restore(failed)
        return found

    return median_ms(work)


def _scipy(graph: BranchGraph, goal: int) -> float:
    sources, targets = np.asarray(graph.sources), np.asarray(graph.targets)
    ones = np.ones(len(sources))
    reverse: Any = csr_array((ones, (targets, sources)), shape=(len(graph), len(graph)))
    solve: Any = dijkstra
    return median_ms(lambda: solve(reverse, indices=goal, return_predecessors=True), runs=21)


def _networkx(graph: BranchGraph, goal: int) -> float:
    reverse: nx.DiGraph[int] = nx.DiGraph()
    reverse.add_edges_from(zip(graph.targets, graph.sources, strict=True), weight=1.0)
    return median_ms(lambda: nx.dijkstra_predecessor_and_distance(reverse, goal), runs=3)
