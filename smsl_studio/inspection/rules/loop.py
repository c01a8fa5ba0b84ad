"""The rule about loops of failure and recovery (R23)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import note_key
from smsl_studio.blueprint.continuum import AUTOMATIC
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.facts import changed_digits
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity
from smsl_studio.inspection.rules.recovery import failures_of
from smsl_studio.inspection.rules.words import counted

WARNING, NOTE = Severity.WARNING, Severity.NOTE


def r23_unbounded_loop(blueprint: Blueprint) -> Iterator[Remark]:
    """R23: a recovery that leads back, without a person, to where the failure came from.

    The same failure may follow again and again. A run begins an operation at most three times from
    one configuration, so this is a note. If the state then goes on, without a person, by an
    operation of high risk or one that changes a critical fact, it is a warning.
    """
    levels, role = Levels(blueprint), _role(blueprint)
    for branch in blueprint:
        loops = list(_recovering(branch))
        if levels.people_do(branch.name):
            loops = [edge for edge in loops if _alone(branch, levels, edge)]
        grave: set[Operation] = set()
        if _has_grave(branch):
            grave = {edge for edge in loops if _goes_on(branch, levels, edge.target)}
        for severity, edges in (
            (WARNING, [edge for edge in loops if edge in grave]),
            (NOTE, [edge for edge in loops if edge not in grave]),
        ):
            if edges:
                yield _loop(severity, edges, role)


def _has_grave(branch: StateBranch) -> bool:
    """Whether an SB has an operation of high risk or a critical fact."""
    notes = branch.notes
    risks = any(note.risk == "high" for note in notes.operations.values())
    return risks or any(note.critical for note in notes.facts.values())


def _recovering(branch: StateBranch) -> Iterator[Operation]:
    """Yield the edges that only take the failure values of a failure state away."""
    failing = failing_states(branch)
    for state in failing:
        facts, failed = branch.facts(state), {digit for digit, _ in failures_of(branch, state)}
        for name, target in branch.table[state].items():
            if target not in branch.table or target in failing:
                continue
            if failed.issuperset(changed_digits(facts, branch.facts(target))):
                yield Operation(branch.name, state, name, target)


def _alone(branch: StateBranch, levels: Levels, edge: Operation) -> bool:
    """Whether an edge is carried out without a person."""
    note = branch.operation_note(edge.source, edge.name)
    return not note.confirm and levels.operation(edge.address) == AUTOMATIC


def _goes_on(branch: StateBranch, levels: Levels, state: str) -> bool:
    """Whether an operation that should not begin unasked again and again leaves a state so."""
    critical = {digit for digit, note in branch.notes.facts.items() if note.critical}
    for name, target in branch.table[state].items():
        edge = Operation(branch.name, state, name, target)
        if target in branch.table and _alone(branch, levels, edge):
            changed = changed_digits(branch.facts(state), branch.facts(target))
            high = branch.operation_note(state, name).risk == "high"
            if high or not critical.isdisjoint(changed):
                return True
    return False


def _loop(severity: Severity, edges: Sequence[Operation], role: str) -> Remark:
    why = "" if severity is NOTE else ", with an operation of high risk or for a critical fact"
    return Remark(
        "R23",
        severity,
        edges[0].address,
        f"leads back to {edges[0].target}, where the failure may come again{why}, and no person "
        "bounds how often",
        "let a person confirm it; a run begins an operation three times from one configuration",
        _bound(edges, role),
        others=[edge.address for edge in edges[1:]],
    )


def _bound(edges: Iterable[Operation], role: str) -> Fix:
    """Return a fix that lets a person confirm these edges, by the names of their operations."""
    keys = dict.fromkeys((edge.branch, note_key(edge.name, edge.source)) for edge in edges)
    words = f"Let {role} confirm {counted(len(keys), 'operation')}"
    return Fix(words, partial(_confirm, keys=tuple(keys), role=role))


def _role(blueprint: Blueprint) -> str:
    """Return the first person that confirms anything in the file, else ``operator``."""
    notes = (note for branch in blueprint for note in branch.notes.operations.values())
    return next((role for note in notes for role in note.confirm), "operator")


def _confirm(blueprint: Blueprint, keys: Sequence[tuple[str, str]], role: str) -> Blueprint:
    words = {"confirm": [role]}
    return editing.change_notes(blueprint, "_operations", dict.fromkeys(keys, words))
