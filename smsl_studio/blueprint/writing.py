"""From a Blueprint to the plain values that a document can write."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint.elements import Header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER, read_blueprint, sub_entries
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any


def values_of(blueprint: Blueprint) -> dict[str, Json]:
    """Return everything in a blueprint as plain values, with ``_`` fields and unknown header keys,
    but without the SBs of imported files.

    Reading the values gives an equal blueprint. They do not keep the places of ``_`` fields among
    the other keys; ``reconcile`` does.
    """
    values = file_values(blueprint)
    for branch in blueprint:
        if branch.name in blueprint.imported:
            continue
        values[branch.name] = branch_values(branch)
    return values


def new_blueprint(file: str = "untitled.json") -> Blueprint:
    """Return an empty blueprint that will be saved under ``file``."""
    return read_blueprint(parse_json(write_json({}), file))


def file_values(blueprint: Blueprint) -> dict[str, Json]:
    """Return the ``_`` fields of a blueprint's file as plain values."""
    return {key: _plain(value) for key, value in blueprint.fields.items()}


def branch_values(branch: StateBranch) -> dict[str, Json]:
    """Return an SB as plain values, with its ``_`` fields and those of its states."""
    values: dict[str, Json] = {}
    if branch.header.present:
        values[HEADER] = _header(branch.header)
    for name, operations in branch.table.items():
        values[name] = {**branch.state_fields.get(name, {}), **operations}
    for key, value in branch.fields.items():
        values[key] = _plain(value)
    return values


def _header(header: Header) -> dict[str, Json]:
    known = {
        "INITIAL": header.initial,
        "ACTIVATING": header.activating,
        "NUM_FACTS": header.num_facts,
        "SUB_SBS": _subs(header),
        "NUM_STATES": header.num_states,
    }
    values = {key: value for key, value in known.items() if value is not None}
    odd = {key: value for key, value in header.odd.items() if key not in values}
    return {**values, **odd, **_plain(header.unknown), **_plain(header.fields)}


def _subs(header: Header) -> Json:
    """Return SUB_SBS as it was written. Otherwise return a map, or a list if a sub-SB is named
    twice.
    """
    written, pairs = header.subs_as_written, header.sub_sbs
    told = [(sub, digit) for _, sub, digit in sub_entries(written)]
    good = tuple((sub, digit) for sub, digit in told if sub and type(digit) is int)
    if isinstance(written, dict | list) and good == pairs:
        return written
    if len({sub for sub, _ in pairs}) == len(pairs):
        return dict(pairs) or None
    return [{sub: digit} for sub, digit in pairs]


def _plain(value: Json) -> Json:
    return dict(value) if hasattr(value, "keys") else value
