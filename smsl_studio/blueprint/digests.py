"""The digests of a blueprint. They identify it, and an approval signs them.

No digest covers ``_layout``, comments, the name and the form of the file, NUM_STATES, unknown
header keys or other ``_`` fields. The order of SBs counts. That of states and operations counts
only where it decides a default.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from smsl_studio.blueprint.behaviour import behaviour_of, behaviour_values
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
    own = _own(blueprint)
    behaviour = behaviour_of(own) if blueprint.imported else blueprint.behaviour
    imported = [behaviour_of(_brought(blueprint)), *_said_elsewhere(blueprint)]
    return _joined(behaviour, _said(blueprint), imported, _missing(blueprint))


def content_of(blueprint: Blueprint) -> dict[str, Json]:
    """Return the plain values from which the digests are computed. Other programs can check them.

    ``behaviour`` and ``meaning``: their canonical bytes give the digests of these names.
    ``imported`` has the SBs of imported files, and then the annotations of these files. ``missing``
    are imports that failed.
    """
    return {
        "behaviour": behaviour_values(_own(blueprint)),
        "meaning": _said(blueprint),
        "imported": [behaviour_values(_brought(blueprint)), *_said_elsewhere(blueprint)],
        "missing": _missing(blueprint),
    }


def digests_of(content: Mapping[str, Json]) -> Digests:
    """Return the digests of a content (see ``content_of``)."""
    brought, *said = content["imported"]
    imported = [digest_of(brought), *said]
    return _joined(
        digest_of(content["behaviour"]), content["meaning"], imported, content["missing"]
    )


def _joined(behaviour: str, said: list[Json], imported: list[Json], missing: list[Json]) -> Digests:
    meaning = digest_of(said)
    closure = {
        "behaviour": behaviour,
        "meaning": meaning,
        "imported": imported,
        "missing": missing,
    }
    return Digests(behaviour, meaning, digest_of(closure))


def _own(blueprint: Blueprint) -> list[StateBranch]:
    return [one for one in blueprint if one.name not in blueprint.imported]


def _brought(blueprint: Blueprint) -> list[StateBranch]:
    return [one for one in blueprint if one.name in blueprint.imported]


def _said(blueprint: Blueprint) -> list[Json]:
    """Return the annotations of the file itself, as plain values."""
    said = [_notes(_own(blueprint)), hazards_meaning(blueprint.fields.get("_hazards"))]
    levels = levels_meaning(levels_written(blueprint.document))
    own = said if levels is None else [*said, levels]
    return [*own, *_properties(blueprint.document)]


def _said_elsewhere(blueprint: Blueprint) -> list[Json]:
    """Return the annotations of imported files, and the hazards of all files, as plain values."""
    said = [_notes(_brought(blueprint)), blueprint.meaning["hazards"]]
    levels = levels_meaning(levels_written(*blueprint.documents[1:]))
    theirs = said if levels is None else [*said, levels]
    return [*theirs, *_properties(*blueprint.documents[1:])]


def _missing(blueprint: Blueprint) -> list[Json]:
    return sorted(map(_as_written, blueprint.import_faults))


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
