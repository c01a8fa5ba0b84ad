"""Compares everything at file level: hazards, properties, levels, imports, other ``_`` fields, the
order of SBs.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.difference import Change, ChangeKind, Path
from smsl_studio.blueprint.comparison.sides import Sides
from smsl_studio.blueprint.comparison.values import alike, fields_that_differ, merged, said
from smsl_studio.blueprint.continuum import DEFAULTS
from smsl_studio.blueprint.meaning import OF_PROPERTY, levels_written, word_for_word
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.project import real_path
from smsl_studio.blueprint.properties.follow import property_followed

Json = Any
_OWN = ("_hazards", "_imports", "_levels", "_properties")
_TOLD, _ENTRIES = 8, 4


def compare_fields(sides: Sides) -> None:
    """Compare hazards, properties, levels and imports one by one, and every other field as a
    whole."""
    _compare_named(sides, "_hazards", "hazard")
    _compare_named(sides, "_properties", "property")
    _compare_levels(sides)
    _compare_imports(sides)
    one = {k: v for k, v in sides.before.fields.items() if k not in _OWN}
    other = {k: v for k, v in sides.after.fields.items() if k not in _OWN}
    sides.changes.extend(changed_fields(one, other, "the file", (), ()))


def changed_fields(
    one: Any, other: Any, where: str, above_before: Path, above_after: Path, **more: Any
) -> Iterator[Change]:
    """Yield a change for every ``_`` field that differs."""
    for key, here, there in fields_that_differ(one, other):
        old, new = one.get(key), other.get(key)
        yield Change(
            kind_of(here, there),
            "field",
            more.get("before"),
            more.get("after"),
            f"The field {key} of {where} {value_words(here, there, old, new)}.",
            key,
            old,
            new,
            (*above_before, key) if here else (),
            (*above_after, key) if there else (),
        )


def kind_of(here: bool, there: bool) -> ChangeKind:
    """Return the kind of a change, from the sides on which the element is."""
    if here and there:
        return ChangeKind.CHANGED
    return ChangeKind.REMOVED if here else ChangeKind.ADDED


def value_words(here: bool, there: bool, old: Json, new: Json) -> str:
    """Return the words for a change of a value, such as ``is 2 instead of 1``."""
    if here and there and isinstance(old, dict) and isinstance(new, dict) and old and new:
        told = [_entry_words(key, old, new) for key, *_ in fields_that_differ(old, new)]
        more = f", and {len(told) - _ENTRIES} more" if len(told) > _ENTRIES else ""
        return f"differ: {', '.join(told[:_ENTRIES])}{more}"
    if here and there:
        return f"is {said(new)} instead of {said(old)}"
    return f"is removed (it was {said(old)})" if here else f"is added: {said(new)}"


def _entry_words(key: str, old: Json, new: Json) -> str:
    if key not in new:
        return f"{key} is removed (it was {said(old[key])})"
    return f"{key} is {said(new[key])}" + (f" instead of {said(old[key])}" if key in old else "")


def compare_order(sides: Sides) -> None:
    """Compare the order of the SBs on both sides, which matters if several roots are run."""
    old = [name for name in sides.before.branches if sides.branch(name) in sides.after.branches]
    kept = {sides.branch(name) for name in old}
    new = [name for name in sides.after.branches if name in kept]
    if [sides.branch(name) for name in old] != new:
        words = f"The order of the State Branches is {_list(new)} instead of {_list(old)}."
        sides.changes.append(
            Change(ChangeKind.CHANGED, "order", None, None, words, "order", old, new)
        )


def _list(names: list[str]) -> str:
    return ", ".join(names) if len(names) <= _TOLD else ", ".join((*names[:_TOLD], "…"))


def _compare_named(sides: Sides, key: str, what: str) -> None:
    """Compare the hazards or the properties of all files by name. Their order has no meaning."""
    old = {k: (i, _mapped(sides, v)) for k, (i, v) in _by_name(sides.before, key).items()}
    new = _by_name(sides.after, key)
    for name in merged(list(old), list(new)):
        here, there = old.get(name), new.get(name)
        if here is None or there is None or not alike(_full(here[1]), _full(there[1])):
            sides.changes.append(_named_change(what, name[0], here, there))


def _full(entry: Json) -> Json:
    """Return an entry with the defaults of a property, which are no change if they are written."""
    return {**OF_PROPERTY, **entry} if isinstance(entry, dict) else entry


Placed = tuple[Path, Json]


def _by_name(blueprint: Blueprint, key: str) -> dict[tuple[str, int], Placed]:
    """Return the entries by name, and those of the same name by number. An entry of another form
    has its text as its name.

    Only entries of the blueprint's own file have a place in it.
    """
    found: dict[str, list[Placed]] = {}
    for document in blueprint.documents:
        raw = document.values.get(key)
        items = raw if isinstance(raw, list) else [raw] if raw else []
        for index, item in enumerate(items):
            name = said(item.get("name", item) if isinstance(item, dict) else item)
            own = document is blueprint.document
            found.setdefault(name, []).append(((key, str(index)) if own else (), item))
    for same in found.values():
        same.sort(key=lambda one: word_for_word(one[1]))
    return {(name, n): one for name, same in found.items() for n, one in enumerate(same)}


def _mapped(sides: Sides, entry: Json) -> Json:
    """Return a hazard or property of the earlier side with the later names of its SBs."""
    if not isinstance(entry, dict):
        return entry
    if isinstance(entry.get("facts"), dict):
        return {**entry, "facts": {sides.fact(k): v for k, v in entry["facts"].items()}}
    names = {old: new for old, new in sides.branches.items() if old != new}
    if not names:
        return entry

    def pattern(text: str) -> str:
        """Return a pattern of operations with the new name of its SB."""
        name, slash, rest = text.partition("/")
        return f"{names.get(name, name)}/{rest}" if slash else text

    return property_followed(
        entry,
        lambda term: replace(term, branch=names.get(term.branch, term.branch)),
        lambda goal: replace(goal, branch=names.get(goal.branch, goal.branch)),
        pattern,
    )


def _named_change(what: str, name: str, here: Placed | None, there: Placed | None) -> Change:
    kind = kind_of(here is not None, there is not None)
    old, new = here[1] if here else None, there[1] if there else None
    told = value_words(here is not None, there is not None, _facts(old), _facts(new))
    return Change(
        kind,
        what,
        None,
        None,
        f"The {what} {name} {told}.",
        name,
        old,
        new,
        here[0] if here else (),
        there[0] if there else (),
    )


def _facts(entry: Json) -> Json:
    return entry.get("facts", entry) if isinstance(entry, dict) else entry


def _compare_levels(sides: Sides) -> None:
    """Compare the levels of all files by their keys. An explicit default is no change."""
    written = levels_written(*sides.before.documents)
    old = {_level_key(sides, key): (key, level) for key, level in written.items()}
    new = levels_written(*sides.after.documents)
    for key in merged(list(old), list(new)):
        mine, here = old.get(key, (key, None))
        there = new.get(key)
        if alike(here or DEFAULTS.get(key), there or DEFAULTS.get(key)):
            continue
        words = value_words(here is not None, there is not None, here, there)
        sides.changes.append(
            Change(
                kind_of(here is not None, there is not None),
                "level",
                None,
                None,
                f"The level of {key} {words}.",
                key,
                here,
                there,
                _level_path(sides.before, mine),
                _level_path(sides.after, key),
            )
        )


def _level_key(sides: Sides, key: str) -> str:
    """Return a key of the earlier side with the SB's name on the later side."""
    name, slash, rest = key.partition("/")
    branch = Address.split(name)[0]
    return f"{Address(sides.branch(branch))}/{rest}" if slash else key


def _level_path(blueprint: Blueprint, key: str) -> Path:
    """Return the path of a level in the blueprint's own file, empty if it is not there."""
    raw = blueprint.fields.get("_levels")
    return ("_levels", key) if isinstance(raw, dict) and key in raw else ()


def _first_places(listed: Json) -> dict[str, int]:
    """Return the first index of each import in the list."""
    places: dict[str, int] = {}
    for at, name in enumerate(listed if isinstance(listed, list) else ()):
        places.setdefault(_import(name), at)
    return places


def _named_alike(sides: Sides, one: Json, other: Json) -> Json:
    """Return the imports of the earlier side, each with the name of its file on the later side."""
    if not isinstance(one, list) or not isinstance(other, list):
        return one
    ours, kept = set(map(_import, one)), set(map(_import, other))
    theirs = {_file(sides.after, name): name for name in other if _import(name) not in ours}
    return [
        name if _import(name) in kept or not theirs else theirs.get(_file(sides.before, name), name)
        for name in one
    ]


def _import(name: Json) -> str:
    """Return an import, or the text of a value that is no import."""
    return name if isinstance(name, str) else word_for_word(name)


def _file(blueprint: Blueprint, name: Json) -> str:
    """Return the real path of an import, or the text of a value that is no import."""
    if not isinstance(name, str):
        return word_for_word(name)
    folder = os.path.dirname(blueprint.file)  # noqa: PTH120
    return real_path(os.path.join(folder, name))  # noqa: PTH118


def _compare_imports(sides: Sides) -> None:
    one, other = sides.before.fields.get("_imports"), sides.after.fields.get("_imports")
    one = _named_alike(sides, one, other)
    if alike(one or None, other or None):
        return
    old, new = (_first_places(raw) for raw in (one, other))
    for name in merged(list(old), list(new)):
        here, there = name in old, name in new
        if here == there:
            continue
        words = f"The import of {said(name)} is {'removed' if here else 'added'}."
        path: Path = ("_imports", str((old if here else new)[name]))
        sides.changes.append(
            Change(
                kind_of(here, there),
                "import",
                None,
                None,
                words,
                name,
                name if here else None,
                name if there else None,
                path if here else (),
                path if there else (),
            )
        )
    if old.keys() == new.keys():
        words = f"The imports are {said(other)} instead of {said(one)}."
        sides.changes.append(
            Change(
                ChangeKind.CHANGED,
                "import",
                None,
                None,
                words,
                "_imports",
                one,
                other,
                ("_imports",) if one is not None else (),
                ("_imports",) if other is not None else (),
            )
        )
