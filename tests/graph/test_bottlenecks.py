"""Bottlenecks against a plain oracle, which takes each state and each operation away."""

from __future__ import annotations

from random import Random

import pytest

from smsl_studio.graph.bottlenecks import bottlenecks
from tests.counts import share_of
from tests.inspection.intact import read

Table = dict[str, dict[str, str]]


def drawn_table(seed: int) -> Table:
    drawn = Random(seed)
    count = drawn.randrange(2, 9)
    names = [f"s{number}" for number in range(count)]
    table: Table = {name: {} for name in names}
    for number in range(drawn.randrange(1, 2 * count + 2)):
        table[drawn.choice(names)][f"o{number}"] = drawn.choice([*names, "nowhere"])
    return table


def leads(table: Table, start: str, goal: str) -> bool:
    seen, waiting = {start}, [start]
    for state in waiting:
        for target in table.get(state, {}).values():
            if target in table and target not in seen:
                seen.add(target)
                waiting.append(target)
    return start in table and goal in seen


def without(table: Table, state: str, operation: str = "") -> Table:
    if not operation:
        return {name: out for name, out in table.items() if name != state}
    kept = {name: target for name, target in table[state].items() if name != operation}
    return {**table, state: kept}


@pytest.mark.parametrize("seed", range(share_of(300)))
def test_bottlenecks_are_what_cannot_be_taken_away(seed: int) -> None:
    table = drawn_table(seed)
    start, goal = "s0", list(table)[-1]
    drawn = Random(-seed)
    shut = {name for name in table if name not in (start, goal) and drawn.random() < 0.15}
    found = bottlenecks(read({"SB": table})["SB"], start, goal, shut)
    open_table = {name: out for name, out in table.items() if name not in shut}
    if not leads(open_table, start, goal):
        assert (found.states, found.edges, found.length) == ((), (), 0)
        return
    states = [s for s in open_table if s not in (start, goal)]
    assert set(found.states) == {
        s for s in states if not leads(without(open_table, s), start, goal)
    }
    assert set(found.edges) == {
        (s, o)
        for s, out in open_table.items()
        for o in out
        if not leads(without(open_table, s, o), start, goal)
    }
    assert len(found.states) == len(set(found.states))
