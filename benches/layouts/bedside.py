"""The procedure of the dense picture: a tool at a bed, four facts, 16 states, a sub-SB."""

from __future__ import annotations

from itertools import product
from typing import Any

Json = Any

_FACTS = (
    ("Clamp fixed", "open", "fixed", "clamp_force", "FixClamp", "OpenClamp"),
    ("Tracker sees bed", "blind", "sees", "tracker_rms", "StartTracker", "StopTracker"),
    ("Tool mounted", "empty", "in", "", "MountTool", "RemoveTool"),
    ("Drape sealed", "loose", "sealed", "drape_pressure", "SealDrape", "LoosenDrape"),
)
_TITLES = {
    "0000": "Nothing ready",
    "0110": "Tracker and tool",
    "1010": "Clamp and tool",
    "0010": "Tool alone",
    "1110": "All but the drape",
    "0111": "All but the clamp",
    "1011": "All but the tracker",
    "1111": "Ready with tool",
}


def bedside() -> Json:
    """The file: a group, a note, a bent line and a fact with a sub-SB, as the design draws them."""
    names = ["".join(bits) for bits in product("01", repeat=4)]
    states: dict[str, dict[str, str]] = {f"State_{name}": _ways(name) for name in names}
    states["State_1111"]["Op_Recheck"] = "State_1111"
    states["State_1100"]["Op_CheckClamp"] = "State_1100"
    states["State_0110"]["Op_LoadPreset"] = "State_1111"
    states["State_0000"]["Op_FixClampByHand"] = "State_1000"
    header = {
        "INITIAL": "State_0000",
        "ACTIVATING": "State_1111",
        "NUM_FACTS": 4,
        "SUB_SBS": {"TOOLCHANGE": 2},
    }
    annotations = {
        "_facts": {str(at): _fact(*row[:4]) for at, row in enumerate(_FACTS)},
        "_states": {f"State_{name}": {"title": title} for name, title in _TITLES.items()},
        "_layout": _layout(names),
        "_notes": {
            "1": {
                "text": "The drape sensor drifts when warm. Ask the clinic for a second reading.",
                "author": "R. Stein",
                "date": "2026-11-12",
                "at": [664, -276],
            }
        },
    }
    return {
        "BEDSIDE": {"HEADER": header, **states, **annotations},
        "TOOLCHANGE": {
            "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
            "State_0": {"Op_LockGripper": "State_1"},
            "State_1": {"Op_UnlockGripper": "State_0"},
        },
    }


def _ways(name: str) -> dict[str, str]:
    """Each fact may be turned over; from two facts on, all can be given up at once."""
    ways = {}
    for at, (*_, forth, back) in enumerate(_FACTS):
        turned = name[:at] + ("1" if name[at] == "0" else "0") + name[at + 1 :]
        if name[at] == "0" or at < 3:
            ways[f"Op_{forth if name[at] == '0' else back}"] = f"State_{turned}"
    if name.count("1") > 1:
        ways["Op_Replan"] = "State_0000"
    return ways


def _fact(name: str, off: str, on: str, sensor: str) -> Json:
    sensors = {"sensors": [sensor]} if sensor else {}
    return {"name": name, "values": {"0": off, "1": on}} | sensors


def _layout(names: list[str]) -> Json:
    columns: list[list[str]] = [[], [], [], [], []]
    for name in sorted(names, reverse=True):
        columns[name.count("1")].append(name)
    places: Json = {}
    for at, column in enumerate(columns):
        for row, name in enumerate(column):
            places[f"State_{name}"] = [(at - 2) * 216, round((row - (len(column) - 1) / 2) * 104)]
    lacking = [f"State_{name}" for name in columns[3]]
    places["_groups"] = {"1": {"title": "One fact missing", "states": lacking}}
    places["_operations"] = {"State_0110/Op_LoadPreset": {"bends": [[150, 14], [300, 20]]}}
    return places
