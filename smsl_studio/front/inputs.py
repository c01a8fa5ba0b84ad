"""Reads and inspects blueprints."""

from __future__ import annotations

import os
from collections.abc import Collection

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.smsl.files import parse_bytes, read_document

START_RULES = ("R01", "R02", "R03", "R07", "R08")
"""The rules whose E findings refuse every run. R13 refuses a run in one case only (see
``refusals``)."""


def read(path: str | os.PathLike[str]) -> Blueprint:
    """Read the blueprint in a file. ReadError, with line and column, if it has no blueprint.

    >>> blueprint = read("hanoi.json")
    >>> list(blueprint.branches), len(blueprint["SB1"].table)
    (['SB1'], 27)
    """
    return read_blueprint(read_document(path))


def read_bytes(raw: bytes, file: str) -> Blueprint:
    """Read a blueprint from bytes. ``file`` is the name in messages. ReadError as in ``read``."""
    return read_blueprint(parse_bytes(raw, file))


def inspect(
    blueprint: Blueprint,
    rules: Collection[str] | None = None,
    world: str | None = None,
    against: Blueprint | None = None,
    robot: str = "",
) -> tuple[Finding, ...]:
    """Return the findings about a blueprint, in the order of the text (paper, Inspection).

    ``rules`` are the numbers of the rules to check, such as ``"R15"``. None means all rules.
    ``world`` asks also what that world has for the blueprint, with its usual ``robot`` or another
    one. ``against`` is another version: what
    has changed since then comes last, removals first. UsageError for an unknown rule, WorldError
    for an unknown world.

    >>> [str(finding.place) for finding in inspect(read("hanoi.json"), ["R15"])]
    ['hanoi.json:73:13', 'hanoi.json:100:13']
    """
    from smsl_studio.inspection.inspect import in_order
    from smsl_studio.inspection.inspect import inspect as look

    found = look(blueprint, rules)
    if world is not None:
        from smsl_studio.front.equipment import findings_in_world

        more = findings_in_world(blueprint, world, rules, robot=robot)
        found = in_order(blueprint, (*found, *more))
    if against is None:
        return found
    from smsl_studio.inspection.against import inspect_against

    return (*found, *inspect_against(blueprint, against, rules))


def must_be_whole(blueprint: Blueprint) -> None:
    """Raise RunRefused if an answer about a blueprint could not be about all of it.

    Parts may be missing or doubled, or the blueprint may be too large for a check. The same reasons
    refuse a run.
    """
    refuse_nonsense(blueprint, "Mend what this finding says first.")
    from smsl_studio.dispatch.route.effort import refuse_too_large

    refuse_too_large(Hierarchy(blueprint))


def refuse_nonsense(blueprint: Blueprint, advice: str) -> None:
    """Raise RunRefused with the first finding for which a run would be refused, if any."""
    found = refusals(blueprint)
    if found:
        more = f" (and {len(found) - 1} more findings like it)" if len(found) > 1 else ""
        raise RunRefused(
            f"{found[0].rule} {found[0].address}: {found[0].message}{more}",
            found[0].place,
            advice,
        )


def refusals(blueprint: Blueprint) -> tuple[Finding, ...]:
    """Return the findings that refuse a run at its start, even in simulation.

    >>> refusals(read("hanoi.json"))
    ()
    """
    found = [f for f in inspect(blueprint, START_RULES) if f.severity is Severity.ERROR]
    same = {
        branch.name
        for branch in blueprint
        if branch.name in blueprint.bases and branch.initial == branch.activating
    }
    if same:
        found += [
            finding
            for finding in inspect(blueprint, ("R13",))
            if finding.severity is Severity.ERROR and finding.address.branch in same
        ]
    return tuple(found)
