"""``worlds``: lists the worlds and their plugins."""

from __future__ import annotations

import argparse
from typing import Any

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.output import Output
from smsl_studio.cli.plugins import fault_as_json, print_waiting, waiting_as_json
from smsl_studio.host.plugin_offers import describe
from smsl_studio.legible import one_line
from smsl_studio.world.engines import REMOTE, TABLE


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``worlds``."""
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Print every world, then the plugins that were not loaded, with the reasons."""
    loaded = describe()
    worlds = [_built_in(TABLE, TABLE)]
    for plugin in loaded.plugins:
        for entry in plugin.library.worlds.values():
            worlds.append(
                {
                    "name": entry.name,
                    "engine": entry.engine,
                    "hardware": entry.hardware,
                    "plugin": plugin.name,
                    "location": plugin.location,
                    "robots": list(loaded.robots(entry.name)),
                }
            )
    worlds.append(_built_in(REMOTE, "a program elsewhere"))
    if options.format == "json":
        faults = [fault_as_json(fault) for fault in loaded.faults]
        waiting = [waiting_as_json(found) for found in loaded.waiting]
        out.json({"worlds": worlds, "faults": faults, "waiting": waiting})
        return 0
    for world in worlds:
        origin = f"{world['plugin']}, {world['location']}" if world["plugin"] else "built in"
        hardware = ", hardware" if world["hardware"] else ""
        out.line(one_line(f"{world['name']}: engine {world['engine']}{hardware} ({origin})"))
        if world["robots"]:
            out.line(one_line(f"    robots: {', '.join(world['robots'])}"))
    for found in loaded.waiting:
        print_waiting(found, out)
    for fault in loaded.faults:
        out.line(one_line(str(fault)))
    return 0


def _built_in(name: str, engine: str) -> dict[str, Any]:
    return {
        "name": name,
        "engine": engine,
        "hardware": False,
        "plugin": None,
        "location": None,
        "robots": [],
    }
