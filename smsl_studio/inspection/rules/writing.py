"""Rules about what is written: doubled keys, unknown targets, look-alikes, annotations."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator
from functools import partial

from smsl_studio.blueprint.address import Address, note_key, split_fact
from smsl_studio.blueprint.annotations import read_hazards, read_levels
from smsl_studio.blueprint.editing import keep_last, retarget
from smsl_studio.blueprint.levels import fault_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.numbers import numbers_of
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.inspection.finding import LISTED, Finding, Fix, Severity
from smsl_studio.inspection.rules.wording import near
from smsl_studio.smsl.document import Document

ERROR, WARNING = Severity.ERROR, Severity.WARNING


def r01_doubled_key(blueprint: Blueprint) -> Iterator[Finding]:
    """A key written twice: the last one wins, and a reader of the text may see the first."""
    for document in blueprint.documents:
        for path, (first, *others) in document.duplicates():
            fix = None
            # A place that does not count is not the one that the path leads to.
            if others[-1] == document.place(path):
                keep = partial(keep_last, path=path, file=document.file)
                fix = Fix("Keep the last one", keep)
            where = f"line {first.line}, column {first.column}"
            for place in others:
                yield Finding(
                    "R01",
                    ERROR,
                    _address(path),
                    place,
                    f"{path[-1]} is written twice, first at {where}",
                    "the last one counts; rename or remove one",
                    fix,
                )


def _address(path: tuple[str, ...]) -> Address:
    """The SB, state or operation that a path of keys lies in."""
    if len(path) > 1 and (path[1] == HEADER or path[1].startswith("_")):
        return Address(path[0])
    return Address(*path[: 2 if len(path) > 2 and path[2].startswith("_") else 3])


def r02_unknown_target(blueprint: Blueprint) -> Iterator[Finding]:
    """A target that is no state of the SB."""
    for branch in blueprint:
        if not numbers_of(branch).dangles:
            continue
        likes: dict[str, str] = {}
        for edge in branch.edges():
            if edge.target in branch.table:
                continue
            if edge.target not in likes and len(likes) < LISTED:
                likes[edge.target] = near(edge.target, branch.table)
            like = likes.get(edge.target, "")
            yield Finding.at(
                blueprint,
                "R02",
                ERROR,
                edge.address,
                f"leads to {edge.target}, which is no state of {branch.name}",
                advice=f"did you mean {like}?" if like else "add that state, or lead it to another",
                fix=Fix(f"Lead it to {like}", partial(retarget, address=edge.address, target=like))
                if like
                else None,
            )


def r09_look_alikes(blueprint: Blueprint) -> Iterator[Finding]:
    """Names that differ only by case or by characters that look alike."""
    yield from _alike(blueprint, ((name, Address(name)) for name in blueprint.branches), "SB")
    for branch in blueprint:
        states = ((name, Address(branch.name, name)) for name in branch.table)
        yield from _alike(blueprint, states, "state")
        first = {}
        for state, operations in branch.table.items():
            for name in operations:
                if name not in first:
                    first[name] = Address(branch.name, state, name)
        yield from _alike(blueprint, first.items(), "operation")


def _alike(
    blueprint: Blueprint, names: Iterable[tuple[str, Address]], what: str
) -> Iterator[Finding]:
    by_case: dict[str, str] = {}
    by_look: dict[str, str] = {}
    for name, address in names:
        case = by_case.setdefault(name.casefold(), name)
        look = by_look.setdefault(_look(name), name)
        if case == look == name:
            continue
        other, by = (case, "case") if case != name else (look, "characters that look alike")
        yield Finding.at(
            blueprint,
            "R09",
            WARNING,
            address,
            f"the {what} {name} differs from {other} only by {by}",
            advice="give one of them another name",
        )


# The Latin letter first, then what looks like it: digits, Cyrillic, Greek.
_SAME = (
    *("O0ОΟ", "oоο", "l1IІΙ|", "iі", "aа", "cс", "eе", "pр", "xх", "yу", "sѕ", "jј", "vν"),
    *("AАΑ", "BВΒ", "CС", "EЕΕ", "HНΗ", "KКΚ", "MМΜ", "NΝ", "PРΡ", "TТΤ", "XХΧ", "YУΥ", "ZΖ"),
)
_LOOK = {ord(char): same[0] for same in _SAME for char in same}


def _look(name: str) -> str:
    """What a hurried reader sees of a name: one form of every look-alike character."""
    return unicodedata.normalize("NFKC", name).translate(_LOOK)


def r29_annotations(blueprint: Blueprint) -> Iterator[Finding]:
    """Annotations that do not fit their kind, or speak of what is not there."""
    for document in blueprint.documents:
        yield from _odd_hazards(blueprint, document)
        yield from _odd_levels(blueprint, document)
    for branch in blueprint:
        for path, reason in branch.notes.faults:
            words = f"{path[-1]} in {path[0]} is not understood: {reason}"
            yield _note(blueprint.home(branch.name), (branch.name, *path), words)
        yield from _strangers(blueprint, branch)


def _odd_hazards(blueprint: Blueprint, document: Document) -> Iterator[Finding]:
    for path, reason in read_hazards(document.values.get("_hazards"))[1]:
        yield _note(document, path, f"a hazard is not understood: {reason}")
    for hazard in blueprint.hazards_of(document):
        for text in hazard.facts:
            if not _is_fact(blueprint, text):
                words = f"{hazard.name} names {text}, which is no fact"
                yield _note(document, ("_hazards",), words)


def _odd_levels(blueprint: Blueprint, document: Document) -> Iterator[Finding]:
    for path, reason in read_levels(document.values.get("_levels"))[1]:
        yield _note(document, path, f"{path[-1]} is not understood: {reason}")
    for key, level in blueprint.levels_of(document).items():
        fault = fault_of(blueprint, key, level)
        if fault is not None:
            yield _note(document, ("_levels", key), f"_levels: {fault[0]}")


def _strangers(blueprint: Blueprint, branch: StateBranch) -> Iterator[Finding]:
    """Entries whose key names nothing in the SB, and ``requires`` of unknown facts."""
    notes, home = branch.notes, blueprint.home(branch.name)
    for digit in notes.facts:
        if digit >= branch.num_facts:
            words = (
                f"_facts speaks of digit {digit}, but {branch.name} has {branch.num_facts} facts"
            )
            yield _note(home, (branch.name, "_facts", str(digit)), words)
    for state in notes.states:
        if state not in branch.table:
            words = f"_states speaks of {state}, which is no state of {branch.name}"
            yield _note(home, (branch.name, "_states", state), words)
    if not notes.operations:
        return
    known = {note_key(edge.name) for edge in branch.edges()}
    known |= {note_key(edge.name, edge.source) for edge in branch.edges()}
    for key, note in notes.operations.items():
        if key not in known:
            words = f"_operations speaks of {key}, which is no operation of {branch.name}"
            yield _note(home, (branch.name, "_operations", key), words)
        for text in note.requires:
            if not _is_fact(blueprint, text):
                words = f"{key} requires {text}, which is no fact"
                yield _note(home, (branch.name, "_operations", key, "requires", text), words)


def _is_fact(blueprint: Blueprint, text: str) -> bool:
    fact = split_fact(text)
    if fact is None or fact[0] not in blueprint.branches:
        return False
    return fact[1] < blueprint[fact[0]].num_facts


def _note(home: Document, path: tuple[str, ...], message: str) -> Finding:
    return Finding(
        "R29",
        WARNING,
        Address(path[0]),
        home.place(path),
        message,
        "it is kept in the file, and left out of the meaning",
    )
