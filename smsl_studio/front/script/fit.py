"""Checks that a world has the faults that a script injects, with these parameters.

Without this check a script with an unknown fault would run to its end as if the fault had been
tried.
"""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.errors import PluginError, ReadError, did_you_mean
from smsl_studio.front.script.script import Act, Script
from smsl_studio.library.entries import FaultEntry


def check_faults(script: Script, world: str, offered: Mapping[str, FaultEntry]) -> None:
    """Raise ReadError for all lines with a fault or parameters that the world does not have."""
    wrong = [_fault(act, world, offered) for act in script.acts if act.do == "inject"]
    faults = [fault for fault in wrong if fault is not None]
    if faults:
        raise ReadError.of(faults)


def _fault(act: Act, world: str, offered: Mapping[str, FaultEntry]) -> ReadError | None:
    name = act.given["fault"]
    place = act.places.get("fault", act.place)
    entry = offered.get(name)
    if entry is None:
        there = f"It has {', '.join(offered)}." if offered else "It has none."
        near = did_you_mean(name, offered)
        return ReadError(f"the world {world!r} has no fault {name!r}", place, near or there)
    try:
        entry.signature.checked({key: act.given[key] for key in act.given if key != "fault"})
    except PluginError as error:
        takes = ", ".join(entry.signature.types) or "nothing"
        return ReadError(
            f"the fault {name}: {error.sentence}", place, error.advice or f"It takes {takes}."
        )
    return None
