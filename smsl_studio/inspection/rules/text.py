"""Rules about the written text: doubled keys, unknown targets, annotations (R01, R02, R29)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from smsl_studio.blueprint.address import Address, note_key, split_fact
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.numbers import numbers_of
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.blueprint.risk import KEY, faults_in
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity, edit
from smsl_studio.inspection.rules.idle_fields import idle_actors, moved_sub
from smsl_studio.inspection.rules.words import NearNames
from smsl_studio.smsl.document import Document

ERROR, WARNING = Severity.ERROR, Severity.WARNING


def r01_doubled_key(blueprint: Blueprint) -> Iterator[Remark]:
    """R01: a key is written twice. The last one counts, but a reader may see only the first."""
    for document in blueprint.documents:
        for path, (first, *others) in document.duplicates():
            fix = None
            # The path leads to the place that counts. A fix is offered only if that is the last.
            if others[-1] == document.place(path):
                keep = edit("keep_last", path=path, file=document.file)
                fix = Fix("Keep the last one", keep)
            often = "twice" if len(others) == 1 else f"{len(others) + 1:,} times"
            where = f"first at line {first.line}, column {first.column}"
            yield Remark(
                "R01",
                ERROR,
                _address(path),
                f"{path[-1]} is written {often}, {where}",
                "the last one counts; rename or remove one",
                fix,
                spot=others[0],
                others=others[1:],
            )


def _address(path: tuple[str, ...]) -> Address:
    """Return the address of the SB, state or operation that contains a path of keys."""
    if len(path) > 1 and (path[1] == HEADER or path[1].startswith("_")):
        return Address(path[0])
    return Address(*path[: 2 if len(path) > 2 and path[2].startswith("_") else 3])


def r02_unknown_target(blueprint: Blueprint) -> Iterator[Remark]:
    """R02: a target is no state of the SB. All operations to the same target share one finding."""
    for branch in blueprint:
        if not numbers_of(branch).dangles:
            continue
        unknown: dict[str, list[Address]] = {}
        states = NearNames(branch.table)
        for edge in branch.edges():
            if edge.target not in branch.table:
                unknown.setdefault(edge.target, []).append(edge.address)
        for target, addresses in unknown.items():
            yield Remark(
                "R02",
                ERROR,
                addresses[0],
                f"leads to {target}, which is no state of {branch.name}",
                others=addresses[1:],
                remedy=partial(_near_target, states, target, tuple(addresses)),
            )


def _near_target(
    states: NearNames, target: str, addresses: tuple[Address, ...]
) -> tuple[str, Fix | None]:
    """Return the advice and the fix for operations that lead to a state that does not exist."""
    like = states.near(target)
    if not like:
        return "add that state, or lead it to another", None
    which = "it" if len(addresses) == 1 else f"all {len(addresses):,}"
    fix = Fix(f"Lead {which} to {like}", edit("retarget", address=addresses, target=like))
    return f"did you mean {like}?", fix


def r29_annotations(blueprint: Blueprint) -> Iterator[Remark]:
    """R29: annotations that do not fit their kind, or that name an element that does not exist."""
    if any("_hazards" in one.values or "_properties" in one.values for one in blueprint.documents):
        from smsl_studio.inspection.rules.conditions import odd_hazards, odd_properties

        yield from odd_hazards(blueprint)
        yield from odd_properties(blueprint)
    for document in blueprint.documents:
        yield from _odd_levels(blueprint, document)
        yield from _odd_risk(document)
        yield from _open_conflicts(document)
    for branch in blueprint:
        for path, reason in (*branch.notes.faults, *branch.drawn.faults):
            words = f"{path[-1]} in {path[0]} is not understood: {reason}"
            if is_told_as_predicate(path, reason, branch):
                continue
            severity = ERROR if _is_safeguard(path, reason) else WARNING
            yield _note(blueprint.home(branch.name), (branch.name, *path), words, severity)
        if branch.notes.senses:
            from smsl_studio.inspection.rules.predicates import odd_predicates

            yield from odd_predicates(blueprint, branch)
        yield from _strangers(blueprint, branch)
        yield from _idle(branch)


def is_told_as_predicate(path: tuple[str, ...], reason: str, branch: StateBranch) -> bool:
    """Whether a fault is one of sources, ranges or predicates, which are told with more words."""
    key = reason.partition(":")[0].partition(".")[0]
    if path[0] != "_facts" or len(path) < 2 or key not in ("sources", "range", "predicate"):
        return False
    sense = branch.notes.senses.get(int(path[1])) if path[1].isdecimal() else None
    return sense is not None and any(fault.path[0] == key for fault in sense.faults)


SAFEGUARDS = ("confirm", "forecast", "requires", "timeout", "answer_within")


def _is_safeguard(path: tuple[str, ...], reason: str) -> bool:
    """Whether what is left out would have held an operation back, so that nobody may miss it."""
    key = reason.partition(":")[0].partition(".")[0]
    return path[0] == "_operations" and key in SAFEGUARDS


def _idle(branch: StateBranch) -> Iterator[Remark]:
    """Report operations that a person should carry out although they only move a sub-SB."""
    by_sub: dict[str, list[Operation]] = {}
    for edge in idle_actors(branch):
        by_sub.setdefault(moved_sub(branch, edge), []).append(edge)
    for sub, edges in by_sub.items():
        yield Remark(
            "R29",
            WARNING,
            edges[0].address,
            f"who acts has no effect here: it only moves {sub}, and nobody is asked",
            f"say who acts at the operations of {sub}, or use confirm",
            others=[edge.address for edge in edges[1:]],
        )


def _odd_levels(blueprint: Blueprint, document: Document) -> Iterator[Remark]:
    if "_levels" not in document.values:
        return
    from smsl_studio.blueprint.annotations import read_levels
    from smsl_studio.blueprint.levels import fault_of

    for path, reason in read_levels(document.values["_levels"])[1]:
        yield _note(document, path, f"{path[-1]} is not understood: {reason}")
    for key, level in blueprint.levels_of(document).items():
        fault = fault_of(blueprint, key, level)
        if fault is not None:
            yield _note(document, ("_levels", key), f"_levels: {fault.sentence}")


def _odd_risk(document: Document) -> Iterator[Remark]:
    if KEY not in document.values:
        return
    for key, reason in faults_in(document.values[KEY]):
        path = (KEY, key) if key else (KEY,)
        yield _note(document, path, f"{path[-1]} is not understood: {reason}")


def _open_conflicts(document: Document) -> Iterator[Remark]:
    """Report each conflict that a merge left open, at its element."""
    if "_conflicts" not in document.values:
        return
    from smsl_studio.blueprint.merge import read_conflicts

    found, faults = read_conflicts(document.values["_conflicts"])
    for index, conflict in found.items():
        yield Remark(
            "R29",
            ERROR,
            Address(*Address.split(conflict.address)),
            f"a merge left {conflict.address} open: {conflict.words}",
            "choose one of the two, and remove the entry from _conflicts",
            spot=(document, ("_conflicts", str(index))),
        )
    for path, reason in faults:
        yield _note(document, path, f"an open conflict is not understood: {reason}", ERROR)


def _strangers(blueprint: Blueprint, branch: StateBranch) -> Iterator[Remark]:
    """Report entries whose key names no element of the SB, and ``requires`` of unknown facts."""
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


def _note(
    home: Document, path: tuple[str, ...], message: str, severity: Severity = WARNING
) -> Remark:
    return Remark(
        "R29",
        severity,
        Address(path[0]),
        message,
        "it is kept in the file, and left out of the meaning",
        spot=(home, path),
    )
