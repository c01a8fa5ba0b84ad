"""Finds the element of a blueprint for a written address."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Protocol

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import AddressError, did_you_mean


class NamedBranch(Protocol):
    """A State Branch (``model.StateBranch``): its name and the names in it."""

    @property
    def name(self) -> str:
        """The name of the SB."""

    @property
    def table(self) -> Mapping[str, Mapping[str, str]]:
        """For each state its operations, and the target of each."""


class NamedElements(Protocol):
    """A blueprint (``model.Blueprint``): its State Branches and roots."""

    @property
    def branches(self) -> Mapping[str, NamedBranch]:
        """The SBs by name."""

    @property
    def roots(self) -> tuple[str, ...]:
        """The names of the SBs that are in no SUB_SBS."""

    def __getitem__(self, branch: str) -> NamedBranch: ...
    def __iter__(self) -> Iterator[NamedBranch]: ...


def resolved(blueprint: NamedElements, text: str | Address) -> Address:
    """See ``Blueprint.resolve``."""
    parts = text.path if isinstance(text, Address) else Address.split(text)
    if parts and parts[0] not in blueprint.branches and len(blueprint.roots) == 1:
        root = blueprint[blueprint.roots[0]]
        if parts[0] in root.table:
            parts = (root.name, *parts)
        elif len(parts) == 1 and parts[0]:
            raise AddressError(
                f"there is neither a State Branch nor a state {parts[0]!r}",
                advice=_homes(blueprint, parts)
                or did_you_mean(parts[0], [*blueprint.branches, *root.table]),
            )
    if not 1 <= len(parts) <= 3 or not all(parts):
        raise AddressError(
            f"{text!s} is no address", advice="Write SB, SB/State or SB/State/Operation."
        )
    if parts[0] not in blueprint.branches and (homes := _homes(blueprint, parts)):
        raise AddressError(f"there is no State Branch {parts[0]!r}", advice=homes)
    branch = blueprint[parts[0]]
    if len(parts) > 1 and parts[1] not in branch.table:
        raise AddressError(
            f"there is no state {parts[1]!r} in {branch.name}",
            advice=did_you_mean(parts[1], branch.table),
        )
    if len(parts) > 2 and parts[2] not in branch.table[parts[1]]:
        raise AddressError(
            f"there is no operation {parts[2]!r} in {branch.name}/{parts[1]}",
            advice=did_you_mean(parts[2], branch.table[parts[1]]),
        )
    return Address(*parts)


def _homes(blueprint: NamedElements, parts: tuple[str, ...]) -> str:
    """Return an advice to write the SB before a state that some SBs have, or the empty text."""
    found = [Address(one.name, *parts[:2]) for one in blueprint if parts[0] in one.table]
    return f"Write {' or '.join(map(str, found[:3]))}." if found and len(parts) < 3 else ""
