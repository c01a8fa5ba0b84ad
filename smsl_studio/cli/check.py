"""``check``: inspects blueprints. The exit status is 1 if there is a finding of severity E."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.arguments import (
    ArgumentParser,
    add_effort,
    add_format,
    add_limit,
    add_robot,
    add_world,
)
from smsl_studio.cli.blueprint_argument import read_argument, read_each
from smsl_studio.cli.output import Output, note
from smsl_studio.errors import ReadError, UsageError
from smsl_studio.front.inputs import inspect
from smsl_studio.inspection.inspect import PROVED, in_order
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import one_line
from smsl_studio.stop import look_for_garbage

if TYPE_CHECKING:
    from smsl_studio.front.recovery import FailureRecovery
    from smsl_studio.inspection.proof.verdict import PropertyVerdict
    from smsl_studio.library.loaded import Loaded

SHOWN = "shown for this blueprint as written, if every operation does what its edge says"
MOST_HELD = 100
"""The largest number of hazards and properties that hold and are listed in the text."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``check``."""
    parser.add_argument("files", nargs="+", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "--rule", action="append", metavar="R", help="only this rule, such as R15; may be repeated"
    )
    add_limit(parser, "store at most N configurations to show properties (default 1,000,000)")
    add_effort(parser)
    parser.add_argument(
        "--with-failures",
        action="store_true",
        help="properties begin also where one SB has failed, wherever that can happen",
    )
    parser.add_argument(
        "--recoverability",
        action="store_true",
        help="tell how the procedure recovers from each failure state",
    )
    parser.add_argument(
        "--against", metavar="OTHER", help="tell what has changed since this version, or record"
    )
    parser.add_argument(
        "--explain",
        metavar="ADDRESS",
        help="write an element, or a fact as SB/digit, in the notation of the paper",
    )
    add_world(parser, required=False)
    add_robot(parser)
    add_format(parser, "sarif")


def execute(options: argparse.Namespace, out: Output) -> int:
    """Inspect each file and print its findings. 0: no error; 1: an error; 2: unreadable."""
    if options.robot and options.world is None:
        raise UsageError("--robot needs a world", advice="Name it with --world.")
    loaded = _loaded(options.world)
    if loaded is not None:
        loaded.robot_name(options.world, options.robot)
    inspect(_nothing(), options.rule)
    against = options.against
    is_record = against is not None and _is_record(against)
    other = None if against is None or is_record else read_argument(against)
    checked: list[_Checked] = []
    unread: list[ReadError] = []
    worst = 0
    for blueprint in read_each(options.files, "smsl-studio check"):
        if isinstance(blueprint, ReadError):
            unread.append(blueprint)
            continue
        one = _checked(blueprint, options, loaded)
        if other is not None:
            one = _with_changes(one, other, options.rule)
        elif "R27" in (options.rule or ("R27",)):
            one = _since_record(one, against)
        if options.explain is not None:
            one = one._replace(explained=_explained(blueprint, options.explain))
        worst = max(worst, one.status)
        if options.format == "text":
            _print(one, out)
            _print_recoveries(one, out)
            for line in one.explained or ():
                out.line(one_line(line))
        else:
            checked.append(one)
    if options.format == "json":
        out.json({"files": [_as_json(one) for one in checked]})
    elif options.format == "sarif":
        from smsl_studio.cli.sarif import sarif

        out.json(sarif([(one.blueprint, one.findings) for one in checked], unread))
    return 2 if unread else worst


class _Checked(NamedTuple):
    """What was found out about one file. ``recoveries`` and ``explained`` are None if they were
    not asked for."""

    blueprint: Blueprint
    findings: tuple[Finding, ...]
    verdicts: tuple[PropertyVerdict, ...] = ()
    recoveries: tuple[FailureRecovery, ...] | None = None
    explained: tuple[str, ...] | None = None

    @property
    def status(self) -> int:
        """The exit status for this file."""
        if not all(one.is_complete for one in self.recoveries or ()):
            return 1
        return int(any(found.severity is Severity.ERROR for found in self.findings))


def _checked(blueprint: Blueprint, options: argparse.Namespace, loaded: Loaded | None) -> _Checked:
    """Inspect one file, and show its properties and recoveries as far as they are asked for."""
    one = _Checked(blueprint, inspect(blueprint, options.rule))
    if options.world is not None:
        from smsl_studio.front.equipment import findings_in_world

        more = findings_in_world(blueprint, options.world, options.rule, loaded, options.robot)
        one = one._replace(findings=in_order(blueprint, (*one.findings, *more)))
    limit = {"limit": options.limit} if options.limit else {}
    effort = {"seconds": options.seconds, "megabytes": options.memory}
    if _has_properties(blueprint) and not PROVED.keys().isdisjoint(options.rule or PROVED):
        from smsl_studio.front.proof import prove

        look_for_garbage()
        proof = prove(blueprint, **limit, with_failures=options.with_failures, **effort)
        shown = (f for f in proof.findings if f.rule in (options.rule or PROVED))
        findings = in_order(blueprint, (*one.findings, *shown))
        one = one._replace(findings=findings, verdicts=proof.verdicts)
    if options.recoverability:
        from smsl_studio.front.recovery import recoverability

        look_for_garbage()
        recoveries = recoverability(blueprint, **limit, **effort)
        for bound in dict.fromkeys(one.bound for one in recoveries if one.bound):
            note(f"{blueprint.file}: recoverability is not known everywhere: {bound}")
        one = one._replace(recoveries=recoveries)
    return one


def _explained(blueprint: Blueprint, address: str) -> tuple[str, ...]:
    """Return an element in the notation of the paper. It is loaded only if somebody asks."""
    from smsl_studio.blueprint.notation import notation_of

    return notation_of(blueprint, address)


def _is_record(file: str) -> bool:
    """Whether a file is a record. A record has exactly one member."""
    path = Path(file)
    if not path.is_file():
        return False
    with path.open("rb") as stream:
        return stream.read(64).lstrip().startswith(b'{"records"')


def _since_record(one: _Checked, record: str | None) -> _Checked:
    """Add findings about the changes since the newest record, after all other findings.

    Most files have no record. Then nothing is loaded for this.
    """
    from smsl_studio.front.former_record import changes_since_record, may_have_record

    if record is None and not may_have_record(one.blueprint.file):
        return one
    try:
        name, changes = changes_since_record(one.blueprint, record)
    except ReadError as error:
        if record is not None:
            raise
        note(f"{error}; nothing is said about what has changed since")
        return one
    if name:
        note(f"{one.blueprint.file}: compared with {name}; its signature was not checked")
    return one._replace(findings=(*one.findings, *changes))


def _with_changes(one: _Checked, other: Blueprint, rules: list[str] | None) -> _Checked:
    """Add findings about the changes since another version, after all other findings."""
    from smsl_studio.inspection.against import inspect_against

    changes = inspect_against(one.blueprint, other, rules)
    return one._replace(findings=(*one.findings, *changes))


def _nothing() -> Blueprint:
    """Return an empty blueprint. Its inspection raises UsageError for unknown rules."""
    from smsl_studio.front.inputs import read_bytes

    return read_bytes(b"{}", "")


def _loaded(world: str | None) -> Loaded | None:
    """Return the plugins of the chosen world. Without a world no plugin is looked at."""
    if world is None:
        return None
    from smsl_studio.front.equipment import loaded_for

    return loaded_for(world)


def _has_properties(blueprint: Blueprint) -> bool:
    """Whether there may be something to show. Most files have nothing, and load no proof."""
    keys = ("_hazards", "_properties")
    return any(one.values.get(key) for one in blueprint.documents for key in keys)


def _as_json(checked: _Checked) -> dict[str, Any]:
    blueprint, findings, verdicts, recoveries, explained = checked
    runs = {one.address: one.counterexample for one in verdicts if one.counterexample}
    told = []
    for finding in findings:
        said = _finding(blueprint, finding)
        if finding.rule in PROVED and finding.address in runs:
            said["counterexample"] = runs[finding.address].as_json()
        told.append(said)
    found = {
        "file": blueprint.file,
        "states": blueprint.state_count,
        "operations": blueprint.operation_count,
        "findings": told,
        "properties": [verdict.as_json() for verdict in verdicts],
    }
    if recoveries is not None:
        found["recoverability"] = [one.as_json() for one in recoveries]
    if explained is not None:
        found["explained"] = list(explained)
    return found


def _finding(blueprint: Blueprint, finding: Finding) -> dict[str, Any]:
    """Return a finding as plain values, with its file if this is an imported file."""
    file = finding.place.file
    return finding.as_json() if file == blueprint.file else {**finding.as_json(), "file": file}


def _print(checked: _Checked, out: Output) -> None:
    blueprint = checked.blueprint
    paint = {Severity.ERROR: out.red, Severity.WARNING: out.yellow, Severity.NOTE: out.plain}
    counts = dict.fromkeys(Severity, 0)
    for finding in checked.findings:
        counts[finding.severity] += 1
        mark = paint[finding.severity](f"{finding.severity.value} {finding.rule}")
        said = "; ".join(filter(None, (finding.message, finding.advice, finding.also)))
        words = one_line(f"{finding.address}: {said}")
        out.line(f"{one_line(str(finding.place))}: {mark} {words}")
    _print_held(checked, out)
    said = ", ".join(
        f"{counts[severity]} {word}{'' if counts[severity] == 1 else 's'}"
        for severity, word in zip(Severity, ("error", "warning", "note"), strict=True)
    )
    out.line(
        f"{one_line(blueprint.file)}: {blueprint.state_count} states, "
        f"{blueprint.operation_count} operations: {said}"
    )


def _print_held(checked: _Checked, out: Output) -> None:
    """Print a line for each hazard and property that holds; the others are findings."""
    if not checked.verdicts:
        return
    from smsl_studio.front.claim_rows import looked_at
    from smsl_studio.inspection.proof.verdict import HOLDS

    file = checked.blueprint.file
    out.line(one_line(f"{file}: {SHOWN}"))
    held = [one for one in checked.verdicts if one.verdict == HOLDS]
    for one in held[:MOST_HELD]:
        out.line(one_line(f"{file}: {one.address}: holds; {looked_at(one)}"))
    if len(held) > MOST_HELD:
        out.line(one_line(f"{file}: {len(held) - MOST_HELD} more hold"))


def _print_recoveries(checked: _Checked, out: Output) -> None:
    """Print a line for each failure state: the way out of it, who decides, and the cost of the
    goals."""
    if not checked.recoveries:
        return
    from smsl_studio.front.recovery_rows import recovery_row

    for one in checked.recoveries:
        row = recovery_row(checked.blueprint, one)
        if one.path is None:
            said = one.bound or "no way leads to where nothing has failed"
        else:
            many = len(one.path)
            by = ", ".join(str(address) for address in one.path)
            said = f"without failure in {one.state.branch}/{row.nearest}"
            said += f" after {many} operation{'' if many == 1 else 's'} by {by}" if many else ""
            said += f"; who decides: {row.decides}" if row.decides else ""
        goal = "no route to the goal" if one.cost is None else f"the goal costs {one.cost:g}"
        if one.cost is None and one.bound:
            goal = f"the route to the goal is unknown: {one.bound}"
        out.line(one_line(f"{checked.blueprint.file}: {one.state}: {said}; {goal}"))
