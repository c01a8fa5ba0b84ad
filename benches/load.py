"""Loading 59,049 states and 177,144 operations: text to Blueprint, against what parses less."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial

import networkx as nx
import orjson

from benches.row import Row, median_ms
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.build import graph_of
from smsl_studio.smsl.json_form import parse_json, write_json


def rows() -> Iterator[Row]:
    """Hanoi with 8 and with 10 disks."""
    for disks in (8, 10):
        text = write_json(values_of(hanoi(disks)))
        raw = text.encode()

        def ours(text: str = text) -> object:
            return read_blueprint(parse_json(text, "bench.json"))

        def with_arrays(text: str = text) -> object:
            return [graph_of(branch) for branch in read_blueprint(parse_json(text, "bench.json"))]

        def into_networkx(raw: bytes = raw) -> object:
            graph: nx.MultiDiGraph[str] = nx.MultiDiGraph()
            for states in orjson.loads(raw).values():
                for source, operations in states.items():
                    for name, target in operations.items():
                        graph.add_edge(source, target, key=name)
            return graph

        others = (
            ("orjson.loads", median_ms(partial(orjson.loads, raw))),
            ("json.loads", median_ms(partial(json.loads, text))),
            ("networkx", median_ms(into_networkx, runs=3)),
        )
        yield Row(f"read Hanoi {disks}", median_ms(ours), "ms", others)
        yield Row(f"read Hanoi {disks}, integer arrays", median_ms(with_arrays), "ms", others)
