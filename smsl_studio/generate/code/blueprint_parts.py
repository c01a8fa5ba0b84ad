"""What the code of a blueprint says of the whole blueprint, whatever the target.

Names of files are without folders, so that equal blueprints give equal code anywhere.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.digests import Digests, digests
from smsl_studio.blueprint.hazards import GuardHazard, guard_hazards
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.errors import RunRefused
from smsl_studio.library.bound import leaf_facts
from smsl_studio.runlog.grounds import BoundCode, grounds_of
from smsl_studio.runlog.names import names_of
from smsl_studio.seal.digest import sha256_hex

Json = Any


@dataclass(frozen=True)
class CodeRequest:
    """What code is made of: the blueprint, and what was said beside it.

    ``name`` is the name of the package, ``licence`` the text at the top of every file, ``record``
    the bytes of the inspection record. ``findings`` is what inspection found, in words.
    ``left_out`` are annotations that cannot be read.
    """

    blueprint: Blueprint
    name: str
    version: str
    licence: str = ""
    record: bytes = b""
    findings: str = ""
    left_out: tuple[tuple[str, str], ...] = ()

    @property
    def file_name(self) -> str:
        """The name of the blueprint's file, without its folder."""
        return PurePath(self.blueprint.file).name

    @property
    def digests(self) -> Digests:
        """The digests of the blueprint."""
        return digests(self.blueprint)

    @property
    def record_digest(self) -> str:
        """SHA-256 of the record, empty without one."""
        return sha256_hex(self.record) if self.record else ""

    @property
    def hazards(self) -> tuple[GuardHazard, ...]:
        """The hazards that guard a run."""
        return guard_hazards(self.blueprint)


def refuse_what_is_not_generated(blueprint: Blueprint) -> None:
    """Raise RunRefused, with the place, for what generated code cannot carry out."""
    Hierarchy(blueprint)
    for edge in procedures_of(blueprint).bound:
        raise RunRefused(
            f"{edge} runs a blueprint of its own, and code for that is not generated",
            blueprint.place(edge),
            "Generate code for that blueprint by itself, or bind the operation to a function.",
        )
    if Levels(blueprint).forecasts:
        # A package has no second world, and a guard must not be left out in silence.
        raise RunRefused(
            "the blueprint asks for forecasts, and code for those is not generated",
            advice="Take forecast out of _levels and _operations of a copy.",
        )


def identity(request: CodeRequest, functions: Mapping[Address, str]) -> dict[str, Json]:
    """Return the part of a log's header that is always the same (see ``front.run_header``)."""
    blueprint = request.blueprint
    sensed = [(branch.name, digit) for branch, digit in leaf_facts(blueprint)]
    code = BoundCode(sensed, functions.get)
    others = {PurePath(one.file).name: sha256_hex(one.encoded()) for one in blueprint.documents[1:]}
    return {
        "file": request.file_name,
        "digests": {
            "file": sha256_hex(blueprint.document.encoded()),
            **request.digests.as_json(),
            **({"imported": others} if others else {}),
        },
        "versions": {"smsl-studio": request.version},
        "names": names_of(blueprint),
        "grounds": grounds_of(blueprint, code),
    }


def counted(branch: StateBranch) -> str:
    """Return the numbers of states and operations of an SB in words."""
    states, edges = len(branch.table), branch.edge_count
    return (
        f"{states:,} {'state' if states == 1 else 'states'}, "
        f"{edges:,} {'operation' if edges == 1 else 'operations'}"
    )


def sensed_digits(branch: StateBranch) -> Collection[int]:
    """Return the digits of an SB that no sub-SB expands."""
    return [digit for digit in range(branch.num_facts) if digit not in branch.subs]


def asks_people(blueprint: Blueprint) -> bool:
    """Return whether a run asks people for a fact, an operation or a confirmation."""
    for branch in blueprint:
        notes = branch.notes.operations.values()
        if any(one.actor in ("human", "shared") or one.confirm for one in notes):
            return True
        facts = map(branch.fact_note, sensed_digits(branch))
        if any(one is not None and one.aggregation == "human" for one in facts):
            return True
    return "human" in blueprint.levels.values()
