"""The digests of a blueprint. They identify it, and an approval signs them.

No digest covers ``_layout``, comments, the name and the form of the file, NUM_STATES, unknown
header keys or other ``_`` fields. The order of SBs counts. That of states and operations counts
only where it decides a default.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from smsl_studio.blueprint.behaviour import behaviour_of
from smsl_studio.blueprint.meaning import (
    hazards_meaning,
    levels_meaning,
    levels_written,
    properties_meaning,
    word_for_word,
)
from smsl_studio.blueprint.model import Blueprint, ImportFault, StateBranch
from smsl_studio.seal.digest import digest_of
from smsl_studio.smsl.document import Document

Json = Any


@dataclass(frozen=True, slots=True)
class Digests:
    """SHA-256 in hexadecimal, over canonical bytes in which defaults are explicit.

    ``behaviour`` covers the file's own SBs, states, operations and headers. ``meaning`` covers its
    annotations. ``closure`` covers both, also for everything that the file imports.
    """

    behaviour: str
    meaning: str
    closure: str

    def as_json(self) -> dict[str, str]:
        """Return the three digests by their names."""
        return asdict(self)


def digests(blueprint: Blueprint) -> Digests:
    """Return all three digests. Without a world the closure has no library code."""
    own = [one for one in blueprint if one.name not in blueprint.imported]
    behaviour = behaviour_of(own) if blueprint.imported else blueprint.behaviour
    said = [_notes(own), hazards_meaning(blueprint.fields.get("_hazards"))]
    levels = levels_meaning(levels_written(blueprint.document))
    properties = _properties(blueprint.document)
    meaning = digest_of([*(said if levels is None else [*said, levels]), *properties])
    brought = [one for one in blueprint if one.name in blueprint.imported]
    imported = [behaviour_of(brought), _notes(brought), blueprint.meaning["hazards"]]
    theirs = levels_meaning(levels_written(*blueprint.documents[1:]))
    closure = {
        "behaviour": behaviour,
        "meaning": meaning,
        "imported": [
            *(imported if theirs is None else [*imported, theirs]),
            *_properties(*blueprint.documents[1:]),
        ],
        "missing": sorted(map(_as_written, blueprint.import_faults)),
    }
    return Digests(behaviour, meaning, digest_of(closure))


def _properties(*documents: Document) -> list[Json]:
    """Return what the digest covers of ``_properties``. Without any, digests are as they were."""
    said = properties_meaning(*documents)
    return [] if said is None else [["properties", said]]


def _notes(branches: Iterable[StateBranch]) -> Json:
    return [[one.name, one.meaning["notes"]] for one in branches if one.meaning["notes"]]


def _as_written(fault: ImportFault) -> str:
    """Return the failed import as the file names it."""
    value: Json = fault.document.values
    for key in fault.path:
        value = value[int(key)] if isinstance(value, list) else value[key]
    return word_for_word(value)
