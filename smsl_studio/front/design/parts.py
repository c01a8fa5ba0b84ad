"""States and operations of a blueprint, beside the words of a text from which they were made."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.sources import SourceWords, sources_at

MOST_PARTS = 1_000


@dataclass(frozen=True)
class MadePart:
    """An operation with the state that it leads to, or a state to which none leads.

    ``facts`` are the values of the state as they are written in its name, ``title`` is that of the
    state, and ``operation`` the name of the operation, empty for a state alone.
    """

    address: Address
    state: Address
    facts: str
    title: str
    operation: str
    sources: tuple[SourceWords, ...]


def made_parts(blueprint: Blueprint) -> tuple[MadePart, ...]:
    """Return the parts of a blueprint that cites texts, at most ``MOST_PARTS``; nothing if no part
    of it should cite one."""
    origin = blueprint.fields.get("_origin")
    of_text = isinstance(origin, Mapping) and origin.get("how") == "text"
    cites = [one for one in blueprint if of_text or "_sources" in one.fields]
    return tuple(islice((part for one in cites for part in _parts(blueprint, one)), MOST_PARTS))


def _parts(blueprint: Blueprint, branch: StateBranch) -> Iterator[MadePart]:
    reached = {target for row in branch.table.values() for target in row.values()}
    for state, row in branch.table.items():
        if state not in reached:
            yield _part(blueprint, branch, Address(branch.name, state), state)
        for name, target in row.items():
            yield _part(blueprint, branch, Address(branch.name, state, name), target)


def _part(blueprint: Blueprint, branch: StateBranch, at: Address, state: str) -> MadePart:
    note = branch.state_note(state) if state in branch.table else None
    facts = "".join(branch.facts(state)) if state in branch.table else ""
    return MadePart(
        at, Address(branch.name, state), facts or state,
        note.title if note is not None and note.title else state, at.operation or "",
        sources_at(blueprint, at),
    )  # fmt: skip
