"""What a merge left open under ``_conflicts`` follows when elements get other names."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from smsl_studio.blueprint.address import Address, escape, note_key
from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.reading import HEADER

Json = Any
Names = tuple[str, ...]
Follow = Callable[[Names], Names]
"""Gets the names of an element, such as (SB, state), and returns its names after the edit."""
KEY = "_conflicts"
VERSIONS = ("base", "ours", "theirs")
ENDS = ("INITIAL", "ACTIVATING")
TABLES = ("_states", "_layout", "_operations")


def conflicts_follow(draft: Draft, follow: Follow) -> None:
    """Let paths and values of the open conflicts follow an edit of names. An entry that is not
    understood stays."""
    for document in draft.before.documents:
        entries = document.values.get(KEY)
        if isinstance(entries, list):
            renamed = [_renamed_entry(entry, follow) for entry in entries]
            if renamed != entries:
                draft.file(document)[KEY] = renamed


def _renamed_entry(entry: Json, follow: Follow) -> Json:
    path = entry.get("path") if isinstance(entry, dict) else None
    if not isinstance(path, list) or not path or not all(isinstance(key, str) for key in path):
        return entry
    after = {**entry, "path": list(_path(tuple(path), follow))}
    if "about" not in entry:
        for version in VERSIONS:
            if version in entry:
                after[version] = _value(tuple(path), entry[version], follow)
    if isinstance(entry.get("parts"), list):
        after["parts"] = [_renamed_entry(part, follow) for part in entry["parts"]]
    return after


def _path(path: Names, follow: Follow) -> Names:
    branch, *below = path
    if branch == "_levels" and len(below) == 1 and below[0].count("/") > 1:
        return branch, "/".join(map(escape, follow(tuple(Address.split(below[0])))))
    if branch.startswith("_"):
        return path
    new = follow((branch,))[0]
    if not below or below[0] == HEADER:
        return (new, *_subs(below, follow))
    if not below[0].startswith("_"):
        return (*follow(path[:3]), *below[2:])
    at = 2 if below[:2] == ["_layout", "_operations"] else 1
    if below[0] not in TABLES or len(below) <= at:
        return (new, *below)
    key = _key(branch, below[at], follow)
    return (new, *below[:at], key, *below[at + 1 :])


def _subs(below: list[str], follow: Follow) -> list[str]:
    if below[1:2] == ["SUB_SBS"] and len(below) == 3:
        return [*below[:2], follow((below[2],))[0]]
    return below


def _key(branch: str, key: str, follow: Follow) -> str:
    """Return the key of a state (``S0``) or of an operation (``S0/go``) in a table."""
    names = Address.split(key)
    if len(names) == 2:
        _, state, operation = follow((branch, *names))
        return note_key(operation, state)
    return follow((branch, key))[1]


def _value(path: Names, value: Json, follow: Follow) -> Json:
    branch, *below = path
    if branch.startswith("_"):
        return value
    if len(below) == 2 and isinstance(value, str):
        is_target = below[0] != HEADER and not below[0].startswith("_")
        if is_target or (below[0] == HEADER and below[1] in ENDS):
            return follow((branch, value))[1]
    if not isinstance(value, dict):
        return value
    if not below:
        return {_inside(branch, key, follow): _value((branch, key), inner, follow)
                for key, inner in value.items()}  # fmt: skip
    if len(below) == 1 and below[0] == HEADER:
        return {key: _value((*path, key), inner, follow) for key, inner in value.items()}
    if len(below) == 1 and not below[0].startswith("_"):
        return {
            follow((*path, operation))[-1]: _value((*path, operation), target, follow)
            for operation, target in value.items()
        }
    if below[0] == "_notes" and isinstance(value.get("state"), str):
        return {**value, "state": follow((branch, value["state"]))[1]}
    return value


def _inside(branch: str, key: str, follow: Follow) -> str:
    return key if key == HEADER or key.startswith("_") else follow((branch, key))[1]
