"""Tidy of large drawings: the work that is done beside the window, until its step can be made.

The states have a way to each from an earlier one and as many ways more, drawn by a seed. They were
strewn, so nothing of the former drawing is kept.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial

from benches.row import Row, median_ms
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.arrangement import BEST, DISTANCE, LAYERS
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.features.draw.canvas.tidy_work import TidyWork
from tests.graph.printed_layouts import random_graph

SIZES, SEED = (729, 6_561), 3
KINDS = {BEST: "", LAYERS: ", in columns", DISTANCE: ", by distances"}


def rows() -> Iterator[Row]:
    """Measure the rows of this bench."""
    for size in SIZES:
        text = json.dumps({"SB": dict(random_graph(size, SEED).table)})
        for kind, words in KINDS.items():
            # A blueprint keeps the layout that was found, so each run reads its own.
            blueprints = iter([read_blueprint(parse_json(text, "x.json")) for _ in range(6)])
            spent = median_ms(partial(_tidied, blueprints, kind), runs=5)
            yield Row(f"tidy {size:,} states{words}", spent, bound="at most 2,000 ms")


def _tidied(blueprints: Iterator[Blueprint], kind: str) -> None:
    blueprint = next(blueprints)
    strewn = {name: (7.0 * at % 900, 3.0 * at) for at, name in enumerate(blueprint["SB"].table)}
    TidyWork(blueprint, "SB", strewn, None, kind).do()
