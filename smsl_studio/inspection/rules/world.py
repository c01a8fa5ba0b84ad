"""Rules about a blueprint in a chosen world: its functions, sensors and people (R24 to R26)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import chain

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address, fact_text, note_key
from smsl_studio.blueprint.annotations import ProcedureBinding
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import HUMAN, SHARED
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.facts import changed_digits
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import Place, StudioError
from smsl_studio.graph.effects import effects_of
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity
from smsl_studio.inspection.rules.words import counted, fact_words
from smsl_studio.library.bound import Bindings, leaf_facts
from smsl_studio.library.pattern import read_pattern
from smsl_studio.world.engines import TABLE

ERROR, WARNING = Severity.ERROR, Severity.WARNING

COMMON_PERSON = "operator"
"""The role in a fix if the file names nobody."""


@dataclass(frozen=True)
class Unreached:
    """What the chosen robot does not reach: pairs of a pattern of operations and a place in
    words."""

    robot: str
    places: tuple[tuple[str, str], ...]


@dataclass(frozen=True, eq=False)
class Equipment:
    """A blueprint with what a world has for it. ``unreached`` is None if the robot reaches all, or
    if nothing is known of it."""

    blueprint: Blueprint
    world: str
    bindings: Bindings
    unreached: Unreached | None = None

    @cached_property
    def levels(self) -> Levels:
        """Who carries out the operations and tells the facts."""
        return Levels(self.blueprint)

    @cached_property
    def sensors(self) -> dict[FactKey, int]:
        """The number of sensors of each fact that has one."""
        found: dict[FactKey, int] = {}
        for sensor in self.bindings.sensors:
            key = sensor.branch, sensor.digit
            found[key] = found.get(key, 0) + 1
        return found

    @cached_property
    def person(self) -> str:
        """The first role that the file names, or a common one."""
        for branch in self.blueprint:
            operations, facts = branch.notes.operations.values(), branch.notes.facts.values()
            roles = chain(
                chain.from_iterable((*one.confirm, *one.roles) for one in operations),
                chain.from_iterable(one.roles for one in facts),
            )
            found = next(filter(None, roles), "")
            if found:
                return found
        return COMMON_PERSON


def r24_no_function(equipment: Equipment) -> Iterator[Remark]:
    """R24: an operation without a function in this world or beyond the reach of its robot, a
    binding that does not fit, a fact that both a sub-SB and a sensor tell.

    A stop mode and a time limit are never missing, because the library has defaults for both.
    """
    blueprint, bindings = equipment.blueprint, equipment.bindings
    yield from _unfit(blueprint, bindings)
    faulty = {fault.subject for fault in bindings.faults}
    for branch in blueprint:
        for digit, sub in branch.subs.items():
            note = branch.fact_note(digit)
            if note is not None and note.sensors and sub in blueprint.branches:
                yield Remark(
                    "R24",
                    ERROR,
                    branch.address,
                    f"{fact_words(branch, digit)} has a sensor, although {sub} expands it",
                    f"let {sub} tell it: take its sensors away",
                    Fix("Take its sensors away", partial(_unsensed, branch.name, digit)),
                    spot=(blueprint.home(branch.name), (branch.name, "_facts", str(digit))),
                )
    if equipment.unreached is not None:
        yield from _beyond(equipment, equipment.unreached)
    without: dict[tuple[str, str], list[Operation]] = {}
    for edge in _needing(equipment):
        said = blueprint[edge.branch].operation_note(edge.source, edge.name)
        if isinstance(said.binding, ProcedureBinding):
            continue
        if str(edge.address) not in faulty and edge.address not in bindings.operations:
            without.setdefault((edge.branch, edge.name), []).append(edge)
    for edges in without.values():
        yield Remark(
            "R24",
            ERROR,
            edges[0].address,
            f"the world {equipment.world} has no function for it",
            "bind it to a function of a plugin, or let a person carry it out",
            others=[edge.address for edge in edges[1:]],
        )


def _beyond(equipment: Equipment, unreached: Unreached) -> Iterator[Remark]:
    """Report the operations that the robot would have to carry out beyond its reach."""
    patterns = [(read_pattern(text, {}), words) for text, words in unreached.places]
    found: dict[tuple[str, str, str], list[Operation]] = {}
    for edge in _needing(equipment):
        if edge.address in equipment.bindings.operations:
            missed = (words for pattern, words in patterns if pattern.match(edge.name) is not None)
            words = next(missed, "")
            if words:
                found.setdefault((edge.branch, edge.name, words), []).append(edge)
    for (_, _, words), edges in found.items():
        yield Remark(
            "R24",
            ERROR,
            edges[0].address,
            f"the robot {unreached.robot} does not reach {words} in the world {equipment.world}",
            "choose another robot, or let a person carry it out",
            others=[edge.address for edge in edges[1:]],
        )


def _unfit(blueprint: Blueprint, bindings: Bindings) -> Iterator[Remark]:
    """Report the bindings that do not fit. One binding may be that of many edges."""
    causes: dict[tuple[str, Place | None], list[str]] = {}
    for fault in bindings.faults:
        causes.setdefault((fault.sentence, fault.place), []).append(fault.subject)
    for (sentence, place), subjects in causes.items():
        first, *others = (_subject(blueprint, subject) for subject in subjects)
        words = f"{subjects[0]} is not bound: {sentence}"
        advice = "correct the binding"
        yield Remark("R24", ERROR, first, words, advice, spot=place, others=others)


def _subject(blueprint: Blueprint, subject: str) -> Address:
    """Return the address that a fault of the bindings is about, as far as it is one."""
    if subject.startswith("fact "):
        return Address(Address.split(subject.removeprefix("fact "))[0])
    try:
        return blueprint.resolve(subject)
    except StudioError:
        return Address(next(iter(blueprint.branches), "bindings"))


def _unsensed(branch: str, digit: int, blueprint: Blueprint) -> Blueprint:
    changes = {(branch, str(digit)): {"sensors": None}}
    return editing.change_notes(blueprint, "_facts", changes)


def _needing(equipment: Equipment) -> Iterator[Operation]:
    """Yield the edges that a run carries out by a function."""
    blueprint, levels = equipment.blueprint, equipment.levels
    try:
        edges = Edges(Hierarchy(blueprint))
    except StudioError:
        return
    for branch in blueprint:
        for state in branch.table:
            for edge in edges.out(branch.name, state):
                if edge.function and levels.operation(edge.address) != HUMAN:
                    yield Operation(branch.name, state, edge.name, edge.target)


def r25_not_sensed(equipment: Equipment) -> Iterator[Remark]:
    """R25: a fact that operations change and nothing senses, and a critical fact with one source.

    In the table world the sensors never fail, so one of them is enough there.
    """
    changed = {(branch.name, digit) for branch in equipment.blueprint for digit in _moved(branch)}
    for branch, digit in leaf_facts(equipment.blueprint):
        key = branch.name, digit
        note = branch.fact_note(digit)
        level = equipment.levels.fact(*key)
        sources = 0 if level == HUMAN else equipment.sensors.get(key, 0)
        people = max(1, len(note.roles) if note else 0) if level in (HUMAN, SHARED) else 0
        if not sources and not people and key in changed:
            yield _about(
                equipment,
                branch,
                digit,
                f"operations change {fact_words(branch, digit)}, and nothing senses it in the "
                f"world {equipment.world}",
                "give it a sensor, or let a person tell it",
            )
        alone = sources + people == 1 and (people or equipment.world != TABLE)
        if alone and note is not None and note.critical:
            yield _about(
                equipment,
                branch,
                digit,
                f"{fact_words(branch, digit)} is critical, and has only one source",
                "give it a second sensor or a second person",
            )


def _moved(branch: StateBranch) -> set[int]:
    """Return the digits that operations of an SB change."""
    return {digit for kind in effects_of(branch).kinds for digit, _ in kind}


def _about(
    equipment: Equipment, branch: StateBranch, digit: int, message: str, advice: str
) -> Remark:
    """Return a remark about a fact, at its note if it has one."""
    home, person = equipment.blueprint.home(branch.name), equipment.person
    own = fact_text(branch.name, digit)
    is_told = equipment.levels.fact(branch.name, digit) == HUMAN
    tell = partial(_told, branch.name, digit, person)
    fix = None if is_told else Fix(f"Let {person} tell {own} too", tell)
    spot = (home, (branch.name, "_facts", str(digit)))
    return Remark("R25", WARNING, branch.address, message, advice, fix, spot=spot)


def _told(branch: str, digit: int, person: str, blueprint: Blueprint) -> Blueprint:
    """Let a person tell a fact where sensors leave it unknown."""
    after = editing.set_levels(blueprint, {fact_text(branch, digit): SHARED})
    roles = {(branch, str(digit)): {"roles": [person]}}
    return editing.change_notes(after, "_facts", roles)


def r26_not_confirmed(equipment: Equipment) -> Iterator[Remark]:
    """R26: a shared operation of high risk, or one that changes a critical fact, for which no
    ``confirm`` says who agrees.

    A time that runs out is never a yes: the language has no way to write that it is.
    """
    for branch in equipment.blueprint:
        if not equipment.levels.people_do(branch.name):
            continue
        critical = {digit for digit, note in branch.notes.facts.items() if note.critical}
        found: dict[str, list[Operation]] = {}
        for edge in branch.edges():
            note = branch.operation_note(edge.source, edge.name)
            if note.confirm or equipment.levels.operation(edge.address) != SHARED:
                continue
            if note.risk == "high" or _changes(branch, edge, critical):
                found.setdefault(edge.name, []).append(edge)
        for edges in found.values():
            yield Remark(
                "R26",
                ERROR,
                edges[0].address,
                "its risk is high or it changes a critical fact, a person must agree to it, and no "
                "confirm says who",
                "name the roles in confirm",
                _confirmed(equipment, edges),
                others=[edge.address for edge in edges[1:]],
            )


def _changes(branch: StateBranch, edge: Operation, digits: set[int]) -> bool:
    if not digits or edge.target not in branch.table:
        return False
    facts = branch.facts
    return not digits.isdisjoint(changed_digits(facts(edge.source), facts(edge.target)))


def _confirmed(equipment: Equipment, edges: Sequence[Operation]) -> Fix:
    keys = tuple((edge.branch, note_key(edge.name, edge.source)) for edge in edges)
    words = f"Let {equipment.person} confirm {counted(len(keys), 'operation')}"
    return Fix(words, partial(_with_confirm, keys, equipment.person))


def _with_confirm(keys: Sequence[tuple[str, str]], person: str, blueprint: Blueprint) -> Blueprint:
    words = {"confirm": [person]}
    return editing.change_notes(blueprint, "_operations", dict.fromkeys(keys, words))
