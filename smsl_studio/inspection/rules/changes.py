"""The rule about what has changed since another version of the blueprint (R27)."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import Change, ChangeKind, Difference, compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.property import KEY
from smsl_studio.inspection.rules.finding import Remark, Severity

HAZARDS = "_hazards"

ORDER = (
    ChangeKind.REMOVED,
    ChangeKind.RETARGETED,
    ChangeKind.RENAMED,
    ChangeKind.CHANGED,
    ChangeKind.ADDED,
)
"""Removals come first, because no other rule can see what is no longer there."""

_ADVICE = "look whether it was meant"


def r27_changed_since(blueprint: Blueprint, other: Blueprint) -> Iterator[Remark]:
    """R27: each change of meaning since another version, removals first.

    What was removed has its former address, and the place of the nearest element above it that is
    still there.
    """
    yield from remarks_of(blueprint, compare(other, blueprint))


def remarks_of(blueprint: Blueprint, difference: Difference) -> Iterator[Remark]:
    """Return the remarks about a difference, removals first. Their places are in ``blueprint``."""
    changes = sorted(difference.changes, key=lambda one: ORDER.index(one.kind))
    for change in changes:
        path = change.path_after or change.path_before
        home = blueprint.home(path[0]) if path else blueprint.document
        words = change.words.removesuffix(".")
        words = f"{words[:1].lower()}{words[1:]}" if words.startswith("The ") else words
        yield Remark(
            "R27",
            Severity.WARNING,
            _address(blueprint, change),
            f"since {difference.before.file} {words}",
            _ADVICE,
            spot=(home, path),
        )


def _address(blueprint: Blueprint, change: Change) -> Address:
    """Return the address of a change. What stands at file level has its key, and the order of SBs
    the first SB."""
    if change.address is not None:
        return change.address
    if change.what in ("hazard", "property"):
        return Address(HAZARDS if change.what == "hazard" else KEY, change.field)
    path = change.path_after or change.path_before
    return Address(path[0] if path else next(iter(blueprint.branches), change.field))
