"""Loading large files, bytes to index, against readers that do less.

Ours reads the values, looks for keys that are written twice and for targets that are no states, and
numbers states and targets. ``orjson`` and ``json`` only make the values, ``pydantic`` checks their
types, ``networkx`` is given every edge, ``pysmsl`` is the reference reader (it opens the file, and
runs once, in a process of its own, with a limit). Times are of one process; memory is of a process
for each reader: its peak less its size before, in which the bytes of the file are counted.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from benches.loaders import alone, loader
from benches.row import Row, median_ms
from smsl_studio.generate.rules import Values, hanoi_values, level_values
from smsl_studio.smsl.json_form import write_json

PEERS = ("orjson", "json", "pydantic", "networkx")
LIMIT = 600.0
"""The time (s) after which the measurement of the reference reader is given up."""


def rows() -> Iterator[Row]:
    """Hanoi with 8 and with 10 disks, and three levels of 100,352 operations."""
    with tempfile.TemporaryDirectory() as folder:
        yield from _file("Hanoi 8", hanoi_values(8), Path(folder))
        yield from _file("Hanoi 10", hanoi_values(10), Path(folder))
        yield from _file("three levels", level_values(), Path(folder))


def _file(work: str, values: Values, folder: Path) -> Iterator[Row]:
    edges = sum(
        len(found) for states in values.values() for key, found in states.items() if key != "HEADER"
    )
    file = folder / f"{work}.json"
    file.write_text(write_json(values), encoding="utf-8")
    raw = file.read_bytes()
    slow = alone(file, "pysmsl", LIMIT)
    times, sizes = {}, {}
    for name in ("ours", *PEERS):
        runs = 3 if name == "networkx" else 7
        times[name] = median_ms(partial(loader(name, str(file)), raw), runs=runs)
        found = alone(file, name, LIMIT)
        sizes[name] = found[1] / edges if found else 0.0
    if slow is not None:
        times["pysmsl"], sizes["pysmsl"] = slow[0], slow[1] / edges
    what = f"{work}, {edges:,} operations"
    yield _row(f"{what}: read, check, index", times, "ms", "at most 4x orjson")
    yield _row(f"{what}: in multiples of orjson", _multiples(times), "x")
    yield _row(f"{what}: peak memory", sizes, "bytes an edge", "at most 350")
    yield _row(f"{what}: memory in multiples of orjson", _multiples(sizes), "x")


def _row(work: str, found: dict[str, float], unit: str, bound: str = "") -> Row:
    others = tuple((name, figure) for name, figure in found.items() if name != "ours")
    return Row(work, found["ours"], unit, others, bound)


def _multiples(found: dict[str, float]) -> dict[str, float]:
    return {name: figure / found["orjson"] for name, figure in found.items()}
