"""The three-way merge of plain values: maps key by key, everything else as one value."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from smsl_studio.blueprint.comparison.values import alike
from smsl_studio.blueprint.merge.conflict import ABSENT, Conflict, Path
from smsl_studio.blueprint.reading import HEADER

Json = Any
NAMED = ("_hazards", "_properties")
"""Keys with a list of maps that have names."""
BESIDE = ("name", "why", "severity")
"""Keys of such a map that are no part of what it says."""
SETS = ("_imports", "states", "failure", "sensors")
"""Keys with a list in which each text stands once."""


def equal(one: Json, other: Json) -> bool:
    """Return whether two values, or their absence, are equal."""
    if one is ABSENT or other is ABSENT:
        return one is other
    return alike(one, other)


def equal_branches(one: Json, other: Json) -> bool:
    """Return whether two SBs, or their absence, are equal, and begin and end in the same states.

    The order of states has a meaning where INITIAL or ACTIVATING is left to the default.
    """
    return equal(one, other) and _ends(one) == _ends(other)


def _ends(values: Json) -> tuple[Json, Json]:
    if not isinstance(values, dict):
        return None, None
    states = [key for key in values if key != HEADER and not key.startswith("_")] or [None]
    header = values.get(HEADER)
    said = header if isinstance(header, dict) else {}
    return said.get("INITIAL", states[0]), said.get("ACTIVATING", states[-1])


def _says_two_things(path: Path, base: Json, ours: Json, theirs: Json) -> bool:
    """Return whether both sides changed a hazard or property in different ways.

    Its facts or conditions belong together, like one sentence. A merge key by key could make a new
    sentence that nobody wrote. So this is a conflict.
    """
    if len(path) != 2 or path[0] not in NAMED:
        return False
    before, one, other = ({key: value for key, value in entry.items() if key not in BESIDE}
                          for entry in (base, ours, theirs))  # fmt: skip
    return not (equal(one, other) or equal(one, before) or equal(other, before))


class Merger:
    """Merges values and collects the conflicts.

    ``is_quiet`` says for a path whether the first side simply counts if both changed it. Such paths
    are collected in ``kept``.
    """

    def __init__(self, is_quiet: Callable[[Path], bool]) -> None:
        self.conflicts: list[Conflict] = []
        self.kept: list[Path] = []
        self._is_quiet = is_quiet

    def merged(self, path: Path, base: Json, ours: Json, theirs: Json) -> Json:
        """Return the merged value at a path, ABSENT if it goes."""
        is_branch = len(path) == 1 and not path[0].startswith("_")
        same = equal_branches if is_branch else equal
        if same(ours, theirs) or same(theirs, base):
            return ours
        if same(ours, base):
            return theirs
        maps = _as_maps(path, (base, ours, theirs))
        if maps is None or _says_two_things(path, *maps):
            if self._is_quiet(path):
                self.kept.append(path)
            else:
                self.conflicts.append(Conflict(path, base, ours, theirs))
            return ours
        values = self.merged_map(path, *maps)
        if isinstance(ours, list):
            return list(values.values())
        return values

    def merged_map(
        self, path: Path, base: Mapping[str, Json], ours: Mapping[str, Json],
        theirs: Mapping[str, Json],
    ) -> dict[str, Json]:  # fmt: skip
        """Return the merged map at a path. Keys have the order of the side that changed it."""
        merged: dict[str, Json] = {}
        for key in merged_order(tuple(base), tuple(ours), tuple(theirs)):
            value = self.merged(
                (*path, key),
                base.get(key, ABSENT),
                ours.get(key, ABSENT),
                theirs.get(key, ABSENT),
            )
            if value is not ABSENT:
                merged[key] = value
        return merged


def merged_order(base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]) -> list[str]:
    """Return all keys of three versions in one order.

    It is the order of ``ours``, or of ``theirs`` if only this side changed the order. A key that is
    only in the other one stands behind its predecessor there.
    """
    first, second = ours, theirs
    kept = set(base) & set(ours) & set(theirs)
    before, here, there = ([key for key in keys if key in kept] for keys in (base, ours, theirs))
    if here == before and there != before:
        first, second = theirs, ours
    order = list(first)
    for keys in (second, base):
        order = _inserted(order, keys)
    return order


def _inserted(order: Iterable[str], keys: Sequence[str]) -> list[str]:
    """Return an order with the further keys, each behind its predecessor in ``keys``."""
    known = list(order)
    present = set(known)
    follow: dict[str | None, list[str]] = {}
    last: str | None = None
    for key in keys:
        if key in present:
            last = key
        else:
            follow.setdefault(last, []).append(key)
    found = follow.get(None, [])
    for key in known:
        found.append(key)
        found.extend(follow.get(key, ()))
    return found


def _as_maps(path: Path, versions: tuple[Json, Json, Json]) -> list[Mapping[str, Json]] | None:
    """Return three versions as maps, or None if one of them cannot be merged key by key.

    A missing base is an empty map, because both sides added the value.
    """
    base, ours, theirs = versions
    if ours is ABSENT or theirs is ABSENT:
        return None
    maps: list[Mapping[str, Json]] = []
    for value in ({} if base is ABSENT and isinstance(ours, dict) else base, ours, theirs):
        found = _as_map(path[-1], [] if value is ABSENT else value)
        if found is None:
            return None
        maps.append(found)
    kinds = {type(value) for value in versions if value is not ABSENT}
    return maps if len(kinds) == 1 else None


def _as_map(key: str, value: Json) -> Mapping[str, Json] | None:
    if isinstance(value, dict):
        return value
    if not isinstance(value, list):
        return None
    names: list[Json] = []
    if key in NAMED:
        names = [item.get("name") if isinstance(item, dict) else None for item in value]
    elif key in SETS:
        names = value
    else:
        return None
    if not all(isinstance(name, str) for name in names) or len(set(names)) != len(names):
        return None
    return dict(zip(names, value, strict=True))
