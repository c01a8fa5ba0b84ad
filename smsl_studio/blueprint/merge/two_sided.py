"""The merge of two versions whose base is not known: every difference is a conflict."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import IN_LAYOUT
from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.merge.conflict import ABSENT, KEY, Attachment, Conflict, Path
from smsl_studio.blueprint.merge.merge import Merge
from smsl_studio.blueprint.merge.trees import value_at
from smsl_studio.blueprint.merge.values import NAMED, equal
from smsl_studio.blueprint.merge.written import written_conflict
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.pins import PINNED
from smsl_studio.blueprint.reading import HEADER

Json = Any
LAYOUT = "_layout"
ENDS = ("INITIAL", "ACTIVATING")


def merge_without_base(ours: Blueprint, theirs: Blueprint) -> Merge:
    """Merge two versions by what they mean. The result is ``ours``, with every difference of
    meaning as an open conflict. The places of boxes are those of ``ours``."""
    found = tuple(_Differences(ours, theirs).all())
    if not found:
        return Merge(ours, ())
    draft = Draft(ours)
    entries = [written_conflict(one) for one in found]
    former = ours.document.values.get(KEY)
    draft.file()[KEY] = entries + (former if isinstance(former, list) else [])
    return Merge(draft.done(), found)


class _Differences:
    """Finds the differences of two files, from the whole to its parts."""

    def __init__(self, ours: Blueprint, theirs: Blueprint) -> None:
        self._blueprints = ours, theirs
        self._ours, self._theirs = ours.document.values, theirs.document.values
        self._told: set[Path] = set()

    def all(self) -> Iterator[Conflict]:
        """Yield the conflicts: first missing SBs and states, then single values."""
        values = self._ours, self._theirs
        branches = [key for key in _keys(*values) if not key.startswith("_")]
        for branch in branches:
            inner = [_map(one, branch) for one in values]
            if not all(branch in one for one in values):
                continue
            yield from self._ends(branch)
            for state in _keys(*inner):
                if _is_state(state) and sum(state in one for one in inner) == 1:
                    yield self._state(branch, state)
        for key in _keys(*values):
            if key != KEY:
                yield from self._below((key,), *(one.get(key, ABSENT) for one in values))

    def _ends(self, branch: str) -> Iterator[Conflict]:
        """The conflicts about the ends of an SB, by what the headers mean. What is written may
        leave an end to the order of the states, which differs."""
        for key in ENDS:
            path = (branch, HEADER, key)
            self._told.add(path)
            ours, theirs = (
                getattr(one.branches[branch], key.lower()) or ABSENT for one in self._blueprints
            )
            if ours != theirs:
                yield Conflict(path, ABSENT, ours, theirs, base_known=False)

    def _state(self, branch: str, state: str) -> Conflict:
        """The conflict of a state that one side alone has, with all that belongs to it."""
        parts = [Attachment(path, ABSENT, *self._values(path))
                 for path in dict.fromkeys(self._parts(branch, state))]  # fmt: skip
        told = tuple(one for one in parts if not equal(one.ours, one.theirs))
        path = (branch, state)
        self._told |= {path, *(one.path for one in told)}
        return Conflict(path, ABSENT, *self._values(path), parts=told, base_known=False)

    def _parts(self, branch: str, state: str) -> Iterator[Path]:
        yield branch, "_states", state
        yield branch, LAYOUT, state
        yield branch, LAYOUT, PINNED, state
        for values in (self._ours, self._theirs):
            inner = values[branch]
            for key in _map(inner, "_operations"):
                if "/" in key and Address.split(key)[0] == state:
                    yield branch, "_operations", key
            for key in _map(_map(inner, LAYOUT), IN_LAYOUT):
                if Address.split(key)[0] == state:
                    yield branch, LAYOUT, IN_LAYOUT, key
            for source, operations in inner.items():
                if not _is_state(source) or source == state or not isinstance(operations, dict):
                    continue
                for operation, target in operations.items():
                    path = (branch, source, operation)
                    if target == state and ABSENT in self._values(path):
                        yield path

    def _values(self, path: Path) -> tuple[Json, Json]:
        return value_at(self._ours, path), value_at(self._theirs, path)

    def _below(self, path: Path, ours: Json, theirs: Json) -> Iterator[Conflict]:
        if path in self._told or equal(ours, theirs) or path[1:2] == (LAYOUT,):
            return
        if path[1:] == (HEADER,):
            ours, theirs = ({} if one is ABSENT else one for one in (ours, theirs))
        maps = _as_map(path[-1], ours), _as_map(path[-1], theirs)
        if maps[0] is None or maps[1] is None:
            yield Conflict(path, ABSENT, ours, theirs, base_known=False)
            return
        for key in _keys(maps[0], maps[1]):
            yield from self._below((*path, key), maps[0].get(key, ABSENT), maps[1].get(key, ABSENT))


def _is_state(key: str) -> bool:
    return key != HEADER and not key.startswith("_")


def _keys(ours: Mapping[str, Json], theirs: Mapping[str, Json]) -> list[str]:
    return list(dict.fromkeys((*ours, *theirs)))


def _map(values: Json, key: str) -> dict[str, Json]:
    found = values.get(key)
    return found if isinstance(found, dict) else {}


def _as_map(key: str, value: Json) -> dict[str, Json] | None:
    """A value key by key, also a list of maps with names. None for any other value."""
    if isinstance(value, dict):
        return value
    if key not in NAMED or not isinstance(value, list):
        return None
    names = [item.get("name") if isinstance(item, dict) else None for item in value]
    if len(set(map(str, names))) != len(names) or not all(isinstance(one, str) for one in names):
        return None
    return {str(name): item for name, item in zip(names, value, strict=True)}
