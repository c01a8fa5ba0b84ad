"""Completion: the names that fit at the caret, and how each is written there."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields

from smsl_studio.blueprint.annotations import DrawnNote, FactNote, OperationNote, StateNote
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.predicates.predicate_text import written_source
from smsl_studio.blueprint.predicates.units import symbols
from smsl_studio.studio.features.draw.source.around import HEADER, Around

MOST = 200
"""At most this many names are offered."""
HEADERS = ("INITIAL", "ACTIVATING", "NUM_FACTS", "SUB_SBS", "NUM_STATES")
IN_FILE = ("_imports", "_hazards", "_levels")
IN_BRANCH = (HEADER, "_facts", "_states", "_operations", "_layout", "_notes")
_NOTES = {
    "_facts": FactNote,
    "_states": StateNote,
    "_operations": OperationNote,
    "_notes": DrawnNote,
}
_BARE = re.compile(r"(?:[^\s{}\[\]:,#/\"()>-]|-(?!>))+")
_PLAIN = re.compile(r"[A-Za-z_][\w-]*")
_WORDS = {"true", "false", "yes", "no", "on", "off", "null", "y", "n"}


@dataclass(frozen=True)
class Completion:
    """A name that may be written here, and a word about what it is."""

    name: str
    detail: str = ""


def offers(blueprint: Blueprint, library: Sequence[str], here: Around) -> list[Completion]:
    """The names that fit at a place, the best first; empty if only free text fits."""
    typed = here.typed.casefold()
    found = dict.fromkeys(offer for offer in _all(blueprint, library, here))
    fits = [one for one in found if typed in one.name.casefold()]
    fits.sort(key=lambda one: not one.name.casefold().startswith(typed))
    return fits[:MOST]


def written(offer: Completion, here: Around, form: str, after: str) -> str:
    """How an offer is written in a form. ``after`` is the rest of the line."""
    if form == "json":
        name = json.dumps(offer.name, ensure_ascii=False)
    elif form == "smsl":
        name = offer.name if _BARE.fullmatch(offer.name) else _quoted(offer.name)
    else:
        plain = _PLAIN.fullmatch(offer.name) and offer.name.lower() not in _WORDS
        name = offer.name if plain else _quoted(offer.name)
    if here.is_value:
        return name
    edge = form == "smsl" and len(here.path) == 2 and here.path[1] != HEADER
    mark = " ->" if edge else ":"
    return name if after.lstrip()[:2].startswith(mark.strip()) else f"{name}{mark} "


def _quoted(name: str) -> str:
    return json.dumps(name, ensure_ascii=False)


def _all(blueprint: Blueprint, library: Sequence[str], here: Around) -> Iterator[Completion]:
    path = here.path
    if not path:
        yield from () if here.is_value else map(Completion, IN_FILE)
        return
    branch = blueprint.branches.get(path[0])
    if path[1:2] == (HEADER,):
        yield from _in_header(blueprint, branch, here)
    elif path[1:2] and path[1].startswith("_"):
        yield from _in_note(branch, library, here)
        if path[1] == "_facts" and len(path) > 2:
            yield from _of_sensing(branch, here)
    elif len(path) == 1 and not here.is_value:
        yield from _in_branch(branch)
    elif len(path) == 2:
        yield from _states(branch) if here.is_value else _operations(branch, library)


def _in_branch(branch: StateBranch | None) -> Iterator[Completion]:
    """States that are targets but do not exist yet, then the other keys of an SB."""
    if branch is not None:
        targets = (target for table in branch.table.values() for target in table.values())
        missing = dict.fromkeys(target for target in targets if target not in branch.table)
        yield from (Completion(name, "a target that does not exist yet") for name in missing)
    yield from (
        Completion(name) for name in IN_BRANCH if branch is None or name not in branch.fields
    )


def _in_header(
    blueprint: Blueprint, branch: StateBranch | None, here: Around
) -> Iterator[Completion]:
    if here.path[2:3] == ("SUB_SBS",) or here.key == "SUB_SBS":
        yield from (Completion(name, "State Branch") for name in blueprint.branches
                    if name != here.path[0])  # fmt: skip
    elif here.is_value and here.key in ("INITIAL", "ACTIVATING"):
        yield from _states(branch)
    elif not here.is_value and len(here.path) == 2:
        yield from map(Completion, HEADERS)


def _in_note(
    branch: StateBranch | None, library: Sequence[str], here: Around
) -> Iterator[Completion]:
    """In ``_facts``, ``_states`` and ``_operations``: the names of the entries, then the keys of
    an entry."""
    kind = _NOTES.get(here.path[1])
    if here.is_value or kind is None:
        return
    if len(here.path) == 3:
        yield from (Completion(field.name) for field in fields(kind))
    elif here.path[1] == "_states":
        yield from _states(branch)
    elif here.path[1] == "_operations":
        yield from _operations(branch, library)
    elif here.path[1:] == ("_facts",) and branch is not None:
        yield from (Completion(str(at), branch.fact_name(at)) for at in range(branch.num_facts))


def _of_sensing(branch: StateBranch | None, here: Around) -> Iterator[Completion]:
    """In an entry of ``_facts``: sources, their units, ranges, and the values of predicates."""
    fact = here.path[2]
    digit = int(fact) if branch is not None and fact.isdecimal() and len(fact) < 7 else -1
    within = here.path[3] if len(here.path) > 3 else ""
    if here.is_value:
        if within == "sources" or (here.key == "unit" and not within):
            yield from (Completion(unit, "a unit") for unit in symbols())
        elif within == "predicate" and branch is not None:
            yield from _conditions(branch, digit)
    elif within == "sources" and branch is not None:
        yield from _sources(branch)
    elif within == "range" and branch is not None:
        note = branch.fact_note(digit)
        named = note.sources.items() if note is not None else ()
        yield from (Completion(name, f"in {unit}") for name, unit in named)
    elif within == "predicate" and branch is not None and 0 <= digit < len(branch.alphabet):
        yield from (Completion(value, "a value") for value in branch.alphabet[digit])


def _sources(branch: StateBranch) -> Iterator[Completion]:
    """Yield the sources that other facts of the SB have."""
    named = {
        name: unit for note in branch.notes.facts.values() for name, unit in note.sources.items()
    }
    yield from (Completion(name, f"in {unit}") for name, unit in sorted(named.items()))


def _conditions(branch: StateBranch, digit: int) -> Iterator[Completion]:
    """Yield the beginnings of conditions on the sources of a fact, to go on from."""
    note = branch.fact_note(digit)
    for name, unit in note.sources.items() if note is not None else ():
        word = written_source(name)
        number = "0" if unit == "1" else f"0 {unit}"
        yield from (Completion(f"{word} {sign} {number}", "a condition") for sign in "<>")


def _states(branch: StateBranch | None) -> Iterator[Completion]:
    if branch is not None:
        notes = branch.notes.states
        for name in branch.table:
            yield Completion(name, notes[name].title if name in notes else "")


def _operations(branch: StateBranch | None, library: Sequence[str]) -> Iterator[Completion]:
    used = dict.fromkeys(n for t in branch.table.values() for n in t) if branch else {}
    notes = branch.notes.operations if branch else {}
    for name in sorted(used):
        yield Completion(name, notes[name].title if name in notes else "")
    yield from (Completion(name, "library") for name in library if name not in used)
