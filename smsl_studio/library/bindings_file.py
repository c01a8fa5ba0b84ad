"""``<stem>.toml`` beside a blueprint: which code carries it out in which world.

::

    [world.hanoi.operations]
    "Op_x" = {function = "hanoi.move_disk", disk = 1, peg = "a"}
    "State_aaa/Op_x" = {function = "hanoi.move_disk", disk = 2, peg = "a"}

    [world.hanoi.facts]
    "SB1/0" = "disk_1_peg"

Operations are named as ``Operation``, ``State/Operation`` or ``SB/State/Operation``; facts as
``SB/digit``, counted from 0; a ``/`` in a name is written ``~1`` there and a ``~`` as ``~0``. What
is not ``function`` is an argument.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from smsl_studio.errors import Place, PluginError
from smsl_studio.library.toml_text import TomlText, read_toml


class BoundFunction(BaseModel):
    """A function by its full name; every other key is an argument."""

    model_config = ConfigDict(frozen=True, extra="allow")

    function: str

    @property
    def arguments(self) -> dict[str, Any]:
        return dict(self.__pydantic_extra__ or {})


class WorldTable(BaseModel):
    """What one world binds."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    operations: dict[str, BoundFunction] = {}
    facts: dict[str, str | tuple[str, ...]] = {}


class _File(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")

    world: dict[str, WorldTable] = {}


@dataclass(frozen=True, slots=True)
class BindingsFile:
    """A bindings file as read; empty where a blueprint has none."""

    worlds: Mapping[str, WorldTable] = field(default_factory=dict)
    text: TomlText = field(default_factory=lambda: TomlText("", ()))

    def of(self, world: str) -> WorldTable:
        """What is bound in a world."""
        return self.worlds.get(world) or WorldTable()

    def place(self, key: str) -> Place | None:
        """Where a key stands."""
        return self.text.place(key) if self.text.file else None


def bindings_beside(blueprint_file: str) -> BindingsFile:
    """The bindings file beside a blueprint, or an empty one; PluginError where it is broken."""
    path = Path(blueprint_file)
    if not path.suffix or path.suffix == ".toml":
        return BindingsFile()
    beside = path.with_suffix(".toml")
    return read_bindings(beside) if beside.is_file() else BindingsFile()


def read_bindings(path: Path) -> BindingsFile:
    """A bindings file; PluginError with its place where it is broken."""
    text, values = read_toml(path)
    try:
        return BindingsFile(_File.model_validate(values).world, text)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        parts = [str(part) for part in fault["loc"]]
        known = next((text.place(p) for p in reversed(parts) if text.has(p)), text.place(""))
        raise PluginError(
            f"{'.'.join(parts)}: {fault['msg']}",
            known,
            'Write [world.NAME.operations] with "Op" = {function = "plugin.function", ...}.',
        ) from None
