"""A file in which operations lead from each state to each other, all with long names."""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import permutations
from pathlib import Path


def crowded_file(folder: Path, states: Sequence[str]) -> Path:
    """A file with so many operations that their names have no room: two for each pair of states."""
    table: dict[str, dict[str, str]] = {state: {} for state in states}
    for number, (a, b) in enumerate(permutations(states, 2)):
        table[a][f"Op_MoveTheInstrument{number}"] = b
        table[a][f"Op_PlanTheWholeWay{number}"] = b
    path = folder / "crowded.json"
    path.write_text(json.dumps({"SB": table}), encoding="utf-8")
    return path
