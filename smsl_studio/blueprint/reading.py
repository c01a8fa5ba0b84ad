"""Document to Blueprint: what is written becomes what is meant.

Refused (ReadError, exit 2) is only what cannot be a blueprint: an SB, HEADER, state or target of
the wrong kind. Everything else opens and is reported by inspection.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.model import EMPTY, Blueprint, Header, StateBranch
from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document, Path

Json = Any
HEADER = "HEADER"


def read_blueprint(document: Document, former: Blueprint | None = None) -> Blueprint:
    """The blueprint a document means; ReadError names the place of what cannot be one.

    An SB whose values are the very objects that ``former`` was read from is taken over from it,
    with everything that has been worked out about it, so that an edit costs what it touches.
    Imported files are read relative to the document's own; see ``importing``.
    """
    branches = _branches(document, former)
    fields = {key: value for key, value in document.values.items() if key.startswith("_")}
    if "_imports" not in fields:
        return Blueprint(branches, document, fields)
    if former and former.fields.get("_imports") is fields["_imports"]:
        return _as_imported_by(former, Blueprint(branches, document, fields))
    from smsl_studio.blueprint.importing import Imports

    found = Imports(_branches)
    found.follow(document, branches)
    together = {**branches, **found.branches}
    return Blueprint(together, document, fields, found.documents, tuple(found.faults))


def _as_imported_by(former: Blueprint, edited: Blueprint) -> Blueprint:
    """An edited blueprint with the SBs that it imported before the edit."""
    imported = {k: v for k, v in former.imported.items() if k not in edited.branches}
    branches = {**edited.branches, **{name: former.branches[name] for name in imported}}
    return replace(edited, branches=branches, imported=imported, import_faults=former.import_faults)


def _branches(document: Document, former: Blueprint | None = None) -> dict[str, StateBranch]:
    branches: dict[str, StateBranch] = {}
    for name, value in document.values.items():
        if name.startswith("_"):
            continue
        if former and name in former.branches and former.document.values.get(name) is value:
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
            f"{key} is {_kind(found) if found != '' else 'empty'}, not {words}",
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
        subs_as_written=value.get("SUB_SBS"),
    )


KNOWN = ("INITIAL", "ACTIVATING", "NUM_FACTS", "SUB_SBS", "NUM_STATES")


def _sub_sbs(document: Document, branch: str, value: Json) -> tuple[tuple[str, int], ...]:
    """SUB_SBS as a map, as ``[]``, or as a list of one-key maps."""
    if value is None:
        return ()
    path = (branch, HEADER, "SUB_SBS")
    advice = 'Write SUB_SBS as {"SB2": 1}: the sub-SB and the digit it expands, counted from 0.'
    if not isinstance(value, dict | list):
        sentence = f"SUB_SBS is {_kind(value)}, not a map from sub-SBs to digits"
        raise ReadError(sentence, document.place(path), advice)
    pairs: list[tuple[str, int]] = []
    for index, item in enumerate([value] if isinstance(value, dict) else value):
        at = path if isinstance(value, dict) else (*path, str(index))
        if not isinstance(item, dict):
            sentence = f"{_kind(item)} in SUB_SBS is no map from a sub-SB to a digit"
            raise ReadError(sentence, document.place(at), advice)
        for sub, digit in item.items():
            if sub[:1] == "_":
                continue
            if type(digit) is not int or not sub:
                sentence = f"the digit of {sub!r} in SUB_SBS is {_kind(digit)}, not a whole number"
                sentence = sentence if sub else "a sub-SB in SUB_SBS has no name"
                raise ReadError(sentence, document.place((*at, sub)), advice)
            pairs.append((sub, digit))
    return tuple(pairs)


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
