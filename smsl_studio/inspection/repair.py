"""Repair: applies quick fixes. Each fix is looked up anew in the blueprint that it changes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused, StudioError
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Finding, Severity

CERTAIN = ("R03", "R15")
"""The rules whose errors can have a fix that is certain (see ``Fix``)."""

MOST = 50
"""The largest number of fixes of one repair. The rules are checked again after each fix."""


class Repair(NamedTuple):
    """The result of several fixes: the mended findings in order, and the blueprint after them."""

    mended: tuple[Finding, ...]
    blueprint: Blueprint


def certain_errors(findings: Iterable[Finding]) -> list[Finding]:
    """Return the errors whose fix is certain (see ``Fix``)."""
    return [
        one
        for one in findings
        if one.severity is Severity.ERROR and one.fix is not None and one.fix.certain
    ]


def mend_errors(blueprint: Blueprint, told: Callable[[int], object] = lambda _: None) -> Repair:
    """Mend the errors whose fix is certain, one after the other, at most ``MOST`` of them.

    Each fix is looked up in the blueprint that the fix before it returned. A fix that is refused
    is left out. After each fix ``told`` is called with the number of fixes so far.
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
    """Apply the fix of a finding after looking the finding up in ``blueprint``.

    A blueprint that does not have the finding any more raises EditRefused. So an outdated fix
    cannot delete or rename the wrong element.
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
