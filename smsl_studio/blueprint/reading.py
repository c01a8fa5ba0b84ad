"""Document to Blueprint: what is written becomes what is meant.

Refused (ReadError, exit 2) is only what cannot be a blueprint: an SB, HEADER, state or target of
the wrong kind. Everything else opens and is reported by inspection.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.model import EMPTY, Blueprint, Header, StateBranch
from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document, Path

Json = Any
HEADER = "HEADER"


def read_blueprint(document: Document) -> Blueprint:
    """The blueprint a document means; ReadError names the place of what cannot be one."""
    branches: dict[str, StateBranch] = {}
    fields: dict[str, Json] = {}
    for name, value in document.values.items():
        if name.startswith("_"):
            fields[name] = value
        else:
            branches[name] = _branch(document, name, value)
    return Blueprint(branches, document, fields)


def _branch(document: Document, name: str, value: Json) -> StateBranch:
    _must_be_map(document, (name,), value, "a State Branch")
    if not name:
        raise ReadError("a State Branch has no name", document.place((name,)), "Give it a name.")
    table: dict[str, Mapping[str, str]] = {}
    fields: dict[str, Json] = {}
    state_fields: dict[str, Mapping[str, Json]] = {}
    header = Header(present=False)
    for key, inner in value.items():
        if key.startswith("_"):
            fields[key] = inner
        elif key == HEADER:
            _must_be_map(document, (name, HEADER), inner, "a HEADER")
            header = _header(document, name, inner)
        else:
            _must_be_map(document, (name, key), inner, "a state")
            table[key] = _operations(document, (name, key), inner, state_fields)
    return StateBranch(name, table, header, fields, state_fields)


def _operations(
    document: Document,
    path: Path,
    value: Mapping[str, Json],
    state_fields: dict[str, Mapping[str, Json]],
) -> Mapping[str, str]:
    if not path[-1]:
        raise ReadError("a state has no name", document.place(path), "Give it a name.")
    plain = True
    for key, target in value.items():
        if key[:1] == "_":
            plain = False
        elif type(target) is not str or not key:
            raise ReadError(
                f"the target of {key!r} is {_kind(target)}, not the name of a state"
                if key
                else "an operation has no name",
                document.place((*path, key)),
                'Write the operation as "Operation": "TargetState".',
            )
    if plain:
        return value
    state_fields[path[-1]] = {k: v for k, v in value.items() if k[:1] == "_"}
    return {k: v for k, v in value.items() if k[:1] != "_"}


def _header(document: Document, branch: str, value: Mapping[str, Json]) -> Header:
    fields = {k: v for k, v in value.items() if k.startswith("_")}
    unknown = {k: v for k, v in value.items() if k not in KNOWN and not k.startswith("_")}

    def get(key: str, kind: type, words: str) -> Any:
        found = value.get(key)
        if found is None or (type(found) is kind and found != ""):
            return found
        raise ReadError(
            f"{key} is {_kind(found)}, not {words}",
            document.place((branch, HEADER, key)),
            f"Write {key} as {words}, or leave it out.",
        )

    return Header(
        initial=get("INITIAL", str, "the name of a state"),
        activating=get("ACTIVATING", str, "the name of a state"),
        num_facts=get("NUM_FACTS", int, "a whole number"),
        sub_sbs=_sub_sbs(document, branch, value.get("SUB_SBS")),
        num_states=get("NUM_STATES", int, "a whole number"),
        unknown=unknown or EMPTY,
        fields=fields or EMPTY,
    )


KNOWN = ("INITIAL", "ACTIVATING", "NUM_FACTS", "SUB_SBS", "NUM_STATES")


def _sub_sbs(document: Document, branch: str, value: Json) -> tuple[tuple[str, int], ...]:
    """SUB_SBS as a map, as ``[]``, or as a list of one-key maps."""
    if value is None:
        return ()
    maps = [value] if isinstance(value, dict) else value
    if isinstance(maps, list) and all(isinstance(item, dict) for item in maps):
        pairs = [(sub, digit) for item in maps for sub, digit in item.items() if sub[:1] != "_"]
        if all(type(digit) is int for _, digit in pairs):
            return tuple(pairs)
    raise ReadError(
        "SUB_SBS is not a map from sub-SBs to digits",
        document.place((branch, HEADER, "SUB_SBS")),
        'Write SUB_SBS as {"SB2": 1}: the sub-SB and the digit it expands, counted from 0.',
    )


def _must_be_map(document: Document, path: Path, value: Json, what: str) -> None:
    if not isinstance(value, dict):
        raise ReadError(
            f"{path[-1]!r} is {_kind(value)}, not {what}",
            document.place(path),
            f"Write {what} as {{ ... }}, or start the name with _ to have it skipped.",
        )


def _kind(value: Json) -> str:
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    kinds = {str: "a text", int: "a number", float: "a number", list: "a list", dict: "a map"}
    return kinds.get(type(value), "something else")
