"""The section of a reading with the notation of the paper (Eq. 2 to 5), for engineers."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.notation import notation_of
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection

MOST = 400
"""The largest number of definitions of an SB."""


def in_notation(blueprint: Blueprint) -> ReadingSection:
    """Return the facts, state checks and operations of each SB in the notation of the paper."""
    lines = tuple(_line(blueprint, branch) for branch in blueprint if branch.table)
    return ReadingSection("notation", "In the notation of the paper", lines)


def _line(blueprint: Blueprint, branch: StateBranch) -> ReadingLine:
    said: dict[str, None] = {}
    for line in _definitions(blueprint, branch):
        if line not in said and len(said) == MOST:
            said["More definitions are left out here."] = None
            break
        said[line] = None
    return ReadingLine(branch.name, tuple(said), about=(Address(branch.name),))


def _definitions(blueprint: Blueprint, branch: StateBranch) -> Iterator[str]:
    """Yield the facts, the state checks, and the operations. Some come twice."""
    yield from notation_of(blueprint, str(branch.address))
    for state in branch.table:
        yield from notation_of(blueprint, str(Address(branch.name, state)))
    for edge in branch.edges():
        yield notation_of(blueprint, str(edge.address))[0]
