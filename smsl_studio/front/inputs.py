"""Reading and inspecting a blueprint."""

from __future__ import annotations

import os
from collections.abc import Collection

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.smsl.files import parse_bytes, read_document

START_RULES = ("R01", "R02", "R03", "R07", "R08")
"""The rules whose E findings refuse a run in simulation; R13 does in one case only."""


def read(path: str | os.PathLike[str]) -> Blueprint:
    """The blueprint in a file; ReadError names file, line and column where there is none.

    >>> blueprint = read("hanoi.json")
    >>> list(blueprint.branches), len(blueprint["SB1"].table)
    (['SB1'], 27)
    """
    return read_blueprint(read_document(path))


def read_bytes(raw: bytes, file: str) -> Blueprint:
    """The blueprint in the bytes of a file; ``file`` is the name that messages show."""
    return read_blueprint(parse_bytes(raw, file))


def inspect(blueprint: Blueprint, rules: Collection[str] | None = None) -> tuple[Finding, ...]:
    """What the rules have to say about a blueprint, in the order of the text.

    ``rules`` are the numbers of those to be asked, such as ``"R15"``; all where none is named.
    UsageError for a rule that does not exist.

    >>> [str(finding.place) for finding in inspect(read("hanoi.json"), ["R15"])]
    ['hanoi.json:73:13', 'hanoi.json:100:13']
    """
    from smsl_studio.inspection.inspect import inspect as look

    return look(blueprint, rules)


def refusals(blueprint: Blueprint) -> tuple[Finding, ...]:
    """The findings for which a run is refused at its start, also in simulation.

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
