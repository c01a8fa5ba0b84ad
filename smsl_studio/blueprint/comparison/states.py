"""Compares the states and operations of one SB."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.comparison.difference import Change, ChangeKind
from smsl_studio.blueprint.comparison.file_level import changed_fields
from smsl_studio.blueprint.comparison.sides import BranchSides
from smsl_studio.blueprint.comparison.values import merged

_TOLD = 6
"""The largest number of operations in the sentence about an added or removed state."""


def compare_states(pair: BranchSides) -> None:
    """Compare every state, and every operation of the states on both sides."""
    before, after = pair.before.table, pair.after.table
    old_names = {new: old for old, new in pair.states.items()}
    fields = pair.before.state_fields or pair.after.state_fields
    names = list(after)
    if len(before) != len(after) or before.keys() != after.keys():
        names = merged([pair.state(name) for name in before], names)
    for name in names:
        old = old_names.get(name, name)
        if old not in before:
            _whole(pair, ChangeKind.ADDED, name, after[name])
        elif name not in after:
            _whole(pair, ChangeKind.REMOVED, old, before[old])
        else:
            if old != name:
                _renamed(pair, old, name)
            if before[old] != after[name] or pair.states:
                _compare_operations(pair, old, name)
            if fields:
                _compare_fields(pair, old, name)


def _whole(pair: BranchSides, kind: ChangeKind, name: str, operations: Mapping[str, str]) -> None:
    told = ", ".join(f"{op} to {target}" for op, target in list(operations.items())[:_TOLD])
    more = f" and {len(operations) - _TOLD} more" if len(operations) > _TOLD else ""
    rest = f", with {told}{more}" if told else ""
    words = f"The state {name} of {pair.after.name} is {kind.value}{rest}."
    if kind is ChangeKind.REMOVED:
        at, path = pair.address_before(name), (pair.before.name, name)
        pair.add(Change(kind, "state", at, None, words, path_before=path))
    else:
        at, path = pair.address_after(name), (pair.after.name, name)
        pair.add(Change(kind, "state", None, at, words, path_after=path))


def _renamed(pair: BranchSides, old: str, new: str) -> None:
    pair.add(
        Change(
            ChangeKind.RENAMED,
            "state",
            pair.address_before(old),
            pair.address_after(new),
            f"The state {old} of {pair.after.name} is now called {new}.",
            old=old,
            new=new,
            path_before=(pair.before.name, old),
            path_after=(pair.after.name, new),
        )
    )


def _compare_operations(pair: BranchSides, old: str, new: str) -> None:
    one = {op: pair.state(target) for op, target in pair.before.table[old].items()}
    other = pair.after.table[new]
    if one == other:
        return
    renamed = _renamed_operations(one, other)
    back = {name: op for op, name in renamed.items()}
    for op in renamed:
        pair.operations[old, op] = renamed[op]
    for name in merged([renamed.get(op, op) for op in one], list(other)):
        op = back.get(name, name)
        if op not in one:
            _edge(pair, ChangeKind.ADDED, None, (new, name), "", other[name])
        elif name not in other:
            _edge(pair, ChangeKind.REMOVED, (old, op), None, pair.before.table[old][op], "")
        elif op != name:
            _edge(pair, ChangeKind.RENAMED, (old, op), (new, name), op, name)
        elif one[op] != other[name]:
            was = pair.before.table[old][op]
            _edge(pair, ChangeKind.RETARGETED, (old, op), (new, name), was, other[name])


def _renamed_operations(one: Mapping[str, str], other: Mapping[str, str]) -> dict[str, str]:
    """Return pairs of operations with different names and the same target. Several pairs are made
    in written order.
    """
    come: dict[str, deque[str]] = {}
    for name, target in other.items():
        if name not in one:
            come.setdefault(target, deque()).append(name)
    found: dict[str, str] = {}
    for op, target in one.items():
        if op not in other and come.get(target):
            found[op] = come[target].popleft()
    return found


Edge = tuple[str, str]


def _edge(
    pair: BranchSides, kind: ChangeKind, here: Edge | None, there: Edge | None, old: str, new: str
) -> None:
    at = pair.address_before(*here) if here else None
    to = pair.address_after(*there) if there else None
    state, name = there or here or ("", "")
    subject = f"The operation {name} of {pair.after.name}/{state}"
    if kind is ChangeKind.RENAMED:
        words = f"The operation {old} of {pair.after.name}/{state} is now called {new}."
    elif kind is ChangeKind.RETARGETED:
        words = f"{subject} leads to {new} instead of {old}."
    else:
        words = f"{subject} is {kind.value} (it {'leads' if there else 'led'} to {new or old})."
    pair.add(
        Change(
            kind,
            "operation",
            at,
            to,
            words,
            old=old or None,
            new=new or None,
            path_before=at.path if at else (),
            path_after=to.path if to else (),
        )
    )


def _compare_fields(pair: BranchSides, old: str, new: str) -> None:
    one: Mapping[str, Any] = pair.before.state_fields.get(old, {})
    other: Mapping[str, Any] = pair.after.state_fields.get(new, {})
    if one or other:
        at, to = pair.address_before(old), pair.address_after(new)
        pair.sides.changes.extend(
            changed_fields(one, other, str(to), at.path, to.path, before=at, after=to)
        )
