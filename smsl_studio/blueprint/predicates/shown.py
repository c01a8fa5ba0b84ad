"""Predicates and units as people read them: a count has no unit ``1`` behind it."""

from __future__ import annotations

import re
from collections.abc import Mapping

_COUNT = re.compile(
    r"(?P<quoted>'(?:[^']|'')*')|(?P<bound>[<>]=?\s*-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)"
    r"\s+1(?=[\s)]|$)"
)


def shown_predicate(text: str) -> str:
    """Return a predicate without the unit of plain numbers: ``surgeons >= 1`` for
    ``surgeons >= 1 1``. Names in quotes stay as they are."""
    return _COUNT.sub(lambda match: match["quoted"] or match["bound"], text)


def shown_sources(sources: Mapping[str, str]) -> str:
    """Return sources with their units in words: ``force in N, surgeons``."""
    return ", ".join(name if unit == "1" else f"{name} in {unit}" for name, unit in sources.items())
