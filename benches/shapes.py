"""Random changes of shape, judged by plain steps and a plain bisimulation of the tests.

2,000 random sets of states are cut out and put back (``tests/generate/cut_cases.py``), 2,000 random
hierarchies are made flat, and 5,000 pairs of blueprints are compared: equal by other names of
states, by flatten, with other costs, with an operation less or another target. Without ``--all`` it
runs a tenth. A finding is printed with its number. ``--seeds=A:B`` judges a part, such as 0:500:
the cuts, hierarchies and pairs with these numbers.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from time import process_time

from benches.row import Row
from benches.seeds import chosen
from tests.generate.cut_cases import cut_case
from tests.generate.judged_cut import judged_cut
from tests.inspection.equivalence.pairs import judged_flat, judged_pair

CUTS, FLAT, PAIRS = 2_000, 2_000, 5_000


def rows() -> Iterator[Row]:
    """Judge a tenth."""
    return _rows(10)


def all_rows() -> Iterator[Row]:
    """Judge all, some minutes."""
    return _rows(1)


def _cut(number: int) -> tuple[str, str]:
    case = cut_case(number)
    return judged_cut(case) if case is not None else ("no start", "")


def _rows(share: int) -> Iterator[Row]:
    kinds: list[tuple[str, int, Callable[[int], tuple[str, str]]]] = [
        ("sets of states to cut out", CUTS, _cut),
        ("hierarchies made flat", FLAT, judged_flat),
        ("pairs compared", PAIRS, judged_pair),
    ]
    for words, count, judge in kinds:
        ends: Counter[str] = Counter()
        findings, begin, done = 0, process_time(), 0
        for number in chosen(words, 0, count // share):
            done += 1
            end, wrong = judge(number)
            ends[end] += 1
            if wrong:
                findings += 1
                print(f"{words}, {number}: {wrong}", file=sys.stderr)
        spent = process_time() - begin
        told = ", ".join(f"{times:,} {end}" for end, times in ends.most_common())
        yield Row(f"{done:,} {words} ({told}): findings", findings, "", bound="0")
        yield Row(f"{words}: one with its judgement", spent / done * 1000)
