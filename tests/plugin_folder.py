"""Plugin folders written by tests, and small blueprints to run with them."""

from __future__ import annotations

import json
from pathlib import Path
from textwrap import dedent
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.inputs import read_bytes
from smsl_studio.library.permission import allow
from smsl_studio.library.survey import FoundPlugin, survey


def write_plugin(folder: Path, name: str, code: str, **others: str) -> Path:
    """A plugin folder ``folder/name`` with this ``plugin.py`` and other modules."""
    place = folder / name
    place.mkdir(parents=True)
    (place / "plugin.toml").write_text(f'name = "{name}"\n', "utf-8")
    (place / "plugin.py").write_text(dedent(code), "utf-8")
    for module, text in others.items():
        (place / f"{module}.py").write_text(dedent(text), "utf-8")
    return place


def found_plugin(name: str) -> FoundPlugin:
    """What is found of a plugin without running it."""
    (found,) = (found for found in survey() if found.name == name)
    return found


def write_allowed(home: Path, name: str, code: str, **others: str) -> Path:
    """A plugin in the user's folder, allowed as it stands now."""
    place = write_plugin(home / "plugins", name, code, **others)
    allow(found_plugin(name))
    return place


def blueprint_of(values: dict[str, Any], file: str = "test.json") -> Blueprint:
    """A blueprint of plain values."""
    return read_bytes(json.dumps(values, indent=4).encode(), file)


SHIPPED = ("chess", "hanoi", "registration", "river")
"""The plugins that ship with the program, in their order."""

LAMP = {
    "LAMP": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"Op_on": "State_1", "Op_break": "State_1", "Op_spin": "State_1"},
        "State_1": {"Op_off": "State_0"},
    }
}
"""One fact, and operations for ``LAMP_PLUGIN``."""

LAMP_PLUGIN = """
import itertools


def register(library):
    @library.world("lamp", engine="table", settle=0.1)
    def build(world, blueprint, seed):
        print("built")
        world.set_facts({("LAMP", 0): "0"})

    @library.arrange("lamp")
    def arrange(world, facts):
        world.set_facts(facts)

    @library.sensor("bulb_{n}", fact="{n}", period=0.1)
    def bulb(world, n: int):
        return world.fact("LAMP", n - 1)

    @library.operation("Op_{to}", timeout=5.0)
    def switch(world, to: str):
        print("switching")
        yield
        yield
        world.set_facts({("LAMP", 0): "1" if to == "on" else "0"})

    @library.operation("Op_break", stop="abort")
    def smash(world):
        yield
        raise RuntimeError("the bulb broke")

    @library.operation("Op_spin")
    def spin(world):
        yield
        for _ in itertools.count():
            pass

    @library.operation()
    def refuse(world, times: int = 1):
        for _ in range(times):
            yield
        return False
"""
