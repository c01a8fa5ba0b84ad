"""``plugins``: lists the plugins with their sources and faults, and allows or forbids a plugin."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Mapping
from typing import Any

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.output import Output, note
from smsl_studio.errors import PluginError, UsageError
from smsl_studio.front.generated_trials import trials_told
from smsl_studio.front.installed import (
    allow_generated,
    allow_plugin,
    forbid_plugin,
    generated_functions,
    plugins,
)
from smsl_studio.legible import one_line
from smsl_studio.library.entries import FaultEntry
from smsl_studio.library.generated_proposal import GeneratedProposal, is_allowed
from smsl_studio.library.generated_trials import FunctionTrial, read_trials
from smsl_studio.library.loaded import Loaded, Plugin, PluginFault
from smsl_studio.library.survey import FoundPlugin

VERBS = ("allow", "forbid")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``plugins``."""
    parser.add_argument(
        "verb",
        nargs="?",
        choices=VERBS,
        help="allow a plugin, so that its code is loaded as long as its files stay as they are, or "
        "forbid it; without either, list them all",
    )
    parser.add_argument("name", nargs="?", metavar="NAME", help="the plugin's name, or its folder")
    parser.add_argument(
        "--read",
        metavar="DIGEST",
        help="with allow and a folder of generated functions: the SHA-256 of what was read, as "
        "allow without it tells",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """List all plugins, or allow or forbid one. UsageError if no plugin, or more than one, has the
    name."""
    if options.verb is None:
        return _list(options.format == "json", out)
    if options.name is None:
        raise UsageError(
            f"plugins {options.verb} takes the name of a plugin",
            advice="smsl-studio plugins lists them.",
        )
    waiting = generated_functions(options.name) if options.verb == "allow" else None
    if waiting is not None:
        return _read_and_allow(waiting, options.read, options.format == "json", out)
    if options.read is not None:
        raise UsageError(f"{options.name} holds no generated functions", advice="Leave out --read.")
    done = (allow_plugin if options.verb == "allow" else forbid_plugin)(options.name)
    if options.format == "json":
        out.json(waiting_as_json(done))
        return 0
    out.line(one_line(f"{done.name}: {done.state.value} ({done.source}, {done.location})"))
    if done.digest:
        out.line(f"    files: SHA-256 {done.digest}")
    return 0


def _read_and_allow(
    waiting: GeneratedProposal, read: str | None, as_json: bool, out: Output
) -> int:
    """Show what differs from the code that was allowed before, or allow what was read. 1: it is
    shown and not yet allowed."""
    operations = list(waiting.written())
    told = {"name": waiting.name, "location": str(waiting.folder), "digest": waiting.digest}
    if read is not None:
        found = allow_generated(waiting, read)
        if as_json:
            out.json({**told, "state": found.state.value, "operations": operations})
        else:
            out.line(one_line(f"{found.name}: {found.state.value} ({found.location})"))
            for operation in operations:
                out.line(one_line(f"    {operation}: offered once it has passed its sweep"))
        return 0
    difference = waiting.difference()
    if as_json:
        out.json({**told, "state": "new", "operations": operations, "difference": difference})
    elif is_allowed(waiting):
        out.line(one_line(f"{waiting.name}: allowed, nothing has changed"))
        return 0
    else:
        for line in difference.splitlines():
            out.line(one_line(line))
        note(one_line(f"Read this. Nothing of {waiting.folder} has run, and it is not loaded."))
        allow = f"smsl-studio plugins allow {waiting.folder} --read {waiting.digest[:12]}"
        note(one_line(f"To allow it: {allow}"))
    return 1


def _list(as_json: bool, out: Output) -> int:
    loaded = plugins()
    if as_json:
        listed = [_as_json(plugin, loaded) for plugin in loaded.plugins]
        listed += [waiting_as_json(found) for found in loaded.waiting]
        faults = [fault_as_json(fault) for fault in loaded.faults]
        out.json({"plugins": listed, "faults": faults})
        return 0
    for plugin in loaded.plugins:
        _print(plugin, loaded, out)
    for found in loaded.waiting:
        print_waiting(found, out)
    for fault in loaded.faults:
        out.line(out.red(one_line(str(fault))))
    if loaded == type(loaded)():
        out.line("no plugins")
    return 0


def fault_as_json(fault: PluginFault) -> dict[str, Any]:
    """Return a plugin that did not load as plain values."""
    place = fault.place
    return {
        "plugin": fault.plugin,
        "state": "fault",
        "location": fault.location,
        "file": place.file if place else None,
        "line": place.line if place else None,
        "message": fault.sentence,
    }


def waiting_as_json(found: FoundPlugin) -> dict[str, Any]:
    """Return a plugin that is not loaded as plain values: its manifest and the reason."""
    words = found.manifest
    return {
        "name": found.name,
        "state": found.state.value,
        "version": words.version if words else "",
        "description": words.description if words else "",
        "source": found.source,
        "location": found.location,
        "digest": found.digest or None,
        "message": found.reason,
        "manifest": {kind: list(names) for kind, names in words.registers.items()} if words else {},
    }


def print_waiting(found: FoundPlugin, out: Output) -> None:
    """Print a plugin that is not loaded, for people."""
    words = found.manifest
    version = f" {words.version}" if words else ""
    state = out.yellow(found.state.value)
    out.line(f"{one_line(f'{found.name}{version} ({found.source}, {found.location})')}: {state}")
    if words and words.description:
        out.line(f"    {one_line(words.description)}")
    out.line(f"    {one_line(found.reason)}")
    _print_parts(words.registers if words else {}, out)


def _as_json(plugin: Plugin, loaded: Loaded) -> dict[str, Any]:
    library = plugin.library
    return {
        "name": plugin.name,
        "state": "allowed",
        "version": plugin.version,
        "description": plugin.description,
        "source": plugin.source,
        "location": plugin.location,
        "worlds": list(library.worlds),
        "world_robots": [
            {"world": world, "robots": list(robots)}
            for world, robots in _choices(plugin, loaded).items()
        ],
        "robots": list(library.robots),
        "operations": [
            {
                "function": entry.name,
                "pattern": entry.pattern.text if entry.pattern else None,
                **({"generated": trials_told(entry, _trials())} if entry.code else {}),
            }
            for entry in library.operations
        ],
        "sensors": [entry.pattern.text for entry in library.sensors],
        "world_faults": [
            {"world": entry.world, "fault": entry.name, "parameters": list(entry.signature.types)}
            for entry in library.faults.values()
        ],
        "supervisors": [
            {"supervisor": entry.name, "options": list(entry.signature.types)}
            for entry in library.supervisors.values()
        ],
    }


def _trials() -> Mapping[tuple[str, str], FunctionTrial]:
    """Return the trials of generated functions. None count if they are not believed."""
    try:
        return read_trials()
    except PluginError as error:
        note(one_line(str(error)))
        return {}


def _choices(plugin: Plugin, loaded: Loaded) -> dict[str, tuple[str, ...]]:
    """Return the robots of each world of a plugin that can be built with several."""
    chosen = {world: loaded.robots(world) for world in plugin.library.worlds}
    return {world: robots for world, robots in chosen.items() if robots}


def _print(plugin: Plugin, loaded: Loaded, out: Output) -> None:
    library = plugin.library
    where = f"{plugin.source}, {plugin.location}"
    out.line(f"{one_line(f'{plugin.name} {plugin.version} ({where})')}: allowed")
    if plugin.description:
        out.line(f"    {one_line(plugin.description)}")
    for entry in library.operations:
        if entry.code and entry.pattern:
            out.line(one_line(f"    {entry.pattern.text}: {trials_told(entry, _trials())}"))
    choices = {f"robots of {world}": names for world, names in _choices(plugin, loaded).items()}
    parts: dict[str, Iterable[str]] = {
        "worlds": list(library.worlds),
        **choices,
        "robots": list(library.robots),
        "operations": [e.pattern.text if e.pattern else e.name for e in library.operations],
        "sensors": [e.pattern.text for e in library.sensors],
        "faults": [_called(entry) for entry in library.faults.values()],
        "supervisors": list(library.supervisors),
    }
    _print_parts(parts, out)


def _print_parts(parts: Mapping[str, Iterable[str]], out: Output) -> None:
    for what, names in parts.items():
        words = ", ".join(names)
        if words:
            out.line(f"    {what}: {one_line(words)}")


def _called(fault: FaultEntry) -> str:
    """Write a fault with its parameters, as a script needs them."""
    parameters = ", ".join(fault.signature.types)
    return f"{fault.name}({parameters})" if parameters else fault.name
