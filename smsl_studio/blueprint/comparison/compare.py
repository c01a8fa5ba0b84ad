"""``compare``: compares two blueprints element by element, in the order of the files."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.difference import Change, ChangeKind, Difference
from smsl_studio.blueprint.comparison.file_level import compare_fields, compare_order
from smsl_studio.blueprint.comparison.headers import compare_header
from smsl_studio.blueprint.comparison.layout import moved_states, pinned_states, redrawn_operations
from smsl_studio.blueprint.comparison.notes import compare_notes
from smsl_studio.blueprint.comparison.pairs import renamed_branches, renamed_states
from smsl_studio.blueprint.comparison.sides import BranchSides, Sides
from smsl_studio.blueprint.comparison.states import compare_states
from smsl_studio.blueprint.comparison.values import merged
from smsl_studio.blueprint.model import Blueprint, StateBranch


def compare(before: Blueprint, after: Blueprint) -> Difference:
    """Return the changes of meaning from ``before`` to ``after``. Moved boxes, and ``_`` fields
    without a meaning, are listed apart from them.

    The result is deterministic. In the opposite direction an addition is a removal. The time grows
    linearly with the number of operations.
    """
    renamed = renamed_branches(before.branches, after.branches)
    sides = Sides(before, after, renamed)
    moved: list[Address] = []
    redrawn: list[Address] = []
    pinned: list[Address] = []
    states: dict[str, Mapping[str, str]] = {}
    compare_fields(sides)
    old_names = {new: old for old, new in renamed.items()}
    names = [renamed.get(name, name) for name in before.branches]
    for name in merged(names, list(after.branches)):
        old = old_names.get(name, name)
        one, other = before.branches.get(old), after.branches.get(name)
        if one is not None and other is not None:
            pair = BranchSides(sides, one, other, renamed_states(one, other))
            states[old] = _compare_branch(pair)
            moved.extend(moved_states(pair))
            redrawn.extend(redrawn_operations(pair))
            pinned.extend(pinned_states(pair))
        elif one is not None:
            sides.changes.append(_whole(one, ChangeKind.REMOVED))
        elif other is not None:
            sides.changes.append(_whole(other, ChangeKind.ADDED))
    compare_order(sides)
    changes = tuple(one for one in sides.changes if one.what != "field")
    fields = tuple(one for one in sides.changes if one.what == "field")
    layout = tuple(moved), tuple(redrawn)
    return Difference(
        before, after, changes, *layout, renamed, states, fields, pinned=tuple(pinned)
    )


def _compare_branch(pair: BranchSides) -> Mapping[str, str]:
    before, after = pair.before, pair.after
    if before is after:
        return pair.states
    if before.name != after.name:
        words = f"The State Branch {before.name} is now called {after.name}."
        pair.add(
            Change(
                ChangeKind.RENAMED,
                "branch",
                before.address,
                after.address,
                words,
                old=before.name,
                new=after.name,
                path_before=(before.name,),
                path_after=(after.name,),
            )
        )
    compare_header(pair)
    compare_states(pair)
    compare_notes(pair)
    return pair.states


def _whole(branch: StateBranch, kind: ChangeKind) -> Change:
    size = f"{_count(len(branch.table), 'state')} and {_count(branch.edge_count, 'operation')}"
    words = f"The State Branch {branch.name} is {kind.value}, with {size}."
    path = (branch.name,)
    if kind is ChangeKind.REMOVED:
        return Change(kind, "branch", branch.address, None, words, path_before=path)
    return Change(kind, "branch", None, branch.address, words, path_after=path)


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
