"""1,500 random runs, a twentieth of the bench ``oracle``: the oracle finds nothing in any."""

from __future__ import annotations

import pytest

from tests.oracle.judged import judged

SHARE = 50
FOUND = (
    4336,
    5619,
    6803,
    7654,
    10905,
    10930,
    13570,
    14176,
    18772,
    19400,
    19646,
    19667,
    23328,
    29998,
)
"""Later runs of the bench in which the dispatcher or the oracle was wrong once."""


@pytest.mark.parametrize("first", range(0, 1500, SHARE))
def test_the_oracle_finds_nothing(first: int) -> None:
    found = [run for number in range(first, first + SHARE) if (run := judged(number)).findings]
    assert not found, "\n".join(map(str, found))


@pytest.mark.parametrize("number", FOUND)
def test_what_the_bench_has_found_is_right_now(number: int) -> None:
    assert not (run := judged(number)).findings, str(run)
