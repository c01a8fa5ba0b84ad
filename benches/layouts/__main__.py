"""Print the measures of each graph: ``python -m benches.layouts [--write] [NAME]``.

``--write`` puts the table into docs/layouts.md. A name takes only the graphs that have it in
theirs.
"""

from __future__ import annotations

import sys
from pathlib import Path

from benches.layouts import Compared, compared

PAGE = Path(__file__).parents[2] / "docs" / "layouts.md"
COLUMNS = (
    "graph", "states, operations", "side", "crossings", "label faults",
    "label on label, on node, hidden", "lines through nodes", "quarter turns", "length", "area",
    "s",
)  # fmt: skip
HEAD = f"| {' | '.join(COLUMNS)} |\n{'|---' * len(COLUMNS)}|"
WORDS = """# Layouts, measured

Made by `python -m benches.layouts --write`. All sides draw the same operations between nodes of the
same sizes, and each label has its own size. A label that is not shown counts as a fault. Less is
better in every column. Length is in thousands of pixels, area in millions. *elk* is the layered
layout of ELK with right angles. *former* is our layout before it had columns and settling; its rows
stay from the run that made them, because that code is gone. Seconds are CPU time for ours, and wall
time with the start of the program for the others.
"""


def lines(one: Compared) -> list[str]:
    """Return the rows of a graph, one for each side."""
    found = []
    for side, (m, spent) in one.sides.items():
        cells = (
            one.name,
            f"{one.states}, {one.operations}",
            side,
            f"{m.crossings:,}",
            f"{m.overlaps:,}",
            f"{m.label_on_label:,}, {m.label_on_node:,}, {m.hidden:,}",
            f"{m.edge_through_node:,}",
            f"{m.bends:,.0f}",
            f"{m.length / 1e3:,.1f}",
            f"{m.area / 1e6:,.2f}",
            f"{spent:.2f}",
        )
        found.append(f"| {' | '.join(cells)} |")
    return found


def _former_rows(page: str) -> dict[str, list[str]]:
    """Return the rows of our former layout in the page, by graph."""
    found: dict[str, list[str]] = {}
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) > 3 and cells[3] == "former":
            found.setdefault(cells[1], []).append(line)
    return found


def _told(found: list[Compared]) -> list[str]:
    """Return the sentences about all graphs that both sides drew."""
    told = []
    for side in ("dot", "elk"):
        both = [one for one in found if side in one.sides]
        if not both:
            continue
        better = sum(one.wins(side) for one in both)
        words = (
            f"Ours has no more crossings and label faults than {side} in {better} of {len(both)}"
        )
        sums = []
        for figure, what in (("crossings", "crossings"), ("overlaps", "label faults")):
            ours, other = (
                sum(getattr(one.sides[name][0], figure) for one in both) for name in ("ours", side)
            )
            sums.append(f"{what} in all {ours:,} and {other:,}")
        told.append(f"{words}: {', '.join(sums)}.")
    through = sum(one.sides["ours"][0].edge_through_node for one in found)
    told.append(f"Lines of ours through nodes: {through}.")
    return told


def main(arguments: list[str]) -> int:
    """Measure and print, and write the page if asked."""
    former = _former_rows(PAGE.read_text(encoding="utf-8"))
    wanted = [name for name in arguments if not name.startswith("-")]
    table = [HEAD]
    found = []
    print(HEAD, flush=True)
    for one in compared(*wanted[:1]):
        table += [*lines(one), *former.get(one.name, ())]
        found.append(one)
        print(*lines(one), sep="\n", flush=True)
    told = "\n".join(_told(found))
    print(told)
    if "--write" in arguments:
        PAGE.write_text("\n".join([WORDS, told, "", *table, ""]), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
