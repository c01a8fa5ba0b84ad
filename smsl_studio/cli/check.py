"""``check``: inspects blueprints. The exit status is 1 if there is a finding of severity E."""

from __future__ import annotations

import argparse
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.arguments import ArgumentParser, add_format, add_world
from smsl_studio.cli.blueprint_argument import read_each
from smsl_studio.cli.output import Output
from smsl_studio.errors import ReadError
from smsl_studio.front.inputs import inspect
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import one_line


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``check``."""
    parser.add_argument("files", nargs="+", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "--rule", action="append", metavar="R", help="only this rule, such as R15; may be repeated"
    )
    add_world(parser, required=False)
    add_format(parser, "sarif")


def execute(options: argparse.Namespace, out: Output) -> int:
    """Inspect each file and print its findings. 0: no error; 1: an error; 2: unreadable."""
    if options.world is not None:
        _must_exist(options.world)
    inspect(_nothing(), options.rule)
    inspected: list[tuple[Blueprint, tuple[Finding, ...]]] = []
    unread: list[ReadError] = []
    worst = 0
    for blueprint in read_each(options.files, "smsl-studio check"):
        if isinstance(blueprint, ReadError):
            unread.append(blueprint)
            continue
        findings = inspect(blueprint, options.rule)
        worst = max(worst, int(any(found.severity is Severity.ERROR for found in findings)))
        if options.format == "text":
            _print(blueprint, findings, out)
        else:
            inspected.append((blueprint, findings))
    if options.format == "json":
        out.json({"files": [_as_json(*one) for one in inspected]})
    elif options.format == "sarif":
        from smsl_studio.cli.sarif import sarif

        out.json(sarif(inspected, unread))
    return 2 if unread else worst


def _nothing() -> Blueprint:
    """Return an empty blueprint. Its inspection raises UsageError for unknown rules."""
    from smsl_studio.front.inputs import read_bytes

    return read_bytes(b"{}", "")


def _must_exist(world: str) -> None:
    from smsl_studio.host.plugin_offers import describe
    from smsl_studio.world.engines import TABLE

    if world != TABLE:
        describe().world(world)


def _as_json(blueprint: Blueprint, findings: tuple[Finding, ...]) -> dict[str, Any]:
    return {
        "file": blueprint.file,
        "states": blueprint.state_count,
        "operations": blueprint.operation_count,
        "findings": [_finding(blueprint, finding) for finding in findings],
    }


def _finding(blueprint: Blueprint, finding: Finding) -> dict[str, Any]:
    """Return a finding as plain values, with its file if this is an imported file."""
    file = finding.place.file
    return finding.as_json() if file == blueprint.file else {**finding.as_json(), "file": file}


def _print(blueprint: Blueprint, findings: tuple[Finding, ...], out: Output) -> None:
    paint = {Severity.ERROR: out.red, Severity.WARNING: out.yellow, Severity.NOTE: out.plain}
    counts = dict.fromkeys(Severity, 0)
    for finding in findings:
        counts[finding.severity] += 1
        mark = paint[finding.severity](f"{finding.severity.value} {finding.rule}")
        said = "; ".join(filter(None, (finding.message, finding.advice, finding.also)))
        words = one_line(f"{finding.address}: {said}")
        out.line(f"{one_line(str(finding.place))}: {mark} {words}")
    said = ", ".join(
        f"{counts[severity]} {word}{'' if counts[severity] == 1 else 's'}"
        for severity, word in zip(Severity, ("error", "warning", "note"), strict=True)
    )
    out.line(
        f"{one_line(blueprint.file)}: {blueprint.state_count} states, "
        f"{blueprint.operation_count} operations: {said}"
    )
