"""Blueprints from rules: operations a second, beside a plain search of Python.

The limit is the step of numpy alone: all states are known already, and their operations are found
again in one call.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from typing import TypeVar

from benches.row import Row
from smsl_studio.generate.rule_file import RuleSet, read_rules
from smsl_studio.generate.rule_states import ruled_branch
from smsl_studio.generate.rule_steps import RuleSteps
from smsl_studio.generate.rules import hanoi_moves
from tests.generate.test_rule_files import hanoi_rules

Came = TypeVar("Came")
DISKS = (8, 10, 11)


def rows() -> Iterator[Row]:
    """Measure the best of three runs in CPU time, for towers of several heights."""
    for disks in DISKS:
        rules = read_rules(hanoi_rules(disks).encode(), "hanoi.toml")
        seconds, made = _timed(lambda rules=rules: ruled_branch(rules))  # type: ignore[misc]
        plain, table = _timed(lambda disks=disks: _plain_search(disks))  # type: ignore[misc]
        assert sum(map(len, table.values())) == made.operations
        others = (
            ("plain search", made.operations / plain),
            ("numpy alone", made.operations / _numpy_alone(rules)),
        )
        words = f"Hanoi {disks} from rules, {made.operations:,} operations"
        rate = made.operations / seconds
        yield Row(words, rate, "operations/s", others, "at least 500,000")


def _timed(work: Callable[[], Came], runs: int = 3) -> tuple[float, Came]:
    best = float("inf")
    for _ in range(runs):
        start = time.process_time()
        came = work()
        best = min(best, time.process_time() - start)
    return best, came


def _plain_search(disks: int) -> dict[str, dict[str, str]]:
    """The same towers without a file of rules: Python calculates the moves of each state."""
    start = ("a",) * disks
    table: dict[str, dict[str, str]] = {}
    queue, known = deque([start]), {start}
    while queue:
        facts = queue.popleft()
        own = table["State_" + "".join(facts)] = {}
        for operation, after in hanoi_moves(facts):
            own[operation] = "State_" + "".join(after)
            if after not in known:
                known.add(after)
                queue.append(after)
    return table


def _numpy_alone(rules: RuleSet) -> float:
    """Return the seconds in which the operations of all states are found again, in one call."""
    steps = RuleSteps(rules)
    known = {steps.packed(rules.start): None}
    queue = list(known)
    while queue:
        targets = {target: None for part in steps.rows(queue) for target in part.targets}
        queue = [target for target in targets if target not in known]
        known |= targets
    return _timed(lambda: list(RuleSteps(rules).rows(list(known))))[0]
