"""The choice of one conflict: the file gets the value of one version, and the entry goes."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any, Literal

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.editing.renames import rename
from smsl_studio.blueprint.merge.conflict import ABSENT, KEY, Attachment, Conflict, Path
from smsl_studio.blueprint.merge.values import NAMED
from smsl_studio.blueprint.merge.written import read_conflicts
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER, sub_entries
from smsl_studio.errors import EditRefused, ReadError

Json = Any
Side = Literal["ours", "theirs", "base"]


def open_conflicts(blueprint: Blueprint) -> tuple[Conflict, ...]:
    """Return the conflicts that stand open in a blueprint's own file, in their order. Entries that
    are not understood are left out; the check reports them."""
    if KEY not in blueprint.document.values:
        return ()
    return tuple(read_conflicts(blueprint.document.values[KEY])[0].values())


def refusal_of_open(blueprint: Blueprint) -> EditRefused | None:
    """Return why a blueprint cannot be run yet: conflicts of a merge are open. None if it can."""
    number = len(open_conflicts(blueprint))
    if not number:
        return None
    words = "1 conflict of a merge is open" if number == 1 else f"{number:,} conflicts are open"
    return EditRefused(words, advice="Choose on the page Merge of Draw first.")


def choose(blueprint: Blueprint, conflict: Conflict, side: Side) -> Blueprint:
    """Decide a conflict: its element gets the value of one version, with all parts, and its entry
    under ``_conflicts`` goes.

    An open conflict keeps ``ours`` already, so ``ours`` leaves the element as it stands. A conflict
    that is decided can be decided anew. EditRefused if the element or what it belongs to is gone,
    or if ``base`` is not known.
    """
    if side == "base" and not conflict.base_known:
        raise EditRefused(
            f"the base of {conflict.address} is not known",
            advice="Take mine or theirs, or edit it in the drawing.",
        )
    number = _number(blueprint, conflict)
    if number is not None:
        blueprint = _without(blueprint, number)
        if side == "ours":
            return blueprint
    if conflict.about_name:
        return _named(blueprint, conflict, getattr(conflict, side))
    draft = Draft(blueprint)
    _put_whole(draft.file(), blueprint, conflict, side)
    try:
        return draft.done()
    except ReadError as error:
        # Only an entry that was written by hand has such a value.
        raise EditRefused(
            f"that value of {conflict.address} gives no blueprint: {error.sentence}",
            advice="Take another one, or correct the entry under _conflicts in the source.",
        ) from None


def choose_all(blueprint: Blueprint, side: Side) -> Blueprint:
    """Decide all open conflicts for one version, as far as it can be taken; the others keep mine.
    Entries that are not understood stay."""
    if side != "ours":
        for one in open_conflicts(blueprint):
            if one.about_name:
                with suppress(EditRefused):
                    blueprint = choose(blueprint, one, side)
    found = read_conflicts(blueprint.document.values.get(KEY, []))[0]
    draft = Draft(blueprint)
    file = draft.file()
    left = [entry for at, entry in enumerate(file.get(KEY, ())) if at not in found]
    if left:
        file[KEY] = left
    else:
        file.pop(KEY, None)
    if side == "ours":
        return draft.done()
    for one in found.values():
        if not one.about_name and (side != "base" or one.base_known):
            with suppress(EditRefused):
                _put_whole(file, blueprint, one, side)
    try:
        return draft.done()
    except (EditRefused, ReadError):
        # An entry that was written by hand has a value that gives no blueprint.
        return choose_all(blueprint, "ours")


def _put_whole(
    values: dict[str, Json], blueprint: Blueprint, conflict: Conflict, side: Side
) -> None:
    """Give the element of a conflict, with its parts, the value of a version."""
    whole: tuple[Conflict | Attachment, ...] = (conflict, *conflict.parts)
    for one in whole:
        _put(values, one, getattr(one, side), is_part=one is not conflict)
    if len(conflict.path) == 2 and not conflict.path[1].startswith(("_", HEADER)):
        _keep_header(values, blueprint.branches.get(conflict.path[0]))


def chosen_side(blueprint: Blueprint, conflict: Conflict) -> Side | None:
    """Return the version whose value the element of a conflict has, None if it has another one."""
    for side in ("ours", "theirs", "base"):
        wanted = getattr(conflict, side)
        if conflict.about_name:
            if _stands(blueprint, (*conflict.path[:-1], wanted)):
                return side
        elif _is_at(blueprint.document.values, conflict.path, wanted):
            return side
    return None


def _number(blueprint: Blueprint, conflict: Conflict) -> int | None:
    found = read_conflicts(blueprint.document.values.get(KEY, []))[0]
    return next((at for at, one in found.items() if one == conflict), None)


def _without(blueprint: Blueprint, number: int) -> Blueprint:
    draft = Draft(blueprint)
    file = draft.file()
    left = [entry for at, entry in enumerate(file[KEY]) if at != number]
    if left:
        file[KEY] = left
    else:
        del file[KEY]
    return draft.done()


def _stands(blueprint: Blueprint, path: Path) -> bool:
    branch = blueprint.branches.get(path[0])
    return branch is not None and (len(path) == 1 or path[1] in branch.table)


def _named(blueprint: Blueprint, conflict: Conflict, name: Json) -> Blueprint:
    """Give the element of a conflict about a name another name."""
    *above, last = conflict.path
    candidates = (last, conflict.ours, conflict.theirs, conflict.base)
    now = next((one for one in candidates if _stands(blueprint, (*above, one))), None)
    if now is None:
        raise _gone(conflict.path)
    address = Address(above[0], now) if above else Address(now)
    return rename(blueprint, address, name)


def _put(values: dict[str, Json], one: Conflict | Attachment, value: Json, is_part: bool) -> None:
    try:
        _set(values, one.path, value, 0)
    except LookupError:
        # A note of an element that is gone has nothing to say.
        if not is_part:
            raise _gone(one.path) from None


def _set(node: dict[str, Json], path: Path, value: Json, depth: int) -> None:
    """Set the value at a path in a map that may be changed; what is below is copied."""
    key = path[depth]
    if depth == len(path) - 1:
        if value is ABSENT:
            node.pop(key, None)
        else:
            _insert(node, key, value, depth)
        return
    inner = node.get(key)
    if inner is None:
        if value is ABSENT:
            return
        if not (
            key.startswith("_") or key == HEADER or (depth and path[1].startswith(("_", HEADER)))
        ):
            raise LookupError
        inner = {}
    after = _as_map(key, inner)
    _set(after, path, value, depth + 1)
    if key.startswith("_") and not after:
        node.pop(key, None)
        return
    _insert(node, key, list(after.values()) if key in NAMED else after, depth)


def _insert(node: dict[str, Json], key: str, value: Json, depth: int) -> None:
    """Set a key. A new header stands first, a new state behind the last one."""
    if depth != 1 or key in node or key.startswith("_"):
        node[key] = value
        return
    states = [at for at, name in enumerate(node) if not name.startswith("_")]
    place = 0 if key == HEADER or not states else states[-1] + 1
    items = list(node.items())
    items.insert(place, (key, value))
    node.clear()
    node.update(items)


def _as_map(key: str, value: Json) -> dict[str, Json]:
    """Return a copy of a map, or a list of it that is read by names. LookupError if it is none."""
    if isinstance(value, dict):
        return dict(value)
    if isinstance(value, list) and key in NAMED:
        return {item["name"]: item for item in value if isinstance(item, dict) and "name" in item}
    if isinstance(value, list) and key == "SUB_SBS":
        return {sub: digit for _, sub, digit in sub_entries(value)}
    raise LookupError


def _is_at(values: Mapping[str, Json], path: Path, wanted: Json) -> bool:
    node: Json = values
    for key, inner in zip(("", *path[:-1]), path, strict=True):
        if node is ABSENT or node is None:
            return wanted is ABSENT
        try:
            node = _as_map(key, node).get(inner, ABSENT)
        except LookupError:
            return False
    return bool(node is wanted or node == wanted)


def _keep_header(values: dict[str, Json], before: StateBranch | None) -> None:
    """Let the header say the same ends after a state came or went, and the new number."""
    if before is None or not isinstance(values.get(before.name), dict):
        return
    inner = dict(values[before.name])
    states = [key for key in inner if key != HEADER and not key.startswith("_")]
    header = inner.get(HEADER, {})
    if not isinstance(header, dict):
        return
    found: dict[str, Json] = {}
    ends = (("INITIAL", before.initial, states[:1]), ("ACTIVATING", before.activating, states[-1:]))
    for key, end, default in ends:
        if key not in header and end in states and [end] != default:
            found[key] = end
    number = header.get("NUM_STATES")
    if number != len(states) and before.header.num_states == len(before.table):
        found["NUM_STATES"] = len(states)
    if found:
        _insert(inner, HEADER, {**header, **found}, 1)
        values[before.name] = inner


def _gone(path: Path) -> EditRefused:
    return EditRefused(
        f"{'/'.join(path)} has no place in the drawing any more",
        advice="Undo what removed it, or take mine to leave it as it is.",
    )
