"""Edits of an SB's HEADER: INITIAL, ACTIVATING, NUM_FACTS, and the sub-SBs of its facts."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from smsl_studio.blueprint.editing.draft import Draft, branch_of
from smsl_studio.blueprint.facts import shape_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import sub_entries
from smsl_studio.blueprint.wrong_kinds import kind_of
from smsl_studio.errors import EditRefused, did_you_mean

Json = Any


def set_header(blueprint: Blueprint, branch: str, key: str, value: str | int | None) -> Blueprint:
    """Set INITIAL, ACTIVATING, NUM_FACTS or NUM_STATES. None restores the default. EditRefused for
    a value that does not fit.
    """
    found = branch_of(blueprint, branch)
    if key in ("INITIAL", "ACTIVATING"):
        _check_state(found, key, value)
    elif key == "NUM_FACTS":
        _check_num_facts(found, value)
    elif key == "NUM_STATES":
        if value is not None and (type(value) is not int or value != len(found.table)):
            raise EditRefused(
                f"{branch} has {len(found.table)} states, so NUM_STATES cannot be {value}",
                advice="Leave NUM_STATES out, or write the right number.",
            )
    else:
        raise EditRefused(
            f"{key} is no header key that is set here",
            advice="Use attach and detach for SUB_SBS.",
        )
    draft = Draft(blueprint)
    if value is not None:
        draft.header(branch)[key] = value
    elif key in found.header.odd or getattr(found.header, key.lower()) is not None:
        del draft.header(branch)[key]
    after = draft.done()
    _check_digits(found, after[branch])
    return after


def attach_sub(blueprint: Blueprint, base: str, digit: int, sub: str) -> Blueprint:
    """Let ``sub`` expand fact ``digit`` (from 0) of ``base``. EditRefused if the digit does not
    exist or is taken, or if a cycle would arise.
    """
    found = branch_of(blueprint, base)
    branch_of(blueprint, sub)
    count = found.header.num_facts or found.num_facts
    if not 0 <= digit < count:
        raise EditRefused(
            f"{base} has {count} facts, so it has no digit {digit}",
            advice=f"Choose a digit from 0 to {count - 1}.",
        )
    for other, taken in found.header.sub_sbs:
        if other == sub:
            raise EditRefused(
                f"{sub} already expands digit {taken} of {base}", advice="Detach it first."
            )
        if taken == digit:
            raise EditRefused(
                f"digit {digit} of {base} is already expanded by {other}",
                advice=f"Detach {other} first, or choose another digit.",
            )
    path = _path(blueprint, sub, base)
    if path:
        raise EditRefused(
            f"{base} cannot stand above {sub}: {' > '.join((base, *path))} would be a cycle",
            advice="Choose an SB that does not lead back here.",
        )
    draft = Draft(blueprint)
    header = draft.header(base)
    written = header.get("SUB_SBS")
    if "SUB_SBS" in found.header.odd:
        raise EditRefused(
            f"SUB_SBS of {base} is {kind_of(written)}, not a map from sub-SBs to digits",
            advice="Take SUB_SBS out first.",
        )
    if isinstance(written, list) and written:
        header["SUB_SBS"] = [*written, {sub: digit}]
    else:
        header["SUB_SBS"] = {**(written or {}), sub: digit}
    return draft.done()


def detach_sub(blueprint: Blueprint, base: str, sub: str) -> Blueprint:
    """Let ``sub`` expand no fact of ``base`` any more. EditRefused if it expands none."""
    found = branch_of(blueprint, base)
    subs = [name for _, name, _ in sub_entries(found.header.subs_as_written)]
    if sub not in subs:
        raise EditRefused(f"{sub} expands no fact of {base}", advice=did_you_mean(sub, subs))
    draft = Draft(blueprint)
    drop_sub(draft, base, sub)
    return draft.done()


def drop_sub(draft: Draft, base: str, sub: str) -> None:
    """Remove ``sub`` from SUB_SBS, and an empty SUB_SBS from the HEADER."""
    header = draft.header(base)
    written = header.get("SUB_SBS")
    left: Json
    if isinstance(written, list):
        emptied = [_without(item, sub) for item in written]
        left = [now for was, now in zip(written, emptied, strict=True) if now or not was]
    else:
        left = {k: v for k, v in (written or {}).items() if k != sub}
    if left:
        header["SUB_SBS"] = left
    else:
        header.pop("SUB_SBS", None)


def _without(item: Json, sub: str) -> Json:
    return {k: v for k, v in item.items() if k != sub} if isinstance(item, dict) else item


def _check_state(branch: StateBranch, key: str, value: object) -> None:
    if value is not None and value not in branch.table:
        raise EditRefused(
            f"{key} must name a state of {branch.name}, and {value!r} is none",
            advice=did_you_mean(str(value), branch.table),
        )


def _check_num_facts(branch: StateBranch, value: object) -> None:
    if value is None:
        return
    if type(value) is not int or value < 1:
        raise EditRefused("NUM_FACTS must be a whole number above 0", advice="Write 1 or more.")
    shape = shape_of(branch.table, value)
    if branch.table and shape.misfits:
        raise EditRefused(
            f"the name {shape.misfits[0]!r} cannot be cut into {value} facts of equal length",
            advice="Choose a number that divides the fact part of every state's name.",
        )


def _check_digits(before: StateBranch, after: StateBranch) -> None:
    """Raise EditRefused if a sub-SB would lose the digit that it expands."""
    for sub, digit in after.header.sub_sbs:
        if digit < before.num_facts and digit >= (after.header.num_facts or after.num_facts):
            raise EditRefused(
                f"{sub} expands digit {digit} of {after.name}, which would be gone",
                advice=f"Detach {sub} first.",
            )


def _path(blueprint: Blueprint, start: str, goal: str) -> tuple[str, ...]:
    """Return the SBs on a path down from ``start`` to ``goal``, with both. Empty if there is
    none.
    """
    ways: list[tuple[str, ...]] = [(start,)]
    seen = {start}
    while ways:
        way = ways.pop()
        if way[-1] == goal:
            return way
        if way[-1] not in blueprint.branches:
            continue
        for sub, _ in blueprint[way[-1]].header.sub_sbs:
            if sub not in seen:
                seen.add(sub)
                ways.append((*way, sub))
    return ()


def keep_activating(before: Blueprint, after: Blueprint, branches: Collection[str]) -> Blueprint:
    """Return ``after`` in which ACTIVATING stays the same state, although states were added at the
    end.

    Without a written ACTIVATING the last state is activating. A state that is added would replace
    it, and nobody has asked for that. So ACTIVATING is written. Any other SB than these
    ``branches`` is just being drawn. There the last state takes over while people only go on with
    the drawing: while there is at most one state, while no state has an operation, and where the
    former activating state had none and leads to the new one now.
    """
    for name, former in before.branches.items():
        branch = after.branches.get(name)
        if branch is None or former is branch or len(former.table) < 2:
            continue
        written = branch.header.activating is not None or "ACTIVATING" in branch.header.odd
        took_over = branch.activating not in former.table and former.activating in branch.table
        if not took_over or written or (name not in branches and _goes_on(former, branch)):
            continue
        after = set_header(after, name, "ACTIVATING", former.activating)
    return after


def _goes_on(before: StateBranch, after: StateBranch) -> bool:
    """Whether new states only go on with an SB: before, it had no operations, or they follow from
    its activating state, from which no operation started."""
    if not any(before.table.values()):
        return True
    if before.table.get(before.activating):
        return False
    reached, new = {before.activating}, True
    while new:
        leading = {to for state in reached for to in after.table.get(state, {}).values()}
        new = not leading <= reached
        reached |= leading
    return after.activating in reached
