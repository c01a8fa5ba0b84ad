"""The differences that a person has refused, kept for each file of a drawing."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import astuple
from pathlib import Path
from typing import Any

from smsl_studio.front.rule_differences import RuleDifference
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.studio.base.settings import Settings

_PLACE = "rule_refusals/"
_KINDS = ("missing", "odd", "target")
_PARTS = 4


def refusals_of(settings: Settings, path: Path | None) -> set[RuleDifference]:
    """Return what was refused in the drawing of a file; nothing for one that was never saved."""
    if path is None:
        return set()
    try:
        told: Any = json.loads(settings.text_of(_place(path)) or "[]")
    except (ValueError, RecursionError):
        return set()
    rows = told if isinstance(told, list) else []
    return {RuleDifference(*row) for row in rows if _is_difference(row)}


def keep_refusals(settings: Settings, path: Path, refused: Iterable[RuleDifference]) -> None:
    """Store what is refused in the drawing of a file."""
    text = json.dumps(sorted(astuple(one) for one in refused)) if refused else ""
    if settings.text_of(_place(path)) != text:
        settings.store_text(_place(path), text)


def _is_difference(row: Any) -> bool:
    whole = isinstance(row, list) and len(row) == _PARTS
    return whole and all(isinstance(one, str) for one in row) and row[0] in _KINDS


def _place(path: Path) -> str:
    return _PLACE + sha256_hex(str(path).encode())[:32]
