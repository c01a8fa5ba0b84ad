"""The rows about recovery: for each failure state the way out of it, and who decides."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import OperationNote
from smsl_studio.blueprint.failure_states import failures
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.recovery import FailureRecovery, recoverability
from smsl_studio.front.views.claim_run import steps_of
from smsl_studio.front.views.fact_tiles import value_words
from smsl_studio.inspection.proof.verdict import Counterexample

ROBOT = "robot"


@dataclass(frozen=True)
class RecoveryRow:
    """One failure state in words.

    ``nearest`` is the nearest state of its SB that is without failure or declared safe, or says why
    there is none. ``way`` are the operations to it, and ``decides`` who decides about them. ``run``
    is the way out, None if there is none.
    """

    state: Address
    failure: str
    nearest: str
    way: str
    decides: str
    goal: str
    run: Counterexample | None

    @property
    def found(self) -> bool:
        """Whether there is a way to where nothing has failed."""
        return self.run is not None


def recovery_rows(blueprint: Blueprint, limit: int) -> tuple[RecoveryRow, ...]:
    """Return a row for each failure state: those without a way first, then as written.

    It can be called off. At most ``limit`` configurations are stored.
    """
    rows = [recovery_row(blueprint, one) for one in recoverability(blueprint, limit)]
    return tuple(sorted(rows, key=lambda row: row.found))


def recovery_row(blueprint: Blueprint, one: FailureRecovery) -> RecoveryRow:
    """Return how the procedure recovers from one failure state, in words."""
    branch = blueprint[one.state.branch]
    failure = " and ".join(
        f"{branch.fact_name(digit)} is {value_words(blueprint, (branch.name, digit), value)}"
        for digit, value in failures(branch, one.state.state)
    )
    goal = one.goal_words
    if one.path is None or one.start is None:
        nearest = f"Unknown: {one.bound}" if one.bound else "No way back"
        return RecoveryRow(one.state, failure, nearest, "", "", goal, None)
    here = dict(one.start)
    end = dict(steps_of(blueprint, Counterexample(here, one.path, here))[-1].configuration)
    many = len(one.path)
    first = one.path[0].operation if one.path else ""
    way = f"{many} operation{'' if many == 1 else 's'}" + (f": {first}" if first else "")
    way += " first" if many > 1 else ""
    notes = [blueprint[at.branch].operation_note(at.state, at.operation) for at in one.path]
    decides = ", ".join(dict.fromkeys(_who(note) for note in notes))
    run = Counterexample(here, one.path, end)
    return RecoveryRow(one.state, failure, end[branch.name], way, decides, goal, run)


def _who(note: OperationNote) -> str:
    """Return who decides about an operation: roles, a person, or the robot alone."""
    people = ", ".join((*note.roles, *note.confirm))
    if people:
        return people
    return "a person" if note.actor in ("human", "shared") else ROBOT
