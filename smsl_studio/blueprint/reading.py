"""Document to Blueprint: what is written becomes what is meant.

Refused (ReadError, exit 2) is only what cannot be a blueprint: an SB, HEADER, state or target of
the wrong kind. Everything else opens and is reported by inspection.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import Any

from smsl_studio.blueprint.elements import EMPTY, Header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document, Path

Json = Any
HEADER = "HEADER"


def read_blueprint(
    document: Document, former: Blueprint | None = None, opened: Iterable[Document] = ()
) -> Blueprint:
    """The blueprint a document means; ReadError names the place of what cannot be one.

    An SB whose values are the very objects that ``former`` was read from is taken over from it,
    with everything that has been worked out about it, so that an edit costs what it touches.
    Imported files are found relative to the document's own; those that ``former`` imports, or
    that are among the ``opened``, count as they are in memory. See ``importing``.
    """
    own = partial(branches_of, former=former)
    fields = fields_of(document)
    if "_imports" not in fields:
        return Blueprint(own(document), document, fields)
    from smsl_studio.blueprint.importing import follow, gather, real_path

    imports = former.imports if former else None
    if imports and former and former.fields.get("_imports") is fields["_imports"]:
        return gather(document, imports, own)
    known = imports.known if imports else {}
    known.update((real_path(one.file), one) for one in opened)
    return gather(document, follow(document, known), own)


def fields_of(document: Document) -> dict[str, Json]:
    """The ``_`` fields of a file."""
    return {key: value for key, value in document.values.items() if key.startswith("_")}


def branches_of(document: Document, former: Blueprint | None = None) -> dict[str, StateBranch]:
    """The SBs that stand in a document; see ``read_blueprint``."""
    branches: dict[str, StateBranch] = {}
    for name, value in document.values.items():
        if name.startswith("_"):
            continue
        if former and name in former.branches and former.home(name).values.get(name) is value:
            branches[name] = former.branches[name]
        else:
            branches[name] = _branch(document, name, value)
    return branches


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
            header = _header(inner)
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
                f"the target of {key!r} is {kind_of(target)}, not the name of a state"
                if key
                else "an operation has no name",
                document.place((*path, key)),
                'Write the operation as "Operation": "TargetState".',
            )
    if plain:
        return value
    state_fields[path[-1]] = {k: v for k, v in value.items() if k[:1] == "_"}
    return {k: v for k, v in value.items() if k[:1] != "_"}


def _header(value: Mapping[str, Json]) -> Header:
    fields = {k: v for k, v in value.items() if k.startswith("_")}
    unknown = {k: v for k, v in value.items() if k not in KNOWN and not k.startswith("_")}

    odd: dict[str, Json] = {}

    def get(key: str, kind: type) -> Any:
        found = value.get(key)
        if type(found) is kind and found != "":
            return found
        if found is not None:
            odd[key] = found
        return None

    written = value.get("SUB_SBS")
    if written is not None and not isinstance(written, dict | list):
        odd["SUB_SBS"] = written
    pairs = ((sub, digit) for _, sub, digit in sub_entries(written))
    return Header(
        initial=get("INITIAL", str),
        activating=get("ACTIVATING", str),
        num_facts=get("NUM_FACTS", int),
        sub_sbs=tuple((sub, digit) for sub, digit in pairs if sub and type(digit) is int),
        num_states=get("NUM_STATES", int),
        unknown=unknown or EMPTY,
        fields=fields or EMPTY,
        subs_as_written=written,
        odd=odd or EMPTY,
    )


KNOWN = ("INITIAL", "ACTIVATING", "NUM_FACTS", "SUB_SBS", "NUM_STATES")


def sub_entries(written: Json) -> Iterator[tuple[Path, str, Json]]:
    """What stands in SUB_SBS (a map, or a list of one-key maps): where, the sub-SB, its digit.

    What is no map in a list comes with an empty name; ``_`` names are passed over.
    """
    if isinstance(written, list):
        for index, item in enumerate(written):
            if not isinstance(item, dict):
                yield (str(index),), "", item
                continue
            for path, sub, digit in sub_entries(item):
                yield (str(index), *path), sub, digit
    elif isinstance(written, dict):
        for sub, digit in written.items():
            if sub[:1] != "_":
                yield (sub,), sub, digit


def _must_be_map(document: Document, path: Path, value: Json, what: str) -> None:
    if not isinstance(value, dict):
        raise ReadError(
            f"{path[-1]!r} is {kind_of(value)}, not {what}",
            document.place(path),
            f"Write {what} as {{ ... }}, or start the name with _ to have it skipped.",
        )


def kind_of(value: Json) -> str:
    """What a value is, in words: ``a text``, ``a list``, ``null`` ..."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    kinds = {str: "a text", int: "a number", float: "a number", list: "a list", dict: "a map"}
    return kinds.get(type(value), "something else")
