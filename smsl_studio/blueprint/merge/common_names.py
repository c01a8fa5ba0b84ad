"""Gives equal elements of three versions equal names, so that a renamed state is the same state.

A name that one side gave to an SB or a state of the base is used in all versions. If both gave
another name, that is a conflict, and the name of ``ours`` is used.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.pairs import renamed_branches, renamed_states
from smsl_studio.blueprint.editing.draft import Draft, free_name
from smsl_studio.blueprint.editing.renames import rename, rename_states
from smsl_studio.blueprint.merge.conflict import Conflict, Path
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import EditRefused

Names = Mapping[str, str]


class Versions(NamedTuple):
    """The same thing in the base and on both sides."""

    base: Blueprint
    ours: Blueprint
    theirs: Blueprint


@dataclass(frozen=True)
class CommonNames:
    """Three versions whose equal elements have equal names.

    ``renamed`` has for each side (ours, theirs) the paths of the elements that it renamed.
    """

    versions: Versions
    conflicts: tuple[Conflict, ...]
    renamed: tuple[frozenset[Path], frozenset[Path]]


def in_common_names(versions: Versions) -> CommonNames:
    """Return three versions in common names. The names of ``ours`` count most."""
    conflicts: list[Conflict] = []
    renamed: tuple[set[Path], set[Path]] = set(), set()
    base, ours, theirs = versions
    given = _given(
        list(_own(base)),
        (_own(ours), _own(theirs)),
        (renamed_branches(_own(base), _own(ours)), renamed_branches(_own(base), _own(theirs))),
        "a State Branch",
    )
    _note(given, lambda name: (name,), conflicts, renamed)
    base, ours, theirs = (
        _with_branches(one, names) for one, names in zip(versions, given.to_common, strict=True)
    )
    drafts = Draft(base), Draft(ours), Draft(theirs)
    mine, other = _own(ours), _own(theirs)
    for name, branch in _own(base).items():
        sides = mine.get(name), other.get(name)
        given = _given(
            list(branch.table),
            [side.table if side else () for side in sides],
            [renamed_states(branch, side) if side else {} for side in sides],
            "a state",
        )
        _note(given, lambda state, name=name: (name, state), conflicts, renamed)  # type: ignore[misc]
        for draft, names in zip(drafts, given.to_common, strict=True):
            if names and name in draft.before.branches:
                rename_states(draft, name, names)
    done = Versions(*(draft.done() for draft in drafts))
    return CommonNames(done, tuple(conflicts), (frozenset(renamed[0]), frozenset(renamed[1])))


class _Given(NamedTuple):
    """New names of elements: for each version the map to the common names, and for each element
    (by its common name) its names in the three versions."""

    to_common: tuple[Names, Names, Names]
    names: Mapping[str, tuple[str, str, str]]


def _given(
    base: Collection[str],
    taken: Collection[Collection[str]],
    renamed: Collection[Names],
    what: str,
) -> _Given:
    """Return the common names of elements. ``renamed`` has what each side calls some of them."""
    (here, there), (ours, theirs) = taken, renamed
    good = (
        dict(_usable(ours, there, theirs, what)),
        dict(_usable(theirs, here, ours, what)),
    )
    maps: tuple[dict[str, str], dict[str, str], dict[str, str]] = {}, {}, {}
    names: dict[str, tuple[str, str, str]] = {}
    for old in base:
        mine, other = good[0].get(old, old), good[1].get(old, old)
        common = mine if mine != old else other
        if common == old:
            continue
        names[common] = old, mine, other
        for version, name in zip(maps, (old, mine, other), strict=True):
            if name != common:
                version[name] = common
    return _Given(maps, names)


def _usable(
    names: Names, others: Collection[str], other_names: Names, what: str
) -> Iterator[tuple[str, str]]:
    """Yield the new names of a side that mean nothing else on the other side."""
    for old, new in names.items():
        try:
            free_name(new, (), what)
        except EditRefused:
            continue
        if new not in others or other_names.get(old) == new:
            yield old, new


def _note(
    given: _Given,
    path: Callable[[str], Path],
    conflicts: list[Conflict],
    renamed: tuple[set[Path], set[Path]],
) -> None:
    """Record who renamed what, and where both gave another name."""
    for common, (old, mine, other) in given.names.items():
        for side, name in zip(renamed, (mine, other), strict=True):
            if name != old:
                side.add(path(common))
        if old not in (mine, other) and mine != other:
            conflicts.append(Conflict(path(common), old, mine, other, about_name=True))


def _own(blueprint: Blueprint) -> dict[str, StateBranch]:
    """The SBs of a blueprint's own file."""
    return {one.name: one for one in blueprint if one.name not in blueprint.imported}


def _with_branches(blueprint: Blueprint, names: Names) -> Blueprint:
    for old, new in names.items():
        if old in blueprint.branches:
            blueprint = rename(blueprint, Address(old), new)
    return blueprint
