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
better in every column. Length is in thousands of pixels, area in millions.
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


def main(arguments: list[str]) -> int:
    """Measure and print, and write the page if asked."""
    wanted = [name for name in arguments if not name.startswith("-")]
    table = [HEAD]
    better = both = 0
    print(HEAD, flush=True)
    for one in compared(*wanted[:1]):
        table += lines(one)
        print(*lines(one), sep="\n", flush=True)
        if "dot" in one.sides:
            both, better = both + 1, better + one.wins()
    told = f"Ours has no more crossings and no more label faults than dot in {better} of {both}."
    print(told)
    if "--write" in arguments:
        PAGE.write_text("\n".join([WORDS, told, "", *table, ""]), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
