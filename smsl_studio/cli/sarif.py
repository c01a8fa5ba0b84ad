"""Findings as SARIF 2.1.0 (OASIS), the form in which code hosts and editors read results.

A run has one result for each finding. A file that cannot be read is a notification of the run,
and the run then counts as not successful. Columns count characters. A file name that is relative
on the command line stays relative, so that a code host finds the file in its checkout.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path, PurePath
from typing import Any
from urllib.parse import quote

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.blueprint_argument import STDIN
from smsl_studio.errors import Place, ReadError
from smsl_studio.front.version import version
from smsl_studio.inspection.inspect import RULES
from smsl_studio.inspection.rules.finding import Finding, Severity

SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)
LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "note"}

Inspected = tuple[Blueprint, Sequence[Finding]]
"""A blueprint and its findings."""


def sarif(inspected: Iterable[Inspected], unread: Iterable[ReadError] = ()) -> dict[str, Any]:
    """Return the SARIF log of one call of ``check``, with the files that could not be read."""
    faults = [
        _located(
            {"level": "error", "message": {"text": _words(error.sentence, error.advice)}},
            error.place,
        )
        for error in unread
    ]
    results = [
        _result(blueprint, finding) for blueprint, findings in inspected for finding in findings
    ]
    invocation = {"executionSuccessful": not faults, "toolExecutionNotifications": faults}
    run = {
        "tool": {"driver": _driver()},
        "columnKind": "unicodeCodePoints",
        "invocations": [invocation],
        "results": results,
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _driver() -> dict[str, Any]:
    rules = [
        {"id": name, "shortDescription": {"text": f"{words[:1].upper()}{words[1:]}"}}
        for name, words in RULES.items()
    ]
    return {"name": "SMSL Studio", "version": version(), "rules": rules}


def _result(blueprint: Blueprint, finding: Finding) -> dict[str, Any]:
    fix = f"fix: {finding.fix.words}" if finding.fix else ""
    result = {
        "ruleId": finding.rule,
        "ruleIndex": list(RULES).index(finding.rule),
        "level": LEVELS[finding.severity],
        "message": {"text": _words(finding.message, finding.advice, finding.also, fix)},
        # An address stays the same when lines move, so a host knows an old finding again.
        "partialFingerprints": {"ruleAndAddress/v1": f"{finding.rule} {finding.address}"},
    }
    _located(result, finding.place, finding.address)
    if finding.others:
        result["relatedLocations"] = [
            _location(spot.place, spot.address) for spot in finding.others
        ]
    return result


def _located(
    entry: dict[str, Any], place: Place | None, address: Address | None = None
) -> dict[str, Any]:
    """Add the location to an entry of the log, if there is a place."""
    if place is not None:
        entry["locations"] = [_location(place, address)]
    return entry


def _location(place: Place, address: Address | None) -> dict[str, Any]:
    """Return a location: place in a file, and the address as its logical name."""
    location: dict[str, Any] = {}
    if place.file != STDIN:
        region = {"startLine": max(place.line, 1), "startColumn": max(place.column, 1)}
        artifact = {"uri": _uri(place.file)}
        location["physicalLocation"] = {"artifactLocation": artifact, "region": region}
    if address is not None:
        location["logicalLocations"] = [{"fullyQualifiedName": str(address)}]
    return location


def _uri(file: str) -> str:
    """Return the name of a file as a URI. Relative names stay relative."""
    path = PurePath(file)
    if path.is_absolute():
        return Path(file).as_uri()
    # A colon in the first part would look like the scheme of a URI; quote() writes it as %3A.
    return quote(path.as_posix().encode("utf-8", "surrogateescape"))


def _words(*parts: str) -> str:
    return "; ".join(filter(None, parts))
