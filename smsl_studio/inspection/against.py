"""The inspection of a blueprint against another version of it (R27)."""

from __future__ import annotations

from collections.abc import Collection

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.rules.changes import r27_changed_since
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.inspection.selection import listed


def inspect_against(
    blueprint: Blueprint, other: Blueprint, rules: Collection[str] | None = None
) -> tuple[Finding, ...]:
    """Return what was removed, retargeted, renamed, changed and added since ``other``, in this
    order. ``rules`` are the numbers of the rules to check, None means all."""
    if rules is not None and "R27" not in rules:
        return ()
    return tuple(listed(blueprint, r27_changed_since(blueprint, other)))
