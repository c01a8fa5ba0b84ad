"""One SB of several versions in one picture: everything that one of them has, with the marks of who
changed it."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.merge.choice import Side
from smsl_studio.blueprint.merge.sides import MergeSides
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import HEADER, read_blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.shape import Point
from smsl_studio.smsl.json_form import parse_json

Json = Any
Table = Mapping[str, Mapping[str, str]]
LETTERS: Mapping[Side, str] = {"ours": "M", "theirs": "T"}
_KEPT = ("_states", "_facts")


@dataclass
class OverlaidBranch:
    """The picture of one SB of a merge.

    ``blueprint`` has this SB alone; an operation that leads to several states has one line for
    each, called ``NAME to STATE``. ``drawn`` has the lines of each operation by its true address.
    ``signs`` are M, T or MT and then +, - or ~.
    """

    blueprint: Blueprint
    places: Mapping[str, Point]
    signs: dict[Address, str] = field(default_factory=dict)
    drawn: dict[Address, tuple[Address, ...]] = field(default_factory=dict)

    def shown(self, address: Address) -> tuple[Address, ...]:
        """Return the elements of the picture that stand for an element."""
        return self.drawn.get(address, (address,))

    def true_address(self, shown: Address) -> Address:
        """Return the element for which a line of the picture stands."""
        return next((one for one, lines in self.drawn.items() if shown in lines), shown)


def overlaid(
    result: Blueprint, sides: MergeSides, branch: str, shown: Collection[Side]
) -> OverlaidBranch:
    """Return the picture of an SB with all that the ``shown`` versions and the result have.

    Without any version it shows the result alone, without marks.
    """
    versions = {side: found for side in shown if (found := sides.get(side)) is not None}
    tables = {side: _table(version, branch) for side, version in versions.items()}
    states = list(dict.fromkeys(
        state for table in (_table(result, branch), *tables.values()) for state in table
    ))  # fmt: skip
    values: dict[str, Json] = {}
    drawn: dict[Address, tuple[Address, ...]] = {}
    for state in states:
        having = list(tables.values()) or [_table(result, branch)]
        operations = dict.fromkeys(op for table in having for op in table.get(state, {}))
        taken = set(operations)
        inside: dict[str, str] = {}
        for operation in operations:
            targets = dict.fromkeys(
                table[state][operation] for table in having if operation in table.get(state, {})
            )
            names = [operation]
            if len(targets) > 1:
                names = [_free(f"{operation} to {target}", taken) for target in targets]
            inside |= dict(zip(names, targets, strict=True))
            drawn[Address(branch, state, operation)] = tuple(
                Address(branch, state, name) for name in names
            )
        values[state] = inside
    made = _blueprint(result, branch, values)
    former = place_states(result[branch]) if branch in result.branches else {}
    places = place_states(made[branch], former) if branch in made.branches else {}
    picture = OverlaidBranch(made, places, drawn=drawn)
    if sides.base is not None:
        _sign(picture, sides, branch, [side for side in ("ours", "theirs") if side in versions])
    return picture


def _free(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "'"
    taken.add(name)
    return name


def _table(blueprint: Blueprint, branch: str) -> Table:
    found = blueprint.branches.get(branch)
    return found.table if found is not None else {}


def _blueprint(result: Blueprint, branch: str, states: Mapping[str, Json]) -> Blueprint:
    before = result.document.values.get(branch)
    inner = before if isinstance(before, dict) else {}
    written = inner.get(HEADER)
    header: dict[str, Json] = written if isinstance(written, dict) else {}
    own = result.branches.get(branch)
    if own is not None:
        ends = {"INITIAL": own.initial, "ACTIVATING": own.activating}
        header = {**{key: end for key, end in ends.items() if end in states}, **header}
    layout = inner.get("_layout")
    places = {key: at for key, at in layout.items() if key in states} if layout else {}
    kept = {key: inner[key] for key in _KEPT if key in inner}
    header = {key: value for key, value in header.items() if key not in ("SUB_SBS", "NUM_STATES")}
    values = {branch: {HEADER: header, **states, **kept, "_layout": places}}
    return read_blueprint(parse_json(json.dumps(values), "merge.json"))


def _sign(
    picture: OverlaidBranch, sides: MergeSides, branch: str, changers: Iterable[Side]
) -> None:
    """Set the marks of the states and operations that one side changed."""
    assert sides.base is not None
    base = sides.base
    before = _table(base, branch)
    for side in changers:
        version = sides.get(side)
        assert version is not None
        after = _table(version, branch)
        for state in picture.blueprint[branch].table:
            sign = _sign_of(state in before, state in after)
            if not sign and state in after and _note(base, branch, state) != _note(
                version, branch, state
            ):  # fmt: skip
                sign = "~"
            _add(picture, Address(branch, state), side, sign)
        for address, lines in picture.drawn.items():
            old = before.get(address.state, {}).get(address.operation)
            new = after.get(address.state, {}).get(address.operation)
            for line in lines:
                target = picture.blueprint[branch].table[line.state][line.operation]
                _add(picture, line, side, _sign_of_line(old, new, target)
                     or _changed_words(base, version, address, new == target))  # fmt: skip


def _sign_of(before: bool, after: bool) -> str:
    return "" if before == after else "+" if after else "-"


def _sign_of_line(old: str | None, new: str | None, target: str) -> str:
    """The sign of a line to ``target`` for a side that led from ``old`` to ``new``."""
    if new == target:
        return "" if old == new else "+" if old is None else "~"
    return "-" if old == target and new is None else ""


def _changed_words(base: Blueprint, version: Blueprint, edge: Address, is_own: bool) -> str:
    if not is_own:
        return ""
    notes = [
        (one.document.values.get(edge.branch) or {}).get("_operations", {})
        for one in (base, version)
    ]
    key = note_key(edge.operation, edge.state)
    one, other = (note.get(key) if isinstance(note, dict) else None for note in notes)
    return "" if one == other else "~"


def _note(blueprint: Blueprint, branch: str, state: str) -> Json:
    notes = (blueprint.document.values.get(branch) or {}).get("_states")
    return notes.get(state) if isinstance(notes, dict) else None


def _add(picture: OverlaidBranch, address: Address, side: Side, sign: str) -> None:
    if not sign:
        return
    former = picture.signs.get(address, "")
    # Both sides did something else to it: the sign of a change tells enough.
    kept = sign if not former or former[-1] == sign else "~"
    picture.signs[address] = f"{former[:-1]}{LETTERS[side]}{kept}"
