"""Blueprints, plugins and logs with which a phase lasts for seconds."""

from __future__ import annotations

import json
from itertools import product
from pathlib import Path
from typing import Any

from smsl_studio.cli import main

STATES = 120_000
"""States of the large file, which is as large as a file may be: some 13 MB of JSON."""
SBS = 400
"""SBs of the wide file."""
STEPS = 4_900
"""Operations of the long run."""

STALL = """
import os, time

HOW = os.environ.get("STALL", "")


def reached():
    with open("reached", "a") as file:
        file.write(f"{os.getpid()}\\n")


def spin():
    while True:
        pass


if HOW == "describing":
    reached()
    time.sleep(600)


def register(library):
    @library.world("stall", engine="table")
    def build(world, blueprint, seed):
        if HOW == "building":
            reached()
            spin()

    @library.sensor("step", fact="1", period=1 / 240)
    def step(world):
        if HOW == "sensing" and os.path.exists("begun"):
            reached()
            time.sleep(600)
        return "0"

    @library.operation("Walk", timeout=1e9)
    def walk(world):
        with open("begun", "w"):
            pass
        if HOW in ("operation", "hanging", "braking"):
            reached()
        if HOW == "hanging":
            spin()
        try:
            while True:
                yield
        finally:
            if HOW == "braking":
                spin()
"""


def flat(states: int) -> dict[str, Any]:
    """One SB with three operations out of each state."""
    name = [f"State_{number:06}" for number in range(states)]
    table: dict[str, Any] = {"HEADER": {"INITIAL": name[0], "ACTIVATING": name[-1], "NUM_FACTS": 1}}
    for number, state in enumerate(name):
        table[state] = {f"Op_{k}": name[(number + 1 + k * k) % states] for k in range(3)}
    return {"SB1": table}


def line(states: int) -> dict[str, Any]:
    """One SB that is gone through from end to end."""
    name = [f"State_{number:06}" for number in range(states)]
    table: dict[str, Any] = {"HEADER": {"INITIAL": name[0], "ACTIVATING": name[-1], "NUM_FACTS": 1}}
    for here, there in zip(name, [*name[1:], None], strict=True):
        table[here] = {"On": there} if there else {}
    return {"SB1": table}


def wide(sbs: int) -> dict[str, Any]:
    """Many SBs of two states."""
    one = {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"On": "State_1"},
        "State_1": {"Off": "State_0"},
    }
    return {f"SB{number}": one for number in range(sbs)}


def cube(subs: int, size: int) -> dict[str, Any]:
    """A base whose sub-SBs, each a line that goes both ways, require facts of each other."""
    header = {
        "INITIAL": "State_" + "0" * subs,
        "ACTIVATING": "State_" + "1" * subs,
        "NUM_FACTS": subs,
        "SUB_SBS": {f"S{number}": number for number in range(subs)},
    }
    base: dict[str, Any] = {"HEADER": header}
    for bits in product("01", repeat=subs):
        state = "".join(bits)
        flipped = {k: "1" if state[k] == "0" else "0" for k in range(subs)}
        base[f"State_{state}"] = {
            f"Turn{k}": f"State_{state[:k]}{flipped[k]}{state[k + 1 :]}" for k in range(subs)
        }
    found: dict[str, Any] = {"BASE": base}
    for number in range(subs):
        sub: dict[str, Any] = {
            "HEADER": {"INITIAL": "State_0", "ACTIVATING": f"State_{size - 1}", "NUM_FACTS": 1}
        }
        for place in range(size):
            ways = {"Up": place + 1, "Down": place - 1}
            sub[f"State_{place}"] = {
                name: f"State_{there}" for name, there in ways.items() if 0 <= there < size
            }
        needed = {f"S{(number + 1) % subs}/0": str(number * 7 % (size - 1))}
        sub["_operations"] = {f"State_{size // 2}/Up": {"requires": needed}}
        found[f"S{number}"] = sub
    return found


WALK = {
    "WALK": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"Walk": "State_1"},
        "State_1": {},
    }
}
HUMAN = {
    "WALK": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "_operations": {"Walk": {"actor": "human"}},
        "State_0": {"Walk": "State_1"},
        "State_1": {},
    }
}
ANSWER = {"do": "answer", "option": "done", "after": 1e6}
LOST = {"at": 0.01, "do": "inject", "fault": "set", "fact": "SB7/0", "value": "1"}


def make(folder: Path) -> None:
    """Write all of them, once."""
    for name, values in (
        ("flat.json", flat(STATES)),
        ("line.json", line(STEPS)),
        ("wide.json", wide(SBS)),
        ("cube.json", cube(6, 6)),
        ("walk.json", WALK),
        ("human.json", HUMAN),
    ):
        (folder / name).write_text(json.dumps(values, indent=1), "utf-8")
    for name, act in (("answer.jsonl", ANSWER), ("lost.jsonl", LOST)):
        (folder / name).write_text(json.dumps(act) + "\n", "utf-8")
    plugin = folder / "plugins" / "stall"
    plugin.mkdir(parents=True)
    (plugin / "plugin.toml").write_text('name = "stall"\nversion = "1"\n', "utf-8")
    (plugin / "plugin.py").write_text(STALL, "utf-8")
    _quietly("convert", str(folder / "flat.json"), "-o", str(folder / "flat.smsl"))
    _quietly("run", str(folder / "line.json"), "--world", "table", "--log",
             str(folder / "line.jsonl"))  # fmt: skip


def _quietly(*command: str) -> None:
    import contextlib
    import io

    with contextlib.redirect_stdout(io.StringIO()):
        assert main(command) == 0, command
