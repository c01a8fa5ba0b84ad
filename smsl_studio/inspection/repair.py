"""Repair: quick fixes that are made for the blueprint as it is when they are applied."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused, StudioError
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Finding, Severity

CERTAIN = ("R03", "R15")
"""The rules with errors whose fix is certain."""

MOST = 50
"""So many fixes are made at once; after each one the rules are looked at anew."""


class Repair(NamedTuple):
    """The result of several fixes: their findings, in order, and the blueprint after the last."""

    mended: tuple[Finding, ...]
    blueprint: Blueprint


def certain_errors(findings: Iterable[Finding]) -> list[Finding]:
    """The errors that a fix mends which is certain (see ``Fix``)."""
    return [
        one
        for one in findings
        if one.severity is Severity.ERROR and one.fix is not None and one.fix.certain
    ]


def mend_errors(blueprint: Blueprint, told: Callable[[int], object] = lambda _: None) -> Repair:
    """Mend the errors whose fix is certain, one after the other, ``MOST`` at most.

    Each fix is that of the blueprint which the last one left. One that is refused is left out.
    After each one ``told`` gets their number so far.
    """
    mended: list[Finding] = []
    seen: set[tuple[str, str, str]] = set()
    while len(mended) < MOST:
        errors = certain_errors(inspect(blueprint, CERTAIN))
        finding = next((one for one in errors if _key(one) not in seen), None)
        if finding is None or finding.fix is None:
            break
        seen.add(_key(finding))
        try:
            blueprint = finding.fix.apply(blueprint)
        except StudioError:
            continue
        mended.append(finding)
        told(len(mended))
    return Repair(tuple(mended), blueprint)


def mend(blueprint: Blueprint, finding: Finding) -> Blueprint:
    """Apply the fix of a finding as it is found in ``blueprint`` now.

    EditRefused where it is found no longer, so that a fix that was made for what stood there
    before cannot delete or rename something else.
    """
    for one in inspect(blueprint, [finding.rule]):
        if _key(one) == _key(finding) and one.addresses == finding.addresses and one.fix:
            return one.fix.apply(blueprint)
    raise EditRefused(
        f"{finding.address} has changed since this was found",
        advice="Look at the findings again.",
    )


def _key(finding: Finding) -> tuple[str, str, str]:
    return finding.rule, str(finding.address), finding.fix.words if finding.fix else ""
