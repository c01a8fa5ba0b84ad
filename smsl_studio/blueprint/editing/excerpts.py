"""Copying: a part of a blueprint as a text of its own, in the native form.

A copy from inside an SB has the mark ``_copied`` in its SB, so that pasting puts it into an SB
again. A text without the mark has whole SBs. Other readers skip the mark.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.drawn import GROUPS, LAYOUT, NOTES
from smsl_studio.blueprint.edge_layout import IN_LAYOUT
from smsl_studio.blueprint.editing.deletion import delete
from smsl_studio.blueprint.editing.draft import existing
from smsl_studio.blueprint.editing.drawn import part_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.pins import PINNED, renamed_pins
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.forms import form_named

Json = Any
MARK = "_copied"
STATES, OPERATIONS = "states", "operations"


def excerpt(blueprint: Blueprint, addresses: Iterable[Address]) -> str:
    """Return the chosen SBs, states or operations as native SMSL.

    An SB comes with everything in it. States come with the operations between them, their notes and
    places, and with the names and meanings of the facts. Operations alone come in the states that
    they leave.
    """
    return form_named("smsl").write(parts_of(blueprint, addresses))


def cut(blueprint: Blueprint, addresses: Iterable[Address]) -> tuple[Blueprint, str]:
    """Return the blueprint without the chosen elements (see ``delete``), and their excerpt."""
    chosen = tuple(addresses)
    return delete(blueprint, chosen), excerpt(blueprint, chosen)


def parts_of(blueprint: Blueprint, addresses: Iterable[Address]) -> dict[str, Json]:
    """Return the values of an excerpt. EditRefused if nothing is chosen."""
    chosen = {existing(blueprint, address) for address in addresses}
    if not chosen:
        raise EditRefused("nothing is chosen", advice="Choose states, operations or an SB.")
    by_branch: dict[str, set[Address]] = {}
    for address in chosen:
        by_branch.setdefault(address.branch, set()).add(address)
    values: dict[str, Json] = {}
    for branch in blueprint:
        own = by_branch.get(branch.name, set())
        if branch.address in own:
            values[branch.name] = blueprint.home(branch.name).values[branch.name]
        elif own:
            values[branch.name] = _part(blueprint, branch, own)
    return values


def _part(blueprint: Blueprint, branch: StateBranch, chosen: set[Address]) -> dict[str, Json]:
    states = {address.state for address in chosen if not address.operation}
    edges = {(address.state, address.operation) for address in chosen if address.operation}
    written = blueprint.home(branch.name).values[branch.name]
    part: dict[str, Json] = {MARK: STATES if states else OPERATIONS}
    if branch.header.num_facts is not None:
        part[HEADER] = {"NUM_FACTS": branch.header.num_facts}
    kept: dict[str, list[str]] = {}
    leaving = states or {state for state, _ in edges}
    for state in (state for state in branch.table if state in leaving):
        inner: dict[str, Json] = {}
        for key, value in written[state].items():
            if key.startswith("_"):
                if states:
                    inner[key] = value
            elif value in states if states else (state, key) in edges:
                inner[key] = value
                kept.setdefault(state, []).append(key)
        part[state] = inner
    return {**part, **_notes(written, states, kept)}


def _notes(
    written: Mapping[str, Json], states: set[str], kept: Mapping[str, list[str]]
) -> dict[str, Json]:
    """Return the entries in the tables of notes about copied elements."""
    named = {note_key(name) for names in kept.values() for name in names}
    named |= {note_key(name, state) for state, names in kept.items() for name in names}
    wanted = {"_states": states, "_operations": named, "_layout": states}
    notes: dict[str, Json] = {}
    for key, names in wanted.items():
        table = written.get(key)
        found = {n: v for n, v in table.items() if n in names} if isinstance(table, dict) else {}
        if found:
            notes[key] = found
    if states and written.get("_facts"):
        notes["_facts"] = written["_facts"]
    hanging, groups = part_of(written, states)
    if hanging:
        notes[NOTES] = hanging
    if groups:
        notes[LAYOUT] = {**notes.get(LAYOUT, {}), GROUPS: groups}
    pins = renamed_pins(written.get(LAYOUT), {state: state for state in states})
    if pins:
        notes[LAYOUT] = {**notes.get(LAYOUT, {}), PINNED: pins}
    lines = _lines(written.get(LAYOUT), named) if states else {}
    if lines:
        notes[LAYOUT] = {**notes.get(LAYOUT, {}), IN_LAYOUT: lines}
    return notes


def _lines(layout: Json, named: set[str]) -> dict[str, Json]:
    """Return the entries about the lines of copied operations."""
    table = layout.get(IN_LAYOUT) if isinstance(layout, dict) else None
    return {n: v for n, v in table.items() if n in named} if isinstance(table, dict) else {}
