"""Conflicts as they stand in a file under ``_conflicts``: a list of maps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.merge.conflict import ABSENT, KEY, NAME, Attachment, Conflict, Path

Json = Any
VERSIONS = ("base", "ours", "theirs")
ABOUT, PATH, PARTS, BASE_KNOWN = "about", "path", "parts", "base_known"
Faults = list[tuple[Path, str]]


def written_conflict(conflict: Conflict) -> dict[str, Json]:
    """Return a conflict as a value of the file. A version that does not have it has no key."""
    entry = _written(conflict)
    if conflict.about_name:
        entry[ABOUT] = NAME
    if not conflict.base_known:
        entry[BASE_KNOWN] = False
    if conflict.parts:
        entry[PARTS] = [_written(part) for part in conflict.parts]
    return entry


def read_conflicts(raw: Json) -> tuple[dict[int, Conflict], Faults]:
    """Return the conflicts under ``_conflicts`` by their index, and what could not be understood:
    pairs of a path and a sentence."""
    faults: Faults = []
    if not isinstance(raw, list):
        return {}, [((KEY,), f"{KEY} must be a list")]
    found: dict[int, Conflict] = {}
    for index, entry in enumerate(raw):
        conflict = _read(entry)
        if conflict is None:
            faults.append(
                (
                    (KEY, str(index)),
                    "an open conflict is a map with path (a list of names), base, ours and theirs",
                )
            )
        else:
            found[index] = conflict
    return found, faults


def _written(one: Conflict | Attachment) -> dict[str, Json]:
    values = zip(VERSIONS, (one.base, one.ours, one.theirs), strict=True)
    return {PATH: list(one.path), **{key: v for key, v in values if v is not ABSENT}}


def _read(entry: Json) -> Conflict | None:
    if not isinstance(entry, dict):
        return None
    about, parts = entry.get(ABOUT), entry.get(PARTS, [])
    path = _path(entry)
    if path is None or about not in (None, NAME) or not isinstance(parts, list):
        return None
    read = [Attachment(below, *_values(part)) for part in parts if (below := _path(part))]
    if len(read) != len(parts):
        return None
    if about == NAME and not all(isinstance(value, str) and value for value in _values(entry)):
        return None
    is_known = entry.get(BASE_KNOWN, True)
    if not isinstance(is_known, bool):
        return None
    return Conflict(path, *_values(entry), about == NAME, tuple(read), is_known)


def _path(entry: Json) -> Path | None:
    path = entry.get(PATH) if isinstance(entry, dict) else None
    if not isinstance(path, list) or not path:
        return None
    return tuple(path) if all(isinstance(key, str) and key for key in path) else None


def _values(entry: Mapping[str, Json]) -> tuple[Json, Json, Json]:
    base, ours, theirs = (entry.get(key, ABSENT) for key in VERSIONS)
    return base, ours, theirs
