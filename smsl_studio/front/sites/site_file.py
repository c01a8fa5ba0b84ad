"""The site file, ``site.toml``: the nodes of a room, which facts each of them tells, and a plan.

::

    site = "or-2"
    run = "main"

    [room]
    size = [9.0, 5.6]
    sterile = [3.0, 1.1, 5.0, 3.6]

    [node.tray-reader]
    title = "Tray reader"
    kind = "instrument"
    program = "tag_reader.py"
    draws = "tray"
    place = [7.3, 3.3]
    facts = {"DRILL_OUT/0" = ["tag_drill", "tags_read"]}

    [person.surgeon]
    title = "Surgeon"
    place = [5.4, 3.3]
    here = "SURGEON/0 surgeons"
    sterile = "STERILE/0 sterile"

Lengths are in metres, from the left upper corner of the room. A person is drawn as present if the
source ``here`` counts at least ``least`` persons (1 if nothing is said).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.blueprint.address import split_fact
from smsl_studio.errors import Place, PluginError
from smsl_studio.library.toml_text import TomlText, read_toml
from smsl_studio.monitor.bus import SourceKey
from smsl_studio.monitor.topics import FactTopic

FILE = "site.toml"
LARGEST = 1_000_000
"""The largest size of a site file, in bytes."""
MOST_NODES = 256
RESERVED = ("authority", "broker", "studio")
"""Names that no node may have, because a site has files of these names."""
KINDS = ("device", "instrument", "team", "person")
"""What nodes are about: the four kinds of the paper."""

_NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,62}")
_ADVICE = (
    'Write [node.NAME] with title, kind, program, place and facts = {"SB/digit" = ["source"]}.'
)

Metres = Annotated[float, Field(ge=-1000, le=1000, allow_inf_nan=False)]
Spot = tuple[Metres, Metres]


class _SitePart(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class SiteRoom(_SitePart):
    """The room: its size, the sterile zone (x, y, width, depth) and the door, in metres."""

    size: tuple[Annotated[float, Field(gt=0, le=1000)], Annotated[float, Field(gt=0, le=1000)]] = (
        9.0,
        5.6,
    )
    sterile: tuple[Metres, Metres, Metres, Metres] | None = None


class SitePerson(_SitePart):
    """A person on the plan: a role, and never a name.

    ``here`` and ``sterile`` are sources, as ``SB/digit source``, that count persons.
    """

    title: str = Field(max_length=60)
    place: Spot
    here: str = ""
    least: int = Field(1, ge=1, le=100)
    sterile: str = ""
    least_sterile: int = Field(1, ge=1, le=100)


class SiteNode(_SitePart):
    """A node: who it is, what it tells, the program that plays it, and where its thing stands."""

    title: str = Field(max_length=60)
    kind: Literal["device", "instrument", "team", "person"]
    program: str = ""
    draws: str = Field("", max_length=20)
    place: Spot = (0.0, 0.0)
    reach: Annotated[float, Field(ge=0, le=1000)] = 0.0
    """How far the node reads, in metres. 0 if that is not drawn."""
    tags: int = Field(0, ge=0, le=20)
    """How many tags lie in a tray that it reads."""
    rate: Annotated[float, Field(gt=0, le=1000)] = 10.0
    """How many samples of each source it sends in a second."""
    facts: dict[str, str | tuple[str, ...]] = {}

    @property
    def sources(self) -> tuple[SourceKey, ...]:
        """The sources that it speaks for: SB, digit, name."""
        found: list[SourceKey] = []
        for key, said in self.facts.items():
            fact = split_fact(key)
            assert fact is not None, "read_site has seen this key"
            found += [(*fact, name) for name in ((said,) if isinstance(said, str) else said)]
        return tuple(found)


class _SiteFile(_SitePart):
    site: str = Field("local", min_length=1, max_length=200)
    run: str = Field("main", min_length=1, max_length=200)
    room: SiteRoom = SiteRoom()
    node: dict[str, SiteNode] = Field({}, max_length=MOST_NODES)
    person: dict[str, SitePerson] = Field({}, max_length=MOST_NODES)


@dataclass(frozen=True)
class Site:
    """A site: its folder, its name, the name of its run, its nodes, its room and its persons."""

    folder: Path
    name: str = "local"
    run: str = "main"
    nodes: Mapping[str, SiteNode] = field(default_factory=dict)
    room: SiteRoom = field(default_factory=SiteRoom)
    persons: Mapping[str, SitePerson] = field(default_factory=dict)
    text: TomlText = field(default_factory=lambda: TomlText("", ()))

    def topics(self, node: str) -> tuple[str, ...]:
        """Return the topics on which a node may tell facts."""
        keys = self.nodes[node].sources
        return tuple(str(FactTopic(self.name, self.run, *key)) for key in keys)

    @property
    def speakers(self) -> dict[SourceKey, str]:
        """The node that speaks for each source."""
        return {key: name for name, node in self.nodes.items() for key in node.sources}

    def place(self, key: str) -> Place:
        """Return the place of a key in the file."""
        return self.text.place(key)


def read_site(folder: Path, inside: str = "") -> Site:
    """Read the site file of a folder. PluginError, with its place, if it is not valid."""
    return read_site_file(folder / FILE, inside)


def read_site_file(path: Path, inside: str = "") -> Site:
    """Read a site file, which must lie below the folder ``inside`` if that is given (see
    ``read_site``)."""
    text, values = read_toml(path, LARGEST, inside)
    try:
        said = _SiteFile.model_validate(values)
    except ValidationError as error:
        raise _fault(text, error.errors(include_url=False)[0]) from None
    spoken: dict[SourceKey, str] = {}
    for name, node in said.node.items():
        place = text.place(name)
        if not _NAME.fullmatch(name) or name in RESERVED:
            words = f"{name!r} is no name for a node"
            advice = f"Take small letters, digits, - and _, and none of {', '.join(RESERVED)}."
            raise PluginError(words, place, advice)
        for key in node.facts:
            if split_fact(key) is None:
                raise PluginError(f"{key!r} is no fact", text.place(key), "Write SB/digit.")
        for source in node.sources:
            if not source[2]:
                raise PluginError(f"{name} has a source without a name", place, _ADVICE)
            other = spoken.setdefault(source, name)
            if other != name:
                words = f"{source[2]} of {source[0]}/{source[1]} belongs to {other} and {name}"
                raise PluginError(words, place, "One node speaks for a source.")
    return Site(path.parent, said.site, said.run, said.node, said.room, said.person, text)


def _fault(text: TomlText, fault: Any) -> PluginError:
    parts = [str(part) for part in fault["loc"]]
    known = next((text.place(p) for p in reversed(parts) if text.has(p)), text.place(""))
    return PluginError(f"{'.'.join(parts)}: {fault['msg']}", known, _ADVICE)
