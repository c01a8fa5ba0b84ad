"""The whole check of a blueprint. An approval signs its result, and a verification repeats it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.inputs import inspect
from smsl_studio.inspection.approval.statement import InspectionOptions
from smsl_studio.inspection.inspect import in_order
from smsl_studio.inspection.proof.verdict import PropertyVerdict
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.library.loaded import Loaded

WHOLE = InspectionOptions(limit=None, with_failures=False, recoverability=False, rules=None)
"""The options of a check for which no options are given."""
NOWHERE: Mapping[str, Loaded] = MappingProxyType({})


@dataclass(frozen=True)
class CheckAnswer:
    """The result of a check.

    It has all findings, the verdicts about hazards and properties, and sentences about failure
    states from which no route leads back.
    """

    findings: tuple[Finding, ...]
    verdicts: tuple[PropertyVerdict, ...] = ()
    stuck: tuple[str, ...] = ()

    def of(self, severity: Severity, apart: Collection[str] = ()) -> tuple[Finding, ...]:
        """Return the findings of a severity. Findings in the files ``apart`` are left out."""
        return tuple(
            one for one in self.findings if one.severity is severity and one.place.file not in apart
        )

    def errors(self, apart: Collection[str] = ()) -> tuple[str, ...]:
        """Return sentences for everything that prevents an approval."""
        found = self.of(Severity.ERROR, apart)
        told = [f"{one.rule} {one.address}: {one.message}" for one in found]
        return (*told, *self.stuck)


def whole_check(
    blueprint: Blueprint,
    options: InspectionOptions = WHOLE,
    worlds: Mapping[str, Loaded] = NOWHERE,
) -> CheckAnswer:
    """Check a blueprint as the command ``check`` does.

    ``worlds`` has the plugins of each world in which it is checked too. UsageError for an unknown
    rule.
    """
    from smsl_studio.front.equipment import findings_in_world
    from smsl_studio.front.proof import prove

    rules = options.rules
    findings = inspect(blueprint, rules)
    for world, loaded in worlds.items():
        findings = (*findings, *findings_in_world(blueprint, world, rules, loaded))
    limit = {"limit": options.limit} if options.limit else {}
    proof = prove(blueprint, **limit, with_failures=options.with_failures)
    shown = tuple(f for f in proof.findings if rules is None or f.rule in rules)
    stuck: tuple[str, ...] = ()
    if options.recoverability:
        from smsl_studio.front.recovery import recoverability

        found = recoverability(blueprint, **limit)
        stuck = tuple(f"{one.state} has no way back" for one in found if not one.is_complete)
    return CheckAnswer(in_order(blueprint, (*findings, *shown)), proof.verdicts, stuck)
