"""The versions that an open merge is about, and what merged by itself."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from smsl_studio.blueprint.comparison import Change, compare
from smsl_studio.blueprint.comparison.signs import CHANGED, sign_of
from smsl_studio.blueprint.merge.choice import Side, choose_all, open_conflicts
from smsl_studio.blueprint.merge.conflict import Conflict, Path
from smsl_studio.blueprint.model import Blueprint

MINE, THEIRS, ALIKE = "M", "T", "MT"


@dataclass(frozen=True)
class MergeSides:
    """The three versions of a merge. ``known`` is False if they were made from the open conflicts
    alone; then all that is no conflict is equal in them. ``base`` is None if it is not known.
    ``by_lines`` says that git merged lines before, which are now in all versions. ``who`` has the
    author, the day and the commit of a version, if they are known.
    """

    ours: Blueprint
    theirs: Blueprint
    base: Blueprint | None
    known: bool = True
    by_lines: bool = False
    who: Mapping[str, tuple[str, str, str]] = field(default_factory=dict)

    def get(self, side: Side) -> Blueprint | None:
        """Return one of the versions."""
        found: Blueprint | None = getattr(self, side)
        return found


class MergedGroup(NamedTuple):
    """What one side, or both alike, changed in one way: added, removed or changed.

    ``side`` is M, T or MT, ``sign`` is +, - or ~.
    """

    side: str
    sign: str
    changes: tuple[Change, ...]


def sides_of_entries(blueprint: Blueprint) -> MergeSides:
    """Return the versions as far as the open conflicts of a file tell them."""
    found = open_conflicts(blueprint)
    known = all(one.base_known for one in found)
    base = choose_all(blueprint, "base") if known else None
    ours, theirs = choose_all(blueprint, "ours"), choose_all(blueprint, "theirs")
    return MergeSides(ours, theirs, base, known=False)


def merged_groups(sides: MergeSides, conflicts: Iterable[Conflict]) -> tuple[MergedGroup, ...]:
    """Return what merged without a conflict, first what mine changed, then theirs, then what both
    changed alike. Nothing is returned if the versions are not known."""
    if not sides.known or sides.base is None:
        return ()
    open_ones = tuple(conflicts)
    paths = frozenset(one.path for one in open_ones)
    fields = frozenset((one.address, one.path[-1]) for one in open_ones)
    addresses = frozenset(one.address for one in open_ones)
    mine, theirs = (
        {change.words: change for change in compare(sides.base, side).changes
         if not _belongs(change, paths)
         and (str(change.address), change.field) not in fields
         and (change.field or str(change.address) not in addresses)}
        for side in (sides.ours, sides.theirs)
    )  # fmt: skip
    both = mine.keys() & theirs.keys()
    groups: list[MergedGroup] = []
    for side, changes in (
        (MINE, [one for words, one in mine.items() if words not in both]),
        (THEIRS, [one for words, one in theirs.items() if words not in both]),
        (ALIKE, [one for words, one in mine.items() if words in both]),
    ):
        groups += _by_sign(side, changes)
    return tuple(groups)


def _by_sign(side: str, changes: list[Change]) -> Iterator[MergedGroup]:
    for sign in "+-~":
        found = tuple(one for one in changes if _sign(one) == sign)
        if found:
            yield MergedGroup(side, sign, found)


def _sign(change: Change) -> str:
    whole = change.what in ("branch", "state", "operation")
    return sign_of(change.kind) if whole else CHANGED


def _belongs(change: Change, paths: Collection[Path]) -> bool:
    """Whether a change is about the value of a conflict, or about something inside it."""
    return any(
        path[:length] in paths
        for path in (change.path_before, change.path_after)
        for length in range(1, len(path) + 1)
    )
