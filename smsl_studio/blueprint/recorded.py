"""Makes a blueprint from the content of a record (see ``digests.content_of``), to compare it.

All State Branches are in one document. The content has no layout, no comments and no imports, and
it writes all defaults. So the blueprint does the same.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.blueprint.meaning import AS_WRITTEN
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import Place, ReadError
from smsl_studio.smsl.files import parse_text

Json = Any
BROKEN = "this content is not the one of a blueprint"


def blueprint_of_content(content: Mapping[str, Json], name: str) -> Blueprint:
    """Return the blueprint that a content describes. Messages call its file ``name``.

    ReadError if the content does not describe a blueprint.
    """
    try:
        values = _values(content)
    except (TypeError, ValueError, KeyError, IndexError, AttributeError):
        raise ReadError(BROKEN, Place(name, 1, 1)) from None
    return read_blueprint(parse_text(json.dumps(values), name))


def _values(content: Mapping[str, Json]) -> dict[str, Json]:
    own, (brought, *theirs) = content["meaning"], content["imported"]
    notes = {**dict(theirs[0]), **dict(own[0])}
    values: dict[str, Json] = {}
    for name, said in (*content["behaviour"], *brought):
        values[name] = _branch(said, notes.get(name, {}))
    hazards = [_thing(one) for one in theirs[1]]
    if hazards:
        values["_hazards"] = hazards
    rest = [*theirs[2:], *own[2:]]
    levels = {k: v for one in rest if isinstance(one, dict) for k, v in one.items()}
    if levels:
        values["_levels"] = levels
    listed = [_thing(item) for one in rest if isinstance(one, list) for item in one[1]]
    if listed:
        values["_properties"] = listed
    return values


def _branch(said: Mapping[str, Json], notes: Mapping[str, Json]) -> dict[str, Json]:
    number, width, opaque = said["facts"]
    header: dict[str, Json] = {
        "INITIAL": said["initial"],
        "ACTIVATING": said["activating"],
        "SUB_SBS": [{sub: int(digit)} for sub, digit in said["sub_sbs"]],
    }
    if opaque:
        header["NUM_FACTS"] = 0
    elif width:
        header["NUM_FACTS"] = number
    branch: dict[str, Json] = {"HEADER": header, **said["states"]}
    for table, entries in notes.items():
        if table != AS_WRITTEN:
            branch[table] = {key: dict(_entry(one)) for key, one in entries.items()}
    for path, text in notes.get(AS_WRITTEN, {}).items():
        table, _, key = path.partition("/")
        if key:
            branch.setdefault(table, {})[key] = json.loads(text)
        else:
            branch[table] = json.loads(text)
    return branch


def _entry(note: Mapping[str, Json]) -> Iterator[tuple[str, Json]]:
    """Yield the keys and values of a note. A content has the arguments of bindings as texts."""
    for word, value in note.items():
        if word == "binding" and isinstance(value, dict) and "arguments" in value:
            arguments = {key: json.loads(text) for key, text in value["arguments"].items()}
            yield word, {**value, "arguments": arguments}
        else:
            yield word, value


def _thing(one: Json) -> Json:
    """Return a hazard or property. One that cannot be read is a text in the content."""
    return json.loads(one) if isinstance(one, str) else one
