"""``nodes``: makes a site with certificates and topic rights, and runs its sample nodes."""

from __future__ import annotations

import argparse
import os
import select
import sys
import threading
from time import sleep

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.output import Output, note
from smsl_studio.errors import UsageError
from smsl_studio.front.sites.new_site import DAYS, LOGINS, PORT, make_site
from smsl_studio.front.sites.node_programs import LOOK, NodePrograms, open_nodes
from smsl_studio.legible import one_line
from smsl_studio.stop import heed, whole

VERBS = ("run", "make-site")
LONGEST = 200
"""The longest line on standard input that is read, in characters."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``nodes``."""
    parser.add_argument("verb", choices=VERBS, help="what to do with the site")
    parser.add_argument("folder", metavar="FOLDER", help="the folder with site.toml")
    parser.add_argument("--broker", metavar="HOST:PORT", help="run: the MQTT broker")
    parser.add_argument(
        "--fault",
        action="append",
        default=[],
        metavar="NODE=FAULT",
        help="run: a fault that is on from the beginning; may be repeated",
    )
    parser.add_argument(
        "--host",
        action="append",
        default=[],
        metavar="NAME",
        help="make-site: a name or address of the broker's computer; may be repeated (default: "
        "this computer only)",
    )
    parser.add_argument(
        "--port", type=_number, default=PORT, metavar="N", help=f"make-site: default {PORT}"
    )
    parser.add_argument(
        "--days",
        type=_number,
        default=DAYS,
        metavar="N",
        help=f"make-site: how long certificates are valid (default {DAYS})",
    )
    parser.add_argument(
        "--login", choices=LOGINS, default=LOGINS[0], help="make-site: what nodes log in with"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Do what the verb says. 0: done; 1: a node could not be played."""
    return _make(options, out) if options.verb == "make-site" else _run(options, out)


def _make(options: argparse.Namespace, out: Output) -> int:
    made = make_site(
        options.folder,
        hosts=options.host,
        port=options.port,
        days=options.days,
        login=options.login,
    )
    if options.format == "json":
        out.json(
            {
                "site": made.site.name,
                "nodes": list(made.site.nodes),
                "configuration": str(made.configuration),
                "files": [str(path) for path in made.files],
                "days": made.days,
            }
        )
        return 0
    for path in made.files:
        out.line(one_line(str(path)))
    note(f"start the broker: mosquitto -c {made.configuration}")
    note(f"then the nodes: smsl-studio nodes run {options.folder} --broker HOST:PORT")
    return 0


def _run(options: argparse.Namespace, out: Output) -> int:
    if not options.broker:
        raise UsageError("nodes run needs a broker", advice="Say --broker HOST:PORT.")
    lock, broken = threading.Lock(), threading.Event()

    def tell(node: str, line: str) -> None:
        """Print a line of a node."""
        if line.startswith("ended with"):
            broken.set()
        with lock:
            if options.format == "json":
                out.json({"event": "node_said", "node": node, "line": line})
            else:
                out.line(one_line(f"{node}: {line}"))

    nodes = open_nodes(options.folder, options.broker, tell)
    faults = [_fault(text) for text in options.fault]
    typed = _Typed()
    try:
        nodes.start(faults)
        while nodes.running:
            heed()
            for line in typed.lines():
                _obey(nodes, line)
    finally:
        with whole():
            nodes.end()
    return int(broken.is_set())


class _Typed:
    """The lines of standard input, read without waiting. Its end ends nothing."""

    def __init__(self) -> None:
        self._rest = b""
        try:
            self._handle: int | None = sys.stdin.fileno()
        except (OSError, AttributeError, ValueError):
            self._handle = None

    def lines(self) -> list[str]:
        """Return the lines that came within ``LOOK`` seconds."""
        if self._handle is None:
            sleep(LOOK)
            return []
        if not select.select([self._handle], [], [], LOOK)[0]:
            return []
        raw = os.read(self._handle, LONGEST)
        if not raw:
            self._handle = None
        *lines, self._rest = (self._rest + raw).split(b"\n")
        if not raw or len(self._rest) > LONGEST:
            lines, self._rest = [*lines, self._rest], b""
        return [line.decode("utf-8", "replace") for line in lines]


def _obey(nodes: NodePrograms, line: str) -> None:
    """Switch a fault: ``NODE FAULT`` or ``NODE good``."""
    node, _, fault = line.strip().partition(" ")
    if node and not fault:
        note("write NODE FAULT, or NODE good")
    elif node:
        try:
            nodes.say(node, fault.strip())
        except UsageError as error:
            note(f"{error.sentence}. {error.advice}")


def _fault(text: str) -> tuple[str, str]:
    node, equals, fault = text.partition("=")
    if not (node and equals and fault):
        raise UsageError(f"--fault {text!r}", advice="Write --fault NODE=FAULT.")
    return node, fault


def _number(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < len(text) < 7):
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 1 up")
    return int(text)
