"""Inspection, layout and routes of 6,561 states and 19,680 operations (Hanoi with 8 disks), and the
inspection of 177,144 operations (10 disks)."""

from __future__ import annotations

from collections.abc import Iterator

import networkx as nx

from benches.row import Row, median_ms
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from smsl_studio.graph.routing import cheapest
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.json_form import parse_json, write_json

FAULTS = 20_000


def rows() -> Iterator[Row]:
    """Measure each call on a new blueprint, except where the index is kept."""
    text = write_json(values_of(hanoi(8)))
    document = parse_json(text, "bench.json")
    branch = read_blueprint(document)["SB1"]
    first, last = branch.initial, branch.activating

    yield Row("inspect", median_ms(lambda: inspect(read_blueprint(document)), runs=3))
    large = parse_json(write_json(values_of(hanoi(10))), "bench.json")
    words = "inspect 177,144 operations"
    figure = median_ms(lambda: inspect(read_blueprint(large)), runs=3)
    yield Row(words, figure, bound="at most 1,000 ms")
    faulty = parse_json(_faulty(), "bench.json")
    words = f"inspect a file of {FAULTS:,} doubled keys and {FAULTS:,} unknown targets"
    yield Row(words, median_ms(lambda: inspect(read_blueprint(faulty)), runs=3))
    yield Row("layout", median_ms(lambda: place_states(read_blueprint(document)["SB1"]), runs=3))
    edges = [(edge.source, edge.target) for edge in branch.edges()]
    graph: nx.MultiDiGraph[str] = nx.MultiDiGraph(edges)
    kept = median_ms(lambda: cheapest(branch, first, last))
    given = median_ms(lambda: nx.shortest_path(graph, first, last))
    words = "route, all disks over"
    yield Row(words, kept, "ms", (("networkx, graph given", given),), "at most networkx")
    fresh = median_ms(lambda: cheapest(read_blueprint(document)["SB1"], first, last))
    built = median_ms(lambda: nx.shortest_path(nx.MultiDiGraph(edges), first, last))
    yield Row(f"{words}, the first of a file", fresh, "ms", (("networkx, graph built", built),))


def _faulty() -> str:
    """Return a file in which every key is doubled and every target is misspelt."""
    doubled = (f'"s{n}": {{}}, "s{n}": {{"a": "t{n}"}}' for n in range(FAULTS))
    return f'{{"SB1": {{{", ".join(doubled)}}}}}'
