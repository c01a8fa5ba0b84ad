"""``store``: the blueprints that were inspected and operations that were verified, by content."""

from __future__ import annotations

import argparse
import getpass

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.output import Output, note
from smsl_studio.cli.passphrase import add_passphrase, passphrase
from smsl_studio.errors import UsageError
from smsl_studio.front.revocations import dependants_of
from smsl_studio.front.store_shelf import (
    add_blueprint,
    add_record,
    as_json,
    find_stored,
    is_record,
    mark_of,
    shown_stored,
)
from smsl_studio.inspection.approval.shelf import StoredBlueprint
from smsl_studio.legible import one_line

NEEDS = {"add": "FILE", "show": "DIGEST", "revoke": "DIGEST", "dependants": "DIGEST"}
VERBS = ("add", "list", "find", "show", "revoke", "dependants")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``store``."""
    parser.add_argument("verb", choices=VERBS, help="what to do with the store")
    parser.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help="add: a blueprint or a record; find: words of titles, operations or facts; show, "
        "revoke, dependants: a SHA-256, sha256:... or 64 digits",
    )
    parser.add_argument("--world", metavar="NAME", help="add: run every operation in this world")
    parser.add_argument(
        "--seeds", type=int, default=1, metavar="N", help="add: with so many seeds (default 1)"
    )
    parser.add_argument("--by", metavar="NAME", help="add: who answers for the runs (you)")
    parser.add_argument("--key", metavar="ID", help="revoke: a key of the store: who you are")
    parser.add_argument("--why", metavar="TEXT", help="revoke: the reason")
    add_passphrase(parser)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Do what the verb says. Return 0; 1 if nothing was found, or a file was not inspected well."""
    names = options.names
    wanted = NEEDS.get(options.verb)
    if wanted is not None and len(names) != 1:
        raise UsageError(f"store {options.verb} needs one {wanted}", advice="See store --help.")
    if options.verb == "list" and names:
        raise UsageError("store list takes no names", advice="store find WORD looks for some.")
    if options.verb == "revoke":
        return _revoke(options, out)
    if options.verb == "add":
        return _add(options, out)
    if options.verb == "dependants":
        return _dependants(options, out)
    found = (shown_stored(names[0]),) if options.verb == "show" else find_stored(names)
    return _list(options, out, found)


def _add(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.cli.blueprint_argument import read_argument

    name = options.names[0]
    if is_record(name):
        if options.world:
            raise UsageError("--world is for a blueprint", advice="Add the blueprint's file.")
        added = add_record(name)
        if options.format == "json":
            out.json({"records": [f"sha256:{one}" for one in added]})
        for digest in added if options.format != "json" else ():
            out.line(f"record sha256:{digest}: added")
        return 0
    blueprint = read_argument(name)
    by = options.by or (_user() if options.world else "")
    entry = add_blueprint(blueprint, options.world or "", options.seeds, by)
    if options.format == "json":
        out.json({"added": as_json(entry, mark_of(entry).words)})
    else:
        out.line(one_line(f"sha256:{entry.digest}: {entry.title}: added"))
        for one in entry.verified:
            out.line(one_line(f"  {one.words}"))
    swept = [each for one in entry.verified for each in one.operations]
    return int(bool(options.world) and any(one.passed < one.edges for one in swept))


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return ""


def _list(options: argparse.Namespace, out: Output, found: tuple[StoredBlueprint, ...]) -> int:
    marked = [(one, mark_of(one)) for one in found]
    if options.format == "json":
        if options.verb == "show":
            ((one, mark),) = marked
            out.json({**as_json(one, mark.words), "reasons": list(mark.reasons)})
        else:
            out.json({"stored": [as_json(one, mark.words) for one, mark in marked]})
        return int(options.verb == "find" and not found)
    for one, mark in marked:
        out.line(one_line(f"sha256:{one.digest} {one.title}: {mark.words}"))
        if options.verb == "show":
            _show(out, one, mark.reasons)
    if not found:
        note("the store holds no such blueprint" if options.names else "the store is empty")
    return int(options.verb == "find" and not found)


def _show(out: Output, one: StoredBlueprint, reasons: tuple[str, ...]) -> None:
    rows = (
        *reasons,
        f"operations: {', '.join(one.operations)}",
        f"facts: {', '.join(one.facts)}",
        *(f"uses sha256:{part}" for part in one.parts),
        *(each.words for each in one.verified),
    )
    for row in rows:
        out.line(one_line(f"  {row}"))


def _dependants(options: argparse.Namespace, out: Output) -> int:
    found = dependants_of(options.names[0])
    if options.format == "json":
        out.json({"digest": options.names[0], "dependants": [one.as_json() for one in found]})
        return 0
    for one in found:
        out.line(one_line(f"{one.kind} sha256:{one.digest} {one.file}: {one.why}"))
    if not found:
        note("nothing in the store depends on it")
    return 0


def _revoke(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.front.key_ring import revoke_digest

    for name in ("key", "why"):
        if not getattr(options, name):
            raise UsageError(f"store revoke needs --{name}", advice="smsl-studio store --help")
    words = passphrase(options, options.key)
    digest = revoke_digest(options.names[0], options.why, options.key, words)
    if options.format == "json":
        out.json({"revoked": f"sha256:{digest}", "why": options.why})
    else:
        out.line(one_line(f"sha256:{digest}: revoked: {options.why}"))
    return 0
