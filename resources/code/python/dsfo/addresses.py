"""Finds the elements that people name. The SB may be left out where there is one root."""

from __future__ import annotations

from collections.abc import Sequence

from .elements import Blueprint, address, parts
from .errors import UsageError, did_you_mean


def states_at(blueprint: Blueprint, written: Sequence[str], what: str) -> dict[str, str]:
    """Return the states that people name, at most one of each SB."""
    found: dict[str, str] = {}
    for text in written:
        branch, state = state_at(blueprint, text)
        if branch in found:
            raise UsageError(f"{branch} has two {what}s", f"Give one {what} for each SB.")
        found[branch] = state
    return found


def state_at(blueprint: Blueprint, text: str) -> tuple[str, str]:
    """Return the SB and the state that a text names."""
    names = _resolved(blueprint, text)
    if len(names) != 2:
        raise UsageError(f"{text} is no state", "Write SB/State.")
    return names[0], names[1]


def operations_at(blueprint: Blueprint, written: Sequence[str]) -> list[str]:
    """Return the addresses of operations. A state means all that lead out of it, the name of an
    operation all edges of this name.
    """
    found: list[str] = []
    for text in written:
        try:
            names = _resolved(blueprint, text)
        except UsageError:
            named = _named(blueprint, text)
            if not named:
                raise
            found += named
            continue
        if len(names) == 1:
            raise UsageError(f"{text} is no operation", "Write SB/State/Operation.")
        if len(names) == 3:
            found.append(address(*names))
        else:
            out = blueprint[names[0]].states[names[1]].operations
            found += [address(*names, name) for name in out]
    return found


def operation_at(blueprint: Blueprint, text: str) -> str:
    """Return the address of exactly one operation."""
    found = operations_at(blueprint, [text])
    if len(found) != 1:
        words = f"{text!r} stands for {len(found)} operations"
        raise UsageError(words, "Write SB/State/Operation.")
    return found[0]


def _resolved(blueprint: Blueprint, text: str) -> tuple[str, ...]:
    """Return the names of an element that exists. A ``/`` inside a name may be written as it is."""
    try:
        return _exact(blueprint, text)
    except UsageError:
        found = _as_spelt(blueprint, text)
        if len(found) != 1:
            raise
        return found[0]


def _roots(blueprint: Blueprint) -> list[str]:
    subs = {flag.sub for branch in blueprint for flag in branch.flags}
    return [name for name in blueprint.branches if name not in subs]


def _exact(blueprint: Blueprint, text: str) -> tuple[str, ...]:
    names, roots = parts(text), _roots(blueprint)
    if names[0] not in blueprint.branches and len(roots) == 1:
        own = blueprint[roots[0]].states
        if names[0] in own:
            names = (roots[0], *names)
        elif len(names) == 1:
            near = did_you_mean(names[0], [*blueprint.branches, *own])
            raise UsageError(f"there is neither a State Branch nor a state {names[0]!r}", near)
    if not 1 <= len(names) <= 3 or not all(names):
        raise UsageError(f"{text} is no address", "Write SB, SB/State or SB/State/Operation.")
    known: list[tuple[str, Sequence[str]]] = [("State Branch", list(blueprint.branches))]
    branch = blueprint.branches.get(names[0])
    states = branch.states if branch else {}
    known.append(("state", list(states)))
    state = states.get(names[1]) if len(names) > 1 else None
    known.append(("operation", list(state.operations) if state else []))
    for name, (what, every) in zip(names, known, strict=False):
        if name not in every:
            raise UsageError(f"there is no {what} {name!r}", did_you_mean(name, every))
    return names


def _as_spelt(blueprint: Blueprint, text: str) -> list[tuple[str, ...]]:
    found: list[tuple[str, ...]] = []
    for branch in blueprint:
        rests = [text] if _roots(blueprint) == [branch.name] else []
        if text.startswith(f"{branch.name}/"):
            rests.append(text[len(branch.name) + 1 :])
        for rest in rests:
            for state, one in branch.states.items():
                if rest == state:
                    found.append((branch.name, state))
                elif rest.startswith(f"{state}/") and rest[len(state) + 1 :] in one.operations:
                    found.append((branch.name, state, rest[len(state) + 1 :]))
    return found


def _named(blueprint: Blueprint, text: str) -> list[str]:
    names = parts(text)
    return [
        address(branch.name, state, name)
        for branch in blueprint
        for state, one in branch.states.items()
        for name in one.operations
        if names in ((name,), (branch.name, name))
    ]
