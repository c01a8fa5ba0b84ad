"""The rule about sources (R32): a part of a generated blueprint that cites no words of a text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.sources import sources_of
from smsl_studio.inspection.rules.finding import LISTED, Remark, Severity
from smsl_studio.inspection.rules.words import counted, some

ADVICE = "cite a line of a text in _sources, or take it out"


def r32_no_source(blueprint: Blueprint) -> Iterator[Remark]:
    """R32: a state or an operation without a source, in an SB that was made of a text.

    SBs without ``_sources`` are passed over unless the file says that it was made of a text.
    """
    for branch in blueprint:
        bare = list(_uncited(blueprint, branch))
        if bare:
            names = tuple(one.operation or one.state for one in bare)
            has = "has no source" if len(bare) == 1 else "have no source"
            yield Remark(
                "R32",
                Severity.WARNING,
                bare[0],
                f"{counted(len(bare), 'element')} ({some(names)}) {has}",
                advice=ADVICE,
                others=bare[1:LISTED],
            )


def uncited(blueprint: Blueprint) -> Iterator[Address]:
    """Yield the states and operations without a source, where a text is the origin. Of edges with
    one name and one source in ``_sources`` each counts."""
    for branch in blueprint:
        yield from _uncited(blueprint, branch)


def cited_parts(blueprint: Blueprint) -> Iterator[Address]:
    """Yield the states and operations that may have a source."""
    for branch in blueprint:
        for state, row in branch.table.items():
            yield Address(branch.name, state)
            yield from (Address(branch.name, state, name) for name in row)


def _uncited(blueprint: Blueprint, branch: StateBranch) -> Iterator[Address]:
    origin = blueprint.fields.get("_origin")
    of_text = isinstance(origin, Mapping) and origin.get("how") == "text"
    if not of_text and "_sources" not in branch.fields:
        return
    for state, row in branch.table.items():
        if not sources_of(branch, state):
            yield Address(branch.name, state)
        for name in row:
            if not sources_of(branch, note_key(name, state), note_key(name)):
                yield Address(branch.name, state, name)
