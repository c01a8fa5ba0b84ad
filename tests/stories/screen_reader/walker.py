"""Walks the tree that a program shows to assistive tools, as a screen reader does.

Debian's Python runs it, because it has ``pyatspi``: ``walker.py PROCESS WALKS OUT``. It asks every
object for its name, role, state, relations, interfaces, place and actions. OUT becomes a JSON list
with each object of the last walk as ``[role, name, path of names, whether a label names it]``. Of
objects without a name those of all walks are in it.
"""

from __future__ import annotations

import json
import pathlib
import sys
import threading
from typing import Any

import gi

gi.require_version("Atspi", "2.0")

import pyatspi  # noqa: E402
from gi.repository import Atspi, GLib  # noqa: E402

DEEPEST = 60
PATIENCE = 600
"""How often the program is looked for, every 0.1 s."""
REPLY = 120_000
"""Milliseconds in which the program must reply; a busy machine takes as long as it takes."""

Seen = list[tuple[str, str, list[str], bool]]
UNNAMED: list[tuple[Any, int]] = []
"""Things that had no name when they were asked, with their places in what this walk has seen."""


def application(process: int) -> Any:
    """The program with this process number, once it has come onto the bus."""
    for _ in range(PATIENCE):
        for one in pyatspi.Registry.getDesktop(0):
            if one is not None and one.get_process_id() == process:
                return one
        threading.Event().wait(0.1)
    sys.exit("the program did not come onto the accessibility bus")


def walk(thing: Any, path: list[str], seen: Seen) -> None:
    """Ask a thing and all below it for everything they offer; some go while the window works."""
    try:
        ask(thing, path, seen)
    except GLib.GError as error:
        if "No such object path" not in str(error):
            raise


def ask(thing: Any, path: list[str], seen: Seen) -> None:
    """Ask one thing for everything, then walk through its children."""
    role, name = thing.getRoleName(), thing.name or ""
    labelled = any(
        one.getRelationType() == pyatspi.RELATION_LABELLED_BY for one in thing.getRelationSet()
    )
    seen.append((role, name, path, labelled))
    if not name:
        UNNAMED.append((thing, len(seen) - 1))
    assert thing.description is not None
    thing.getState().getStates()
    thing.get_interfaces()
    for query in (thing.queryComponent, thing.queryAction, thing.queryText, thing.queryValue):
        try:
            offered = query()
        except NotImplementedError:
            continue
        if query == thing.queryComponent:
            offered.getExtents(pyatspi.DESKTOP_COORDS)
    # One beyond the last: who counted before something went asks for what is gone.
    thing.getChildAtIndex(thing.childCount)
    if len(path) < DEEPEST:
        for index in range(thing.childCount):
            child = thing.getChildAtIndex(index)
            if child is not None:
                walk(child, [*path, name or role], seen)


def unnamed(seen: Seen) -> Seen:
    """What has no name at the end of a walk either. A row of a list that is filled anew has none
    for a moment, and then it has one, or it is gone."""
    found = []
    for thing, at in UNNAMED:
        try:
            gone = thing.name or thing.getState().contains(pyatspi.STATE_DEFUNCT)
        except GLib.GError:
            gone = True
        if not gone:
            found.append(seen[at])
    UNNAMED.clear()
    return found


def main() -> None:
    """Walk round as often as asked for, and write down what the last walk saw."""
    process, walks, out = int(sys.argv[1]), int(sys.argv[2]), pathlib.Path(sys.argv[3])
    Atspi.set_timeout(REPLY, REPLY)
    top = application(process)
    seen: Seen = []
    nameless: Seen = []
    for _ in range(walks):
        seen = []
        walk(top, [], seen)
        nameless += [thing for thing in unnamed(seen) if thing not in nameless]
    out.write_text(json.dumps([*(thing for thing in seen if thing[1]), *nameless]))


main()
