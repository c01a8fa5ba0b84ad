"""The bindings file, ``<stem>.toml`` beside a blueprint: it names the code for each world.

::

    [world.hanoi.operations]
    "Op_x" = {function = "hanoi.move_disk", disk = 1, peg = "a"}
    "State_aaa/Op_x" = {function = "hanoi.move_disk", disk = 2, peg = "a"}

    [world.hanoi.facts]
    "SB1/0" = "disk_1_peg"

    [mqtt]
    broker = "localhost:1883"
    site = "lab"
    run = "main"
    login = "keys/studio.toml"
    room = "site.toml"

    [mqtt.facts]
    "SB1/1" = ["camera", "scale"]

Operations are named as ``Operation``, ``State/Operation`` or ``SB/State/Operation``. Facts are
named as ``SB/digit``, with digits counted from 0. A ``/`` inside a name is written ``~1``, and a
``~`` is written ``~0``. Each key except ``function`` is an argument. ``mqtt`` names facts that
remote sensors read, in every world.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from smsl_studio.blueprint.project import project_of, real_path, refusal_of_place
from smsl_studio.errors import Place, PluginError
from smsl_studio.library.toml_text import TomlText, read_toml


class BoundFunction(BaseModel):
    """A function by its full name (``plugin.function``). Every other key is an argument."""

    model_config = ConfigDict(frozen=True, extra="allow")

    function: str

    @property
    def arguments(self) -> dict[str, Any]:
        """The arguments of the function in the file, by name."""
        return dict(self.__pydantic_extra__ or {})


class WorldTable(BaseModel):
    """The bindings of one world: operations to functions, facts to sensors."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    operations: dict[str, BoundFunction] = {}
    facts: dict[str, str | tuple[str, ...]] = {}


class MqttTable(BaseModel):
    """The facts that remote sensors read, with their sources, and the address of the broker.

    An empty ``broker`` means that the file names none. ``login`` is a login file and ``room`` a
    site file, relative to the bindings file; both may be empty.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    broker: str = ""
    site: str = "local"
    run: str = "main"
    login: str = ""
    room: str = ""
    facts: dict[str, str | tuple[str, ...]] = {}

    def sources(self, key: str) -> tuple[str, ...]:
        """Return the names of the sources of a fact. ``key`` is ``SB/digit``."""
        given = self.facts.get(key, ())
        return (given,) if isinstance(given, str) else given


class _BindingsFile(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")

    world: dict[str, WorldTable] = {}
    mqtt: MqttTable = MqttTable()


@dataclass(frozen=True, slots=True)
class BindingsFile:
    """The content of a bindings file. It is empty if a blueprint has no bindings file."""

    worlds: Mapping[str, WorldTable] = field(default_factory=dict)
    text: TomlText = field(default_factory=lambda: TomlText("", ()))
    mqtt: MqttTable = field(default_factory=MqttTable)

    def of(self, world: str) -> WorldTable:
        """Return the bindings of a world."""
        return self.worlds.get(world) or WorldTable()

    def place(self, key: str) -> Place | None:
        """Return the place of a key in the file. None if there is no file."""
        return self.text.place(key) if self.text.file else None


def bindings_beside(blueprint_file: str) -> BindingsFile:
    """Read the bindings file beside a blueprint; it is empty if there is no file.

    PluginError if the file is invalid, or if it is a link that leads out of the blueprint's
    project.
    """
    path = Path(blueprint_file)
    if not path.suffix or path.suffix == ".toml":
        return BindingsFile()
    beside = path.with_suffix(".toml")
    if not os.path.lexists(beside):
        return BindingsFile()
    project = project_of(blueprint_file)
    refusal = refusal_of_place(real_path(str(beside)), project, "the bindings file", (".toml",))
    if refusal is not None:
        raise PluginError(refusal.sentence, Place(str(beside), 1, 1), refusal.advice)
    return read_bindings(beside, project)


_WORLD = 'Write [world.NAME.operations] with "Op" = {function = "plugin.function", ...}.'
_MQTT = (
    "Write [mqtt] with broker, site, run, login and room, "
    'and [mqtt.facts] with "SB/digit" = "source".'
)


def read_bindings(path: Path, project: str = "") -> BindingsFile:
    """Read a bindings file, which must lie below ``project`` if that is given. PluginError if it
    is invalid.

    Rules of a blueprint have the same suffix, and often the same name. They bind nothing.
    """
    text, values = read_toml(path, inside=project)
    if {"facts", "rule"} <= values.keys() and values.keys().isdisjoint(_BindingsFile.model_fields):
        return BindingsFile(text=text)
    try:
        file = _BindingsFile.model_validate(values)
        return BindingsFile(file.world, text, file.mqtt)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        parts = [str(part) for part in fault["loc"]]
        known = next((text.place(p) for p in reversed(parts) if text.has(p)), text.place(""))
        raise PluginError(
            f"{'.'.join(parts)}: {fault['msg']}",
            known,
            _MQTT if parts[0] == "mqtt" else _WORLD,
        ) from None
