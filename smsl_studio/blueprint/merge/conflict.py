"""A conflict: one thing that both sides changed in different ways."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

from smsl_studio.blueprint.address import Address, escape
from smsl_studio.blueprint.comparison.values import said
from smsl_studio.blueprint.reading import HEADER

Json = Any
Path = tuple[str, ...]
KEY = "_conflicts"
NAME = "name"
"""The last key of the path of a conflict about a name: ``SB/State`` and ``name``."""


class _Missing(Enum):
    """The value of what a version does not have. A copy of it is the same object."""

    ABSENT = "absent"


ABSENT = _Missing.ABSENT
"""The value of what a version does not have. JSON shows it as null."""


@dataclass(frozen=True)
class Attachment:
    """What stands elsewhere in the file and belongs to a conflict, such as the title of a state
    that one side deleted. It has a path and a value for each version."""

    path: Path
    base: Json
    ours: Json
    theirs: Json

    def is_equal_everywhere(self) -> bool:
        """Whether no side has another value than the others."""
        return bool(self.base == self.ours == self.theirs)


@dataclass(frozen=True)
class Conflict:
    """One place of the file (``path``) with its three values. ABSENT is the value of a version
    that does not have it.

    ``about_name`` says that both sides gave an SB or a state another name. Then the values are the
    names. ``parts`` follow the choice: they belong to the same element. ``base_known`` is False if
    the two sides were merged without the version that they come from.
    """

    path: Path
    base: Json
    ours: Json
    theirs: Json
    about_name: bool = False
    parts: tuple[Attachment, ...] = ()
    base_known: bool = True

    @property
    def address(self) -> str:
        """The element of the conflict: ``SB``, ``SB/State``, ``SB/State/Operation``, or for what
        stands at file level the key and the name below it, such as ``_hazards/NAME``."""
        return address_of(self.path)

    @property
    def words(self) -> str:
        """The conflict as a part of a sentence: what it is about, and what the sides say."""
        what = "its name" if self.about_name else " ".join(self.path[len(self._own_path) :])
        sides = f"mine is {_told(self.ours)}, theirs is {_told(self.theirs)}"
        return f"{what}, {sides}" if what else sides

    @property
    def _own_path(self) -> Path:
        """The keys of the path that the address says already."""
        if self.path[0].startswith("_"):
            return self.path[:2]
        below = self.path[1:2]
        if below and below[0] in ("_states", "_operations"):
            return self.path[:3]
        return (
            self.path[:1]
            if below and (below[0][:1] == "_" or below[0] == HEADER)
            else (self.path[:3])
        )

    def as_json(self) -> dict[str, Json]:
        """Return the conflict as the command line prints it, with null for ABSENT."""
        values = {"base": self.base, "ours": self.ours, "theirs": self.theirs}
        told = {key: None if value is ABSENT else value for key, value in values.items()}
        more = {"about": NAME} if self.about_name else {}
        return {"address": self.address, **told, "path": list(self.path), **more}


def _told(value: Json) -> str:
    return "removed" if value is ABSENT else said(value)


def address_of(path: Path) -> str:
    """Return the address of the element that a path of the file belongs to."""
    if path[0].startswith("_"):
        return "/".join(map(escape, path[:2]))
    branch, *below = path
    if not below or below[0] == HEADER:
        return str(Address(branch))
    if not below[0].startswith("_"):
        names = [name for name in below[:2] if not name.startswith("_")]
        return str(Address(branch, *names))
    if below[0] == "_states" and len(below) > 1:
        return str(Address(branch, below[1]))
    if below[0] == "_operations" and len(below) > 1:
        edge = Address.split(below[1])
        if len(edge) == 2:
            return str(Address(branch, *edge))
    return str(Address(branch))
