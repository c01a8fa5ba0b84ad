"""Findings of an unfinished drawing: what only says "not yet" is no mistake while one draws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.studio.base.words import tally

NOT_YET = frozenset({"R10", "R11", "R12"})
"""The rules that every drawing breaks until it is finished: a state that cannot be reached, a trap,
a dead end."""


def to_finish(finding: Finding) -> bool:
    """Whether a finding is shown as something that is still missing, and not as a mistake."""
    return finding.rule in NOT_YET and finding.severity is Severity.NOTE


def quiet(findings: Sequence[Finding]) -> tuple[Finding, ...]:
    """The findings for an unfinished drawing.

    What is missing is a note. It has no fix, because its fix deletes what was just drawn.
    """
    return tuple(
        replace(one, severity=Severity.NOTE, fix=None) if one.rule in NOT_YET else one
        for one in findings
    )


def sum_of(findings: Sequence[Finding]) -> str:
    """The numbers of findings, such as ``1 error, 2 to finish``; empty if there are none."""
    missing = sum(map(to_finish, findings))
    mistakes = tally(one for one in findings if not to_finish(one))
    return ", ".join(filter(None, (mistakes, f"{missing} to finish" if missing else "")))
