"""Prints one case: ``python -m tests.oracle NUMBER`` (or a file with a case as JSON).

It prints what was asked, then for each tick the acts of the script, the calls and answers of the
world and the events of the run; last the findings of the oracle. Ticks in which nothing happened
are left out.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from tests.oracle.cases import case_of
from tests.oracle.oracle import judge
from tests.oracle.recorded_run import record


def lines(case: Mapping[str, Any]) -> Iterator[str]:
    """The case and its run, one line each."""
    yield json.dumps(case["blueprint"])
    yield json.dumps({key: value for key, value in case.items() if key != "blueprint"})
    told = record(case)
    for number, moment in enumerate(told):
        calls = [_call(call) for call in moment["calls"]]
        if moment["events"] or moment["said"] or any("idle" not in call for call in calls):
            yield f"--- {number - 1}: {moment['phase']} {moment['said'] or ''}"
            yield from (f"      {call}" for call in calls)
            yield from (f"    {json.dumps(event)}" for event in moment["events"])
    yield from judge(case["blueprint"], case["asked"], case.get("world", {}), told) or ["fine"]


def _call(call: list[Any]) -> str:
    if call[0] == "tick":
        samples = " ".join(f"{sample[0]}={sample[2]}" for sample in call[3])
        return f"tick {call[1]:g} {call[2]} {samples}"
    if call[0] == "sense":
        return "idle sense " + " ".join(f"{sample[0]}={sample[2]}" for sample in call[1])
    return " ".join(map(str, call))


if __name__ == "__main__":
    given = sys.argv[1]
    chosen = case_of(int(given)) if given.isdigit() else json.loads(Path(given).read_text("utf-8"))
    print("\n".join(lines(chosen)))
