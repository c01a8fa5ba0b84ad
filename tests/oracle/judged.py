"""Runs one case and judges it, for the tests and the bench."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from tests.oracle.cases import case_of
from tests.oracle.oracle import judge
from tests.oracle.recorded_run import record


@dataclass(frozen=True)
class Judged:
    """How a run ended, in the word of ``run_finished``, and what the oracle has found in it."""

    number: int
    reason: str
    findings: tuple[str, ...]

    def __str__(self) -> str:
        return "\n  ".join([f"python -m tests.oracle {self.number}", *self.findings])


def judged(number: int) -> Judged:
    """The case of this number, run and judged."""
    return judged_case(case_of(number))


def judged_case(case: Mapping[str, Any]) -> Judged:
    """A case, run and judged."""
    told = record(case)
    found = judge(case["blueprint"], case["asked"], case.get("world", {}), told)
    last = told[-1]["events"][-1] if told[-1]["events"] else {}
    return Judged(case.get("number", -1), last.get("reason", "hangs"), tuple(found))
