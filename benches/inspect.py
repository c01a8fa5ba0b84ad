"""Inspection, layout and routes of 6,561 states and 19,680 operations (Hanoi with 8 disks), and the
inspection of 177,144 operations (10 disks).

After an edit of the smaller one, all rules with three and with ten properties are measured; nothing
is kept from before the edit but what the edit itself keeps.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice
from typing import Any

import networkx as nx

from benches.row import Row, median_ms
from smsl_studio.blueprint.editing import retarget
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.front.proof import prove
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from smsl_studio.graph.routing import cheapest
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form import parse_json, write_json

FAULTS = 20_000


def rows() -> Iterator[Row]:
    """Measure each call on a new blueprint, except where the index is kept."""
    text = write_json(values_of(hanoi(8)))
    document = parse_json(text, "bench.json")
    branch = read_blueprint(document)["SB1"]
    first, last = branch.initial, branch.activating

    yield Row("inspect", median_ms(lambda: inspect(read_blueprint(document)), runs=3))
    yield from _edited(document)
    large = parse_json(write_json(values_of(hanoi(10))), "bench.json")
    words = "inspect 177,144 operations"
    figure = median_ms(lambda: inspect(read_blueprint(large)), runs=3)
    yield Row(words, figure, bound="at most 1,000 ms")
    asked = parse_json(write_json(_asked(large)), "bench.json")
    words = "all rules and 3 properties of 177,144 operations"
    figure = median_ms(lambda: _with_properties(read_blueprint(asked)), runs=3)
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


def _edited(document: Document) -> Iterator[Row]:
    """All rules, and all rules with properties, after one of some operations got another target."""
    works: tuple[tuple[str, Callable[[Blueprint], object], bool], ...] = (
        ("all rules", inspect, False),
        ("all rules and 3 properties", _with_properties, False),
        ("all rules and 10 properties", _with_properties, True),
    )
    for number, (words, work, every) in enumerate(works):
        text = write_json(_asked(document, every))
        drawn = read_blueprint(parse_json(text, "bench.json"))
        inspect(drawn)
        prove(drawn)
        (first,) = drawn
        edges = islice(first.edges(), 100 + 4 * number, 104 + 4 * number)
        edited = [retarget(drawn, edge.address, first.initial) for edge in edges]
        figure = median_ms(partial(next, map(work, edited)), runs=3)
        yield Row(f"{words} after an edit, 6,561 states", figure, bound="at most 100 ms")


def _asked(document: Document, every: bool = False) -> dict[str, Any]:
    """The values of a file of one SB, with three properties, or with ten of all kinds."""
    ((name, first),) = read_blueprint(document).branches.items()
    asked = [
        {"name": "goal", "reachable": f"{name} in {first.activating}"},
        {"name": "home", "way_back": {"from": f"{name} in {first.activating}",
                                      "to": f"{name} in {first.initial}"}},
        {"name": "apart", "never": f"{name}/0 = a and {name}/1 = b and {name}/2 = c"},
    ]  # fmt: skip
    if every:
        asked += [
            {"name": "soon", "way_back": {"from": f"{name}/0 = b", "within": 300,
                                          "to": f"{name} in {first.initial}"}},
            {"name": "never two", "never": f"{name}/7 = c and {name}/6 = b and {name}/0 = b"},
            {"name": "never both", "never": f"{name}/3 = c and not {name}/3 = c"},
            {"name": "before", "before": [f"{name}/0 = b", f"{name}/7 = c"]},
            {"name": "after", "after": [f"{name}/6 = b", f"{name}/7 = c"]},
            {"name": "at most", "at_most": {"operation": "Op_1*", "times": 200}},
            {"name": "cost", "cost": {"goal": f"{name}/{first.activating}", "limit": 255}},
        ]  # fmt: skip
    return {"_properties": asked, **document.values}


def _with_properties(blueprint: Blueprint) -> None:
    inspect(blueprint)
    prove(blueprint)


def _faulty() -> str:
    """Return a file in which every key is doubled and every target is misspelt."""
    doubled = (f'"s{n}": {{}}, "s{n}": {{"a": "t{n}"}}' for n in range(FAULTS))
    return f'{{"SB1": {{{", ".join(doubled)}}}}}'
