"""Writes beside each line of a reading from which words of a text it was made."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.sources import sources_at
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection
from smsl_studio.inspection.rules.sources import uncited

NO_SOURCE = "No source"
MOST = 3
"""The largest number of sources beside a line. The file has all of them."""


def with_sources(
    blueprint: Blueprint, sections: Iterable[ReadingSection]
) -> tuple[ReadingSection, ...]:
    """Return sections in which each line has its sources. The key of a line stays as it is."""
    bare = frozenset(uncited(blueprint))
    if not bare and not any("_sources" in branch.fields for branch in blueprint):
        return tuple(sections)

    def sourced(line: ReadingLine) -> ReadingLine:
        cited = dict.fromkeys(
            str(source) for address in line.about for source in sources_at(blueprint, address)
        )
        told = tuple(cited)[:MOST]
        if not told and any(address in bare for address in line.about):
            told = (NO_SOURCE,)
        return replace(line, sources=told, inner=tuple(map(sourced, line.inner)))

    return tuple(replace(one, lines=tuple(map(sourced, one.lines))) for one in sections)
