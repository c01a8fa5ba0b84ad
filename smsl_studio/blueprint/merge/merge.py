"""``merge``: the three-way merge of a blueprint's own file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.editing.drawn import free_keys
from smsl_studio.blueprint.merge.clashes import Clashes
from smsl_studio.blueprint.merge.common_names import Versions, in_common_names
from smsl_studio.blueprint.merge.conflict import ABSENT, KEY, Conflict, Path, address_of
from smsl_studio.blueprint.merge.headers import HeaderMerger, take_out
from smsl_studio.blueprint.merge.trees import Trees
from smsl_studio.blueprint.merge.values import Merger, equal
from smsl_studio.blueprint.merge.written import written_conflict
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.pins import PINNED, pinned_anew
from smsl_studio.errors import ReadError

Json = Any
LAYOUT, GROUPS, NOTES = "_layout", "_groups", "_notes"


@dataclass(frozen=True)
class Merge:
    """The merged blueprint with its open conflicts.

    ``layout_kept`` has the addresses of elements that both sides placed anew. Their places have no
    meaning, so those of ours are kept without a conflict. Where one side alone has pinned a state
    since the base, its place counts.
    """

    blueprint: Blueprint
    conflicts: tuple[Conflict, ...]
    layout_kept: tuple[str, ...] = ()


def merge(base: Blueprint, ours: Blueprint, theirs: Blueprint) -> Merge:
    """Merge what two sides made of ``base``. The result has the text form and comments of ``ours``.

    Only the own file of each blueprint is merged, not the files that it imports. ReadError if a key
    is written twice in one of the files, because one of its values would be lost.
    """
    for side in (base, ours, theirs):
        _must_be_single(side)
    common = in_common_names(Versions(base, ours, theirs))
    trees = Trees(*(version.document.values for version in common.versions))
    for branch in trees.branches_of_all():
        _free_keys_of_theirs(trees, (branch, NOTES))
        _free_keys_of_theirs(trees, (branch, LAYOUT, GROUPS))
    clashes = Clashes(trees, common.renamed)
    clashes.settle()
    kept = [path for branch in trees.branches_of_all() for path in _settle_pins(trees, branch)]
    taken = {branch: take_out(trees, branch) for branch in trees.branches()}
    merger = Merger(lambda path: len(path) > 1 and path[1] == LAYOUT)
    values = merger.merged_map((), *trees.versions)
    clashing = frozenset(one.path for one in clashes.conflicts)
    headers = HeaderMerger(common.versions, merger, clashing)
    for branch, written in taken.items():
        if branch in values:
            values[branch] = dict(values[branch])
            headers.finish(branch, values[branch], written)
    conflicts = (*common.conflicts, *clashes.conflicts, *merger.conflicts)
    kept += merger.kept
    return _made(common.versions.ours, values, conflicts, kept, _open(base, ours, theirs))


def _made(
    ours: Blueprint,
    values: dict[str, Json],
    conflicts: tuple[Conflict, ...],
    kept: list[Path],
    open_before: list[Json],
) -> Merge:
    written = [written_conflict(one) for one in conflicts]
    entries = written + [one for one in open_before if one not in written]
    if entries:
        values[KEY] = entries
    draft = Draft(ours)
    file = draft.file()
    file.clear()
    file.update(values)
    places = dict.fromkeys(_address_of_place(path) for path in kept)
    return Merge(draft.done(), conflicts, tuple(places))


def _open(base: Blueprint, ours: Blueprint, theirs: Blueprint) -> list[Json]:
    """Return the conflicts that earlier merges left open, each once.

    A conflict that was open in the base and is gone on one side was decided there.
    """
    before, *sides = (_entries(one) for one in (base, ours, theirs))
    found: list[Json] = []
    for entry in (entry for side in sides for entry in side):
        decided = _stands_in(entry, before) and not all(_stands_in(entry, side) for side in sides)
        if not (decided or _stands_in(entry, found)):
            found.append(entry)
    return found


def _entries(side: Blueprint) -> list[Json]:
    entries = side.document.values.get(KEY)
    return entries if isinstance(entries, list) else []


def _stands_in(entry: Json, entries: list[Json]) -> bool:
    return any(equal(entry, one) for one in entries)


def _address_of_place(path: Path) -> str:
    """Return the address of the element whose place stands at a path of ``_layout``."""
    inside = path[2:]
    if inside[:1] == ("_operations",) and len(inside) > 1:
        return address_of((path[0], "_operations", inside[1]))
    if inside[:1] == (PINNED,) and len(inside) > 1:
        return address_of((path[0], inside[1]))
    if inside and not inside[0].startswith("_"):
        return address_of((path[0], inside[0]))
    return address_of(path[:1])


def _settle_pins(trees: Trees, branch: str) -> Iterator[Path]:
    """Let the place at which one side has pinned a state count on the other side too. If that side
    has deleted the state, the pin goes with it.

    Yield the places of theirs that are left out.
    """
    layouts = [trees.map(at, (branch, LAYOUT)) for at in range(3)]
    for side, other in ((1, 2), (2, 1)):
        for state in pinned_anew(layouts[0], layouts[side], layouts[other]):
            if trees.is_kept((branch, state)):
                continue
            if _is_deleted(trees, other, (branch, state)):
                _forget_pin(trees, side, branch, state)
                continue
            here, there, before = (layouts[at].get(state) for at in (side, other, 0))
            if here is None or there is None or equal(here, there):
                continue
            path = (branch, LAYOUT, state)
            trees.put(other, path, here)
            if side == 1 and not equal(there, before):
                yield path


def _is_deleted(trees: Trees, side: int, path: Path) -> bool:
    return trees.get(0, path) is not ABSENT and trees.get(side, path) is ABSENT


def _forget_pin(trees: Trees, side: int, branch: str, state: str) -> None:
    """Remove a pin from a version, and the map of pins with the last one."""
    path = (branch, LAYOUT, PINNED)
    trees.put(side, (*path, state), ABSENT)
    if trees.now(side, path) == {}:
        trees.put(side, path, ABSENT)


def _free_keys_of_theirs(trees: Trees, path: Path) -> None:
    """Give notes or groups of theirs another key if ours added others under the same keys."""
    ours, theirs = trees.map(1, path), trees.map(2, path)
    base = trees.map(0, path)
    both = [key for key in theirs if key in ours and key not in base]
    doubled = [key for key in both if not equal(ours[key], theirs[key])]
    if not doubled:
        return
    taken = {*base, *ours, *theirs}
    new = dict(zip(doubled, free_keys(taken), strict=False))
    trees.put(2, path, {new.get(key, key): value for key, value in theirs.items()})


def _must_be_single(blueprint: Blueprint) -> None:
    """Raise ReadError for a key that is written twice."""
    for path, places in blueprint.document.duplicates():
        raise ReadError(
            f"{'/'.join(path)} is written {len(places)} times, and a merge would keep the last "
            "alone",
            places[-1],
            "Keep one of them first (the quick fix of R01 keeps the last).",
        )
