"""The ways to load a file that `load` compares, and what one of them costs in a process of its own.

``python -m benches.loaders FILE NAME`` loads the file once and prints the seconds of CPU it took
and the bytes its process needed for it at the peak: the highest resident size, less the size just
before, when everything was imported and the bytes of the file were in memory.
"""

from __future__ import annotations

import gc
import json
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import networkx as nx
import orjson

from smsl_studio.blueprint.numbers import numbers_of
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.build import graph_of
from smsl_studio.smsl.files import parse_bytes

SMALL = b'{"SB": {"HEADER": {}, "S": {"o": "S"}}}'


def ours(raw: bytes) -> object:
    """Values, keys written twice, targets that are no states, and the integer index."""
    document = parse_bytes(raw, "bench.json")
    blueprint = read_blueprint(document)
    dangling = [numbers_of(branch).dangles for branch in blueprint]
    return blueprint, document.duplicates(), dangling, [graph_of(branch) for branch in blueprint]


def into_networkx(raw: bytes) -> object:
    """One graph of the states of all SBs."""
    graph: nx.MultiDiGraph[tuple[str, str]] = nx.MultiDiGraph()
    for branch, states in orjson.loads(raw).items():
        for source, operations in states.items():
            if source != "HEADER":
                for name, target in operations.items():
                    graph.add_edge((branch, source), (branch, target), key=name)
    return graph


def with_pydantic() -> Callable[[bytes], object]:
    """Check only the types of the maps. A header may contain the map of sub-SBs."""
    from pydantic import TypeAdapter

    adapter: TypeAdapter[Any] = TypeAdapter(dict[str, dict[str, dict[str, str | dict[str, int]]]])
    return adapter.validate_json


def with_pysmsl(file: str) -> Callable[[bytes], object]:
    """The reference reader; it opens the file itself."""
    from smsl import smslStateMachine

    return lambda raw: smslStateMachine(file)


def loader(name: str, file: str) -> Callable[[bytes], object]:
    """Return the way to load with this name, with its imports done."""
    if name == "pydantic":
        return with_pydantic()
    if name == "pysmsl":
        return with_pysmsl(file)
    return {
        "ours": ours,
        "orjson": orjson.loads,
        "json": json.loads,
        "networkx": into_networkx,
    }[name]


def alone(file: Path, name: str, limit: float) -> tuple[float, float] | None:
    """Return milliseconds and the peak in bytes, measured in a process of its own. None if it takes
    longer than the limit (s)."""
    command = [sys.executable, "-m", "benches.loaders", str(file), name]
    try:
        told = subprocess.run(command, check=True, capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    found = json.loads(told.stdout)
    return found["seconds"] * 1000, found["bytes"]


def _bytes(field: str) -> int:
    """What Linux says of this process: VmRSS now, VmHWM at most (unlike ``getrusage``, whose peak
    is inherited from the parent).
    """
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return next(int(line.split()[1]) for line in status.splitlines() if field in line) * 1024


def main(file: str, name: str) -> None:
    """Load once, and print the cost."""
    load = loader(name, file)
    if name != "pysmsl":
        load(SMALL)
    raw = Path(file).read_bytes()
    gc.collect()
    before, start = _bytes("VmRSS"), time.process_time()
    kept = load(raw)
    seconds = time.process_time() - start
    print(json.dumps({"seconds": seconds, "bytes": _bytes("VmHWM") - before}))
    del kept


if __name__ == "__main__":
    main(*sys.argv[1:])
