"""The whole check of a blueprint, as an approval signs it and as a verification repeats it."""

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
"""The options of a check without options."""
NOWHERE: Mapping[str, Loaded] = MappingProxyType({})


@dataclass(frozen=True)
class CheckAnswer:
    """All findings, what was shown about properties, and the failure states without a way out."""

    findings: tuple[Finding, ...]
    verdicts: tuple[PropertyVerdict, ...] = ()
    stuck: tuple[str, ...] = ()

    def of(self, severity: Severity, apart: Collection[str] = ()) -> tuple[Finding, ...]:
        """Return the findings of a severity, except those in the files ``apart``."""
        return tuple(
            one for one in self.findings if one.severity is severity and one.place.file not in apart
        )

    def errors(self, apart: Collection[str] = ()) -> tuple[str, ...]:
        """Return everything that blocks an approval, in words."""
        found = self.of(Severity.ERROR, apart)
        told = [f"{one.rule} {one.address}: {one.message}" for one in found]
        return (*told, *self.stuck)


def whole_check(
    blueprint: Blueprint,
    options: InspectionOptions = WHOLE,
    worlds: Mapping[str, Loaded] = NOWHERE,
) -> CheckAnswer:
    """Check a blueprint with the options of ``check``, and in some worlds with their plugins.

    UsageError for an unknown rule.
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
