"""The new name of an element after an edit that renamed it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint


def first_branch(blueprint: Blueprint) -> str:
    """The SB that a window shows first; empty if the blueprint has none."""
    return next(iter(blueprint.roots), next(iter(blueprint.branches), ""))


def branch_now(before: Blueprint, after: Blueprint, branch: str) -> str:
    """The SB at the position of ``branch`` after an edit that renamed it; else the first SB."""
    names, now = list(before.branches), list(after.branches)
    if branch in names and len(names) == len(now):
        return now[names.index(branch)]
    return first_branch(after)


def same_branch(before: Blueprint, after: Blueprint, branch: str) -> str:
    """The name of an SB after an edit that renamed it; unchanged if it is gone."""
    return _name_now(before.branches, after.branches, branch)


def now_named(before: Blueprint, after: Blueprint, address: Address) -> Address:
    """The address of a state or operation after an edit; unchanged if the element is gone."""
    old, new = before.branches.get(address.branch), after.branches.get(address.branch)
    if old is None or new is None or address.state not in old.table:
        return address
    state = _name_now(old.table, new.table, address.state)
    if not address.operation or state not in new.table:
        return replace(address, state=state)
    operations = old.table[address.state], new.table[state]
    return replace(address, state=state, operation=_name_now(*operations, address.operation))


def _name_now(before: Collection[str], after: Collection[str], name: str) -> str:
    """The new name at the position of ``name``, if only names changed; else ``name``.

    Both arguments are tables, so the usual case (the name still exists) is fast.
    """
    if name in after or name not in before or len(before) != len(after):
        return name
    found = list(after)[list(before).index(name)]
    return name if found in before else found
