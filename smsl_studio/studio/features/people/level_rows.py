"""The levels of a blueprint as rows: the subject, the declared level, and its source."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address, fact_text, note_key
from smsl_studio.blueprint.continuum import GENERATION, INSPECTION, SUPERVISION
from smsl_studio.blueprint.levels import Levels, digit_of, sensed_facts
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.base.words import counted

IN_FILE, DEFAULT = "_levels", "default"


@dataclass(frozen=True)
class LevelRow:
    """One row. ``key`` is a key of ``Levels``; ``levels`` has one level for each edge of the row.

    ``source`` says where they come from: ``_levels``, a word of an annotation, or ``default``.
    """

    key: str
    kind: str
    name: str
    place: str
    levels: tuple[str, ...]
    source: str

    @property
    def declared(self) -> str:
        """The declared level in words; several levels if the edges differ."""
        return " and ".join(dict.fromkeys(self.levels))


def level_rows(blueprint: Blueprint, each_edge: bool = False) -> tuple[LevelRow, ...]:
    """The rows: inspection, supervision and generation, then the facts, then the operations of
    each SB.

    An operation has one row for its name. If its edges differ (or with ``each_edge``), each edge
    also has a row.
    """
    levels = Levels(blueprint)
    return (
        _layer(INSPECTION, levels.inspection, blueprint.levels),
        _layer(SUPERVISION, levels.supervision, blueprint.levels),
        _layer(GENERATION, levels.generation, blueprint.levels),
        *(_fact(blueprint, levels, name, digit) for name, digit in sensed_facts(blueprint)),
        *(row for branch in blueprint for row in _operations(branch, levels, blueprint, each_edge)),
    )


def _layer(key: str, level: str, written: Mapping[str, str]) -> LevelRow:
    source = IN_FILE if key in written else DEFAULT
    return LevelRow(key, "layer", key.capitalize(), "", (level,), source)


def _fact(blueprint: Blueprint, levels: Levels, name: str, digit: int) -> LevelRow:
    key, branch = fact_text(name, digit), blueprint[name]
    note = branch.fact_note(digit)
    source = DEFAULT
    if key in blueprint.levels:
        source = IN_FILE
    elif note is not None and note.aggregation == "human":
        source = "aggregation"
    level = (levels.fact(name, digit),)
    return LevelRow(key, "fact", branch.fact_name(digit), name, level, source)


def _operations(
    branch: StateBranch, levels: Levels, blueprint: Blueprint, each_edge: bool
) -> Iterator[LevelRow]:
    edges: dict[str, list[Address]] = {}
    for edge in branch.edges():
        edges.setdefault(edge.name, []).append(edge.address)
    written = blueprint.levels
    for name, addresses in edges.items():
        found = tuple(levels.operation(address) for address in addresses)
        key = f"{Address(branch.name)}/{note_key(name)}"
        # If an operation has the name of a digit, such a key names the fact and not the operation.
        whole = digit_of(branch, name) is None
        if whole:
            source = IN_FILE if key in written else _actor(branch, addresses[0])
            place = f"{branch.name}, {counted(len(addresses), 'edge')}"
            yield LevelRow(key, "operation", name, place, found, source)
        if (len(addresses) > 1 and (each_edge or len(set(found)) > 1)) or not whole:
            for address, level in zip(addresses, found, strict=True):
                source = IN_FILE if str(address) in written else _actor(branch, address)
                if whole and key in written and source != IN_FILE:
                    source = f"all {name}"
                yield LevelRow(
                    str(address), "edge", name, f"{branch.name}/{address.state}", (level,), source
                )


def _actor(branch: StateBranch, edge: Address) -> str:
    return "who acts" if branch.operation_note(edge.state, edge.operation).actor else DEFAULT
