"""Resolves addresses that people write to elements that exist in a blueprint."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import AddressError, UsageError, did_you_mean

Written = str | Address


def state_at(blueprint: Blueprint, text: Written, branch: str | None = None) -> Address:
    """Return the address of a state, written ``SB/State``, or ``State`` if the SB is given by
    ``branch`` or is the only root.

    AddressError if there is no such element, UsageError if the element is no state.
    """
    if branch is not None and isinstance(text, str):
        own = blueprint[branch]
        if text in own.table:
            return Address(branch, text)
        parts = Address.split(text)
        if len(parts) == 1 and parts[0] not in own.table:
            raise AddressError(
                f"there is no state {parts[0]!r} in {branch}",
                advice=did_you_mean(parts[0], own.table),
            )
        if len(parts) == 1:
            return Address(branch, parts[0])
    found = _resolve(blueprint, text)
    if not found.state or found.operation:
        raise UsageError(f"{text} is no state", advice="Write SB/State.")
    if branch is not None and found.branch != branch:
        raise UsageError(f"{text} is no state of {branch}", advice="Leave --sb out, or name it.")
    return found


def states_at(
    blueprint: Blueprint, written: Written | Iterable[Written] | None, what: str
) -> tuple[Address, ...]:
    """Return the addresses of several states, at most one for each SB.

    UsageError for a second state of an SB; ``what`` names the states in its message.
    """
    if written is None:
        return ()
    texts: Sequence[Written]
    texts = [written] if isinstance(written, str | Address) else list(written)
    found = [state_at(blueprint, text) for text in texts]
    for index, address in enumerate(found):
        if any(address.branch == other.branch for other in found[:index]):
            raise UsageError(
                f"{address.branch} has two {what}s", advice=f"Give one {what} for each SB."
            )
    return tuple(found)


def operations_at(blueprint: Blueprint, written: Iterable[Written]) -> tuple[Address, ...]:
    """Return the addresses of operations, written ``SB/State/Operation``.

    A state means all operations that lead out of it. The name of an operation, alone or after its
    SB, means every edge with this name. AddressError for an unknown element. UsageError for an SB,
    because no operation of it would remain.
    """
    found: list[Address] = []
    for text in written:
        try:
            address = _resolve(blueprint, text)
        except AddressError:
            named = _named(blueprint, text)
            if not named:
                raise
            found += named
            continue
        if not address.state:
            raise UsageError(f"{text} is no operation", advice="Write SB/State/Operation.")
        if address.operation:
            found.append(address)
        else:
            out = blueprint[address.branch].table[address.state]
            found += [Address(address.branch, address.state, name) for name in out]
    return tuple(found)


def _resolve(blueprint: Blueprint, text: Written) -> Address:
    """Return the address of an element that exists. A ``/`` inside a name may be written as it
    is."""
    try:
        return blueprint.resolve(text)
    except AddressError:
        found = _as_spelt(blueprint, text) if isinstance(text, str) else []
        if len(found) != 1:
            raise
        return found[0]


def _as_spelt(blueprint: Blueprint, text: str) -> list[Address]:
    """Return the states and operations whose joined names are equal to this text."""
    if "/" not in text and "~" not in text:
        return []
    found: list[Address] = []
    for branch in blueprint:
        rests = [text] if blueprint.roots == (branch.name,) else []
        if text.startswith(f"{branch.name}/"):
            rests.append(text.removeprefix(f"{branch.name}/"))
        for rest in rests:
            for state, operations in branch.table.items():
                name = rest.removeprefix(f"{state}/")
                if rest == state:
                    found.append(Address(branch.name, state))
                elif name != rest and name in operations:
                    found.append(Address(branch.name, state, name))
    return found


def _named(blueprint: Blueprint, text: Written) -> list[Address]:
    """Return every edge with this operation name. An SB before the name limits them to this SB."""
    if isinstance(text, Address):
        return []
    parts = Address.split(text)
    return [
        edge.address
        for branch in blueprint
        for edge in branch.edges()
        if parts in ((edge.name,), (branch.name, edge.name))
    ]
