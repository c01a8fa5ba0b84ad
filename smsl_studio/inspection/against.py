"""The inspection of a blueprint against another version of it (R27)."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.comparison import Difference, compare
from smsl_studio.blueprint.digests import content_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.recorded import blueprint_of_content
from smsl_studio.inspection.rules.changes import ORDER, r27_changed_since, remarks_of
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


def inspect_against_content(
    blueprint: Blueprint, content: Mapping[str, Any], name: str
) -> tuple[Finding, ...]:
    """Return what has changed since a record was signed.

    ``content`` is the content of the blueprint in the record, and ``name`` the name of the record.
    What the content leaves out, such as the layout, is not compared. ReadError if the content is
    not that of a blueprint.
    """
    if content_of(blueprint) == content:
        return ()
    return tuple(listed(blueprint, remarks_of(blueprint, since_content(blueprint, content, name))))


def since_content(blueprint: Blueprint, content: Mapping[str, Any], name: str) -> Difference:
    """Return the difference from a signed content to the present blueprint, removals first.

    Its later side is the blueprint itself, with its layout. ReadError if the content is not that of
    a blueprint.
    """
    before = blueprint_of_content(content, name)
    found = compare(before, blueprint_of_content(content_of(blueprint), blueprint.file))
    changes = sorted(found.changes, key=lambda one: ORDER.index(one.kind))
    return replace(found, after=blueprint, changes=tuple(changes))
