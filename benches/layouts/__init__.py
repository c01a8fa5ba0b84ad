"""The layouts of 60 graphs, ours, Graphviz ``dot`` and ELK layered, measured in the same way.

All sides draw the same operations between nodes of the same sizes, each with its label in its own
size. A label that is not shown counts as one that overlaps. ``python -m benches.layouts`` prints a
row for each graph, and ``--write`` puts them into docs/layouts.md. A side that is not installed is
left out, and the bench says so.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass

from benches.layouts import dot, elk
from benches.layouts.graphs import graphs
from benches.row import Row
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.figure import LABEL, Figure
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.words import width
from tests.picture.measured import Measures, drawing_of, measure


@dataclass(frozen=True)
class Compared:
    """One graph: its size, and for each side its measures and the CPU seconds it took."""

    name: str
    states: int
    operations: int
    sides: dict[str, tuple[Measures, float]]

    def wins(self, side: str = "dot") -> bool:
        """Whether ours has no more crossings and no more faults of labels than a side."""
        ours, other = self.sides["ours"][0], self.sides[side][0]
        return ours.crossings <= other.crossings and ours.overlaps <= other.overlaps


def compared(wanted: str = "") -> Iterator[Compared]:
    """Yield the graphs whose name has ``wanted`` in it, each as soon as it is measured."""
    others = {
        name: draw
        for name, here, draw in (
            ("dot", dot.is_here, dot.drawn_by_dot),
            ("elk", elk.is_here, elk.drawn_by_elk),
        )
        if here()
    }
    missing = {"dot", "elk"} - others.keys()
    if missing:
        words = " and ".join(sorted(missing))
        print(f"not installed, so not measured: {words}", file=sys.stderr, flush=True)
    for name, blueprint, branch in graphs():
        if wanted not in name:
            continue
        start = time.process_time()
        picture = Picture(blueprint, branch)
        figure = Figure(picture, place_states(blueprint[branch]))
        drawing = drawing_of(figure)
        sides = {"ours": (measure(drawing), time.process_time() - start)}
        edges = range(len(picture.operations))
        sizes = [(width(figure.label(e), LABEL) + 8.0, 15.0) for e in edges]
        for side, draw in others.items():
            start = time.perf_counter()
            found = draw(figure, sizes)
            if found is not None:
                sides[side] = measure(found), time.perf_counter() - start
        yield Compared(name, len(picture), len(picture.operations), sides)


def rows() -> Iterator[Row]:
    """Measure the rows of this bench."""
    found = list(compared())
    through = sum(one.sides["ours"][0].edge_through_node for one in found)
    yield Row("lines through nodes, 60 graphs", through, "lines", bound="0")
    pairs = [one for one in found if "dot" in one.sides]
    if not pairs:
        return
    better = sum(map(Compared.wins, pairs))
    work = f"no more crossings and label faults than dot, of {len(pairs)}"
    yield Row(work, better, "graphs", bound="at least 50")
    for words, figure in (("crossings", "crossings"), ("label faults", "overlaps")):
        ours, other = (
            sum(getattr(one.sides[side][0], figure) for one in pairs) for side in ("ours", "dot")
        )
        yield Row(f"{words} in all", ours, words, others=(("dot", other),))
