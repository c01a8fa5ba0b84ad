"""Writes the states and operations of a blueprint as text that other programs draw."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.left_out import told_of_left_out
from smsl_studio.picture.dot import as_dot
from smsl_studio.picture.mermaid import MOST_EDGES, as_mermaid
from smsl_studio.picture.part import PicturePart, whole_part
from smsl_studio.picture.picture import Picture


def as_dot_text(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as DOT (see ``picture.dot``)."""
    return as_dot(_parts(blueprint, findings))


def as_mermaid_text(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as a state diagram of Mermaid (see ``picture.mermaid``)."""
    if blueprint.operation_count > MOST_EDGES:
        words = f"Mermaid draws at most {MOST_EDGES} operations, unless its settings allow more."
        findings.add("size", "", words)
    return as_mermaid(_parts(blueprint, findings))


def _parts(blueprint: Blueprint, findings: ExchangeFindings) -> Sequence[PicturePart]:
    told_of_left_out(blueprint, findings)
    return [whole_part(Picture(blueprint, name)) for name in blueprint.branches]
