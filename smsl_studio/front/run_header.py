"""The header of a run's log: the request, and all data that differs between equal runs, which
events must not contain."""

from __future__ import annotations

import platform
import sys
from collections.abc import Mapping
from datetime import UTC, datetime
from os import getpid
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import is_exact, procedures_of
from smsl_studio.errors import StudioError
from smsl_studio.front.approval_badge import NOT_VERIFIED, unsigned_words
from smsl_studio.front.former_record import has_record_beside
from smsl_studio.front.request import RunRequest
from smsl_studio.front.version import version
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.events import PROCEDURE
from smsl_studio.runlog.grounds import BoundCode, grounds_of
from smsl_studio.runlog.names import names_of
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.world.engines import TABLE

Json = Any


def log_header(request: RunRequest, loaded: Loaded | None) -> Mapping[str, Json]:
    """Return the first line of a log: what was asked of the run, and where it ran.

    ``digests`` has the values of the command ``digest``, and the SHA-256 of every file. ``policy``
    says under which policy who approved the blueprint; it is null if the run asked for no approval.
    ``mqtt`` has the broker and the facts of remote sensors; it is null if there are none. ``badge``
    has the words of the approval badge.
    """
    blueprint, world = request.blueprint, request.world
    plugins = loaded.plugins if loaded else ()
    return {
        "wall_time": datetime.now(UTC).isoformat(timespec="milliseconds"),
        "node": platform.node(),
        "process": getpid(),
        "world": world,
        **request.as_json(),
        "policy": dict(request.trust.header) if request.trust is not None else None,
        "mqtt": _elsewhere(request),
        "file": str(Path(blueprint.file).absolute()),
        "digests": {
            "file": sha256_hex(blueprint.document.encoded()),
            **digests(blueprint).as_json(),
            **_imported(blueprint),
        },
        "versions": {
            "smsl-studio": version(),
            "python": sys.version.split()[0],
            **{f"plugin {plugin.name}": plugin.version for plugin in plugins},
        },
        "names": names_of(blueprint),
        "grounds": grounds_of(blueprint, _code(blueprint, world, loaded)),
        **({"procedures": below} if (below := procedure_digests(blueprint)) else {}),
        "badge": _badge(request),
    }


def _badge(request: RunRequest) -> str:
    """Return the words of the approval badge. Without an approval no record is verified."""
    if request.trust is not None:
        return request.trust.badge
    if has_record_beside(request.blueprint.file):
        return NOT_VERIFIED
    return unsigned_words(request.blueprint).words


def procedure_digests(blueprint: Blueprint) -> Mapping[str, Json]:
    """Return the closure digests of the blueprints that operations run, by their names in the
    bindings."""
    files = procedures_of(blueprint).files
    return {name: digests(part).closure for name, part in files.items()}


def _elsewhere(request: RunRequest) -> Mapping[str, Json] | None:
    """Return the facts of remote sensors with their sources, and the broker. None if there are
    none."""
    trust = request.trust
    try:
        file = (trust and trust.bindings) or bindings_beside(request.blueprint.file)
    except StudioError:
        # The run is refused. Its log needs a header all the same, to record the refusal.
        return None
    table = file.mqtt
    if not table.facts:
        return None
    return {
        "broker": request.broker or table.broker,
        "site": request.site or table.site,
        "run": table.run,
        "facts": {key: list(table.sources(key)) for key in table.facts},
    }


def _code(blueprint: Blueprint, world: str, loaded: Loaded | None) -> BoundCode:
    """Return which facts have a sensor in the world, and which function each operation has.

    Both are empty if they are not known before the run.
    """
    try:
        file = bindings_beside(blueprint.file)
        found = bind(blueprint, loaded or Loaded(()), world, file)
    except StudioError:
        return BoundCode()
    operations = found.operations
    below = procedures_of(blueprint).bound
    # The table world makes a binding only when somebody asks for it. So there is nothing to list.
    many = () if world == TABLE else operations.items()
    exact = frozenset(address for address, one in many if one.exact)
    exact |= {edge for edge in below if is_exact(blueprint[edge.branch], edge)}

    def function(edge: Address) -> str | None:
        """Return the name of an edge's function, or None if it has none."""
        if edge in below:
            return f"{PROCEDURE}{below[edge].name}"
        bound = operations.get(edge)
        return None if bound is None else bound.name

    sensed = ((one.branch, one.digit) for one in found.sensors)
    return BoundCode(sensed, function, exact, bool(found.costs))


def _imported(blueprint: Blueprint) -> Mapping[str, Json]:
    """Return the digests of imported files and of those that operations run, if there are any."""
    run = (one for part in procedures_of(blueprint).parts for one in part.documents)
    files = {one.file: sha256_hex(one.encoded()) for one in (*blueprint.documents[1:], *run)}
    return {"imported": files} if files else {}
