"""30,000 random runs, each judged by the oracle of the tests.

A run is a blueprint of one to three levels, what is asked of it, a table world, a script, people,
disturbed sensors and faults, all drawn from one number (``tests/oracle/cases.py``). The oracle
(``tests/oracle/oracle.py``) knows only docs/running.md; it reads the readings of every sensor and
the events of the run, and names each clause that is broken. Each finding is printed with the number
of its run: ``python -m tests.oracle NUMBER`` shows it again.
"""

from __future__ import annotations

import re
import sys
import time
from collections import Counter
from collections.abc import Iterator

from benches.row import Row
from tests.oracle.judged import judged

RUNS = 30_000


def rows() -> Iterator[Row]:
    """How the runs ended, what the oracle found in them, and what one run with its judgement
    takes."""
    began = time.process_time()
    ends: Counter[str] = Counter()
    clauses: Counter[str] = Counter()
    false_goals = false_commits = hangs = findings = 0
    for number in range(RUNS):
        run = judged(number)
        ends[run.reason] += 1
        if run.findings:
            print(run, file=sys.stderr, flush=True)
        findings += len(run.findings)
        false_goals += any("goal_reached is told" in one for one in run.findings)
        false_commits += any(re.search(r"clause (7|13) .* committed", one) for one in run.findings)
        hangs += any(one.startswith("hangs") for one in run.findings)
        clauses.update({one.split(" broken")[0] for one in run.findings})
    spent = time.process_time() - began
    words = ", ".join(f"{count:,} {word}" for word, count in ends.most_common())
    named = ", ".join(f"{count} in {clause}" for clause, count in sorted(clauses.items()))
    yield Row(
        f"{RUNS:,} random runs ({words}), findings of the oracle{': ' + named if named else ''}",
        findings,
        "",
        bound="0",
    )
    yield Row("of them runs with a false goal_reached", false_goals, "", bound="0")
    yield Row("of them runs with a commit without a true check", false_commits, "", bound="0")
    yield Row("of them runs that hang", hangs, "", bound="0")
    yield Row("one run and its judgement", spent * 1000 / RUNS)
