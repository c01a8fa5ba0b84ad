"""``plugins``: what is installed, from where, and what failed to load and why."""

from __future__ import annotations

import argparse
from typing import Any

from smsl_studio.cli.arguments import Parser, add_format
from smsl_studio.cli.output import Output
from smsl_studio.host.describing import describe
from smsl_studio.library.loading import Plugin, PluginFault
from smsl_studio.library.operation_library import FaultEntry


def add_arguments(parser: Parser) -> None:
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    loaded = describe()
    if options.format == "json":
        out.json(
            {
                "plugins": [_as_json(plugin) for plugin in loaded.plugins],
                "faults": [fault_as_json(fault) for fault in loaded.faults],
            }
        )
        return 0
    for plugin in loaded.plugins:
        _print(plugin, out)
    for fault in loaded.faults:
        out.line(out.red(str(fault)))
    if not loaded.plugins and not loaded.faults:
        out.line("no plugins")
    return 0


def fault_as_json(fault: PluginFault) -> dict[str, Any]:
    """A plugin that did not load, as plain values."""
    place = fault.place
    return {
        "plugin": fault.plugin,
        "location": fault.location,
        "file": place.file if place else None,
        "line": place.line if place else None,
        "message": fault.sentence,
    }


def _as_json(plugin: Plugin) -> dict[str, Any]:
    library = plugin.library
    return {
        "name": plugin.name,
        "version": plugin.version,
        "description": plugin.description,
        "source": plugin.source,
        "location": plugin.location,
        "worlds": list(library.worlds),
        "operations": [
            {"function": entry.name, "pattern": entry.pattern.text if entry.pattern else None}
            for entry in library.operations
        ],
        "sensors": [entry.pattern.text for entry in library.sensors],
        "world_faults": [
            {"world": entry.world, "fault": entry.name, "parameters": list(entry.signature.types)}
            for entry in library.faults.values()
        ],
    }


def _print(plugin: Plugin, out: Output) -> None:
    library = plugin.library
    out.line(f"{plugin.name} {plugin.version} ({plugin.source}, {plugin.location})")
    if plugin.description:
        out.line(f"    {plugin.description}")
    parts = {
        "worlds": list(library.worlds),
        "operations": [e.pattern.text if e.pattern else e.name for e in library.operations],
        "sensors": [e.pattern.text for e in library.sensors],
        "faults": [_called(entry) for entry in library.faults.values()],
    }
    for what, names in parts.items():
        if names:
            out.line(f"    {what}: {', '.join(names)}")


def _called(fault: FaultEntry) -> str:
    """A fault as a script has to ask for it: its name, and its parameters."""
    parameters = ", ".join(fault.signature.types)
    return f"{fault.name}({parameters})" if parameters else fault.name
