"""What Studio puts beside the states of a form, so that nothing of a blueprint is lost.

States, operations, INITIAL and ACTIVATING stand in the form's own elements, where other programs
see and change them. Headers and annotations stand beside them as JSON. A reader takes the elements
as they are now, and what stands beside them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.imported_files import KEY as IMPORTS
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER, read_blueprint
from smsl_studio.blueprint.writing import branch_values, file_values
from smsl_studio.errors import Place, ReadError
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any
Values = dict[str, Json]


def file_carried(blueprint: Blueprint) -> Values:
    """Return the ``_`` fields of a file. All SBs are written, so no file is imported.

    Hazards, properties and levels of imported files come along.
    """
    found = {key: value for key, value in file_values(blueprint).items() if key != IMPORTS}
    for document in blueprint.documents[1:]:
        for key in ("_hazards", "_properties"):
            more = document.values.get(key)
            if isinstance(more, list):
                own = found.get(key)
                found[key] = [*(own if isinstance(own, list) else []), *more]
        more = document.values.get("_levels")
        if isinstance(more, dict):
            own = found.get("_levels")
            found["_levels"] = {**more, **(own if isinstance(own, dict) else {})}
    return found


def branch_carried(branch: StateBranch) -> Values:
    """Return the header and the ``_`` fields of an SB."""
    values = branch_values(branch)
    return {key: value for key, value in values.items() if key not in branch.table}


def state_carried(branch: StateBranch, state: str) -> Values:
    """Return the ``_`` fields of a state, and its operations that lead to no state."""
    absent = {
        name: target for name, target in branch.table[state].items() if target not in branch.table
    }
    return {**dict(branch.state_fields.get(state, {})), **absent}


def as_json(values: Mapping[str, Json]) -> str:
    """Return values as JSON of ASCII characters, which every form can hold."""
    return json.dumps(values)


def from_json(text: str, file: str, place: tuple[int, int] = (1, 1)) -> Values:
    """Return the values in a JSON text that stands beside an element. ReadError if it is broken.

    Its size and its depth are bounded as those of any blueprint."""
    try:
        return dict(parse_json(text, file).values)
    except ReadError as error:
        where = error.place._replace(line=place[0], column=place[1]) if error.place else None
        words = f"what Studio wrote beside an element is no JSON object: {error.sentence}"
        raise ReadError(words, where, "Convert the blueprint anew, or remove this text.") from None


def file_fields(values: Mapping[str, Json]) -> Values:
    """Return those of the values beside a file that are ``_`` fields. No file is imported."""
    return {key: one for key, one in values.items() if key[:1] == "_" and key != IMPORTS}


def with_ends(branch: Values, initial: str, activating: str) -> None:
    """Write INITIAL and ACTIVATING into the header of an SB, unless they say so already.

    An empty name leaves the header as it is."""
    states = [key for key in branch if key != HEADER and not key.startswith("_")]
    header = branch.get(HEADER)
    known = header if isinstance(header, dict) else {}
    ends = (("INITIAL", initial, states[:1]), ("ACTIVATING", activating, states[-1:]))
    for key, wanted, default in ends:
        said = known.get(key)
        now = said if isinstance(said, str) and said else (default[0] if default else "")
        if wanted and now != wanted:
            known = {**known, key: wanted}
    if known or HEADER in branch:
        header_first = {HEADER: known, **{k: v for k, v in branch.items() if k != HEADER}}
        branch.clear()
        branch.update(header_first)


def blueprint_of(values: Values, file: str) -> Blueprint:
    """Return the blueprint of plain values. ReadError if they are none, or too many."""
    try:
        return read_blueprint(parse_json(write_json(values), file))
    except ReadError as error:
        words = f"it makes no blueprint: {error.sentence}"
        raise ReadError(words, Place(file, 1, 1), error.advice) from None
