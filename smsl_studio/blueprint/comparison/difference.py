"""A difference as frozen values, for lists, pictures, rules and scripts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.values import said
from smsl_studio.blueprint.drawn import GROUPS, NOTES
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place

Json = Any
Path = tuple[str, ...]
_TOLD = 5
"""The largest number of fields without meaning that the sentence names."""


class ChangeKind(Enum):
    """The kinds of changes of an element."""

    REMOVED = "removed"
    RENAMED = "renamed"
    RETARGETED = "retargeted"
    CHANGED = "changed"
    ADDED = "added"


@dataclass(frozen=True)
class Change:
    """One change.

    ``what`` is the kind of element: ``branch``, ``state``, ``operation``, ``header``, ``fact``,
    ``note``, ``hazard``, ``property``, ``level``, ``import``, ``field`` or ``order``. ``before``
    and ``after`` are the addresses of its element on both sides, None if there is none. ``field``
    is the key that changed. ``old`` and ``new`` are its values, or the names after a renaming, or
    the targets after a retargeting. The paths lead to its place in the text of each side.
    """

    kind: ChangeKind
    what: str
    before: Address | None
    after: Address | None
    words: str
    field: str = ""
    old: Json = None
    new: Json = None
    path_before: Path = ()
    path_after: Path = ()

    @property
    def address(self) -> Address | None:
        """The address on the later side, or on the earlier side if the element was removed."""
        return self.after or self.before

    def as_json(self) -> dict[str, Json]:
        """Return the change as plain values. Addresses are texts. The places in the files are left
        out.
        """
        return {
            "kind": self.kind.value,
            "what": self.what,
            "before": None if self.before is None else str(self.before),
            "after": None if self.after is None else str(self.after),
            "field": self.field or None,
            "old": self.old,
            "new": self.new,
            "words": self.words,
        }


@dataclass(frozen=True, eq=False)
class Difference:
    """All changes between two blueprints, in the order of the files.

    ``moved`` are the states (on the later side) with moved boxes, ``redrawn`` the operations with
    other bends, or with their label elsewhere. ``pinned`` are the states that were pinned or
    unpinned. ``states`` has, for each SB on
    both sides, the new names of its renamed states. ``branches`` has the new names of renamed SBs.
    ``fields`` are the ``_`` fields without a meaning that differ, such as ``_comment``. Like the
    layout, they are no changes.
    """

    before: Blueprint
    after: Blueprint
    changes: tuple[Change, ...] = ()
    moved: tuple[Address, ...] = ()
    redrawn: tuple[Address, ...] = ()
    branches: Mapping[str, str] = field(default_factory=dict)
    states: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    fields: tuple[Change, ...] = ()
    pinned: tuple[Address, ...] = ()

    @property
    def has_new_layout(self) -> bool:
        """Whether boxes were moved, lines redrawn or states pinned or unpinned."""
        return bool(self.moved or self.redrawn or self.pinned)

    @property
    def same(self) -> bool:
        """Whether nothing differs, not even layout and fields without meaning."""
        return not (self.changes or self.has_new_layout or self.fields)

    @property
    def same_meaning(self) -> bool:
        """Whether nothing differs except layout and fields without meaning."""
        return not self.changes

    @property
    def layout_only(self) -> bool:
        """Whether only boxes were moved, lines redrawn, or states pinned or unpinned."""
        return self.has_new_layout and not (self.changes or self.fields)

    def count(self, kind: ChangeKind) -> int:
        """Return the number of changes of one kind."""
        return Counter(change.kind for change in self.changes)[kind]

    def place_before(self, change: Change) -> Place | None:
        """Return the place of a change in the earlier text, None for an addition."""
        return _place(self.before, change.path_before)

    def place_after(self, change: Change) -> Place | None:
        """Return the place of a change in the later text, None for a removal."""
        return _place(self.after, change.path_after)

    @property
    def words(self) -> str:
        """The difference in one sentence."""
        if self.same:
            return "No difference."
        if self.layout_only:
            return f"Layout only: {self._layout_differs}."
        if self.same_meaning:
            layout = f"; {self._layout_differs}" if self.has_new_layout else ""
            return f"Same meaning: only {self._fields_differ}{layout}."
        parts = [f"{self.count(kind)} {kind.value}" for kind in ChangeKind if self.count(kind)]
        boxes = f"; {len(self.moved)} moved in the layout" if self.moved else ""
        boxes += f"; {len(self.redrawn)} redrawn" if self.redrawn else ""
        boxes += f"; {len(self.pinned)} pinned or unpinned" if self.pinned else ""
        fields = f"; beside the meaning {self._fields_differ}" if self.fields else ""
        total = len(self.changes)
        return f"{total} change{'' if total == 1 else 's'}: {', '.join(parts)}{boxes}{fields}."

    @property
    def _layout_differs(self) -> str:
        """How many states were moved, operations redrawn, and states pinned or unpinned."""
        moved, redrawn, pinned = len(self.moved), len(self.redrawn), len(self.pinned)
        states = "1 state was" if moved == 1 else f"{moved} states were"
        lines = "1 operation was" if redrawn == 1 else f"{redrawn} operations were"
        pins = "1 state was" if pinned == 1 else f"{pinned} states were"
        told = [f"{states} moved"] * bool(moved) + [f"{lines} redrawn"] * bool(redrawn)
        told += [f"{pins} pinned or unpinned"] * bool(pinned)
        return ", ".join(told)

    @property
    def _fields_differ(self) -> str:
        """How many notes and groups differ, and the names of other fields without meaning."""
        counts = Counter(map(_subject, self.fields))
        names = [
            said(one) if one.startswith("_") else f"1 {one}" if count == 1 else f"{count} {one}s"
            for one, count in counts.items()
        ]
        if len(names) == 1:
            one_only = names[0].startswith(("_", "1 "))
            return f"{names[0]} {'differs' if one_only else 'differ'}"
        told, left = names[:_TOLD], len(names) - _TOLD
        last = f"{left} more" if left > 0 else told.pop()
        return f"{', '.join(told)} and {last} differ"

    def as_json(self) -> dict[str, Json]:
        """Return the whole difference as plain values. Each change has its places in both files."""
        return {
            "before": self.before.file,
            "after": self.after.file,
            "same": self.same,
            "same_meaning": self.same_meaning,
            "layout_only": self.layout_only,
            "moved": len(self.moved),
            "redrawn": len(self.redrawn),
            "pinned": len(self.pinned),
            "changes": [self._with_places(change) for change in self.changes],
            "fields": [self._with_places(change) for change in self.fields],
        }

    def _with_places(self, change: Change) -> dict[str, Json]:
        return {
            **change.as_json(),
            "place_before": _line_and_column(self.place_before(change)),
            "place_after": _line_and_column(self.place_after(change)),
        }


def _subject(change: Change) -> str:
    """Return ``note`` or ``group`` for what is on the drawing, else the name of the field."""
    path = change.path_after or change.path_before
    for table, word in ((NOTES, "note"), (GROUPS, "group")):
        if len(path) > 1 and path[-2] == table:
            return word
    return change.field if change.field.startswith("_") else f"_{change.field}"


def _place(blueprint: Blueprint, path: Path) -> Place | None:
    return blueprint.home(path[0]).place(path) if path else None


def _line_and_column(place: Place | None) -> Json:
    if place is None:
        return None
    return {"file": place.file, "line": place.line, "column": place.column}
