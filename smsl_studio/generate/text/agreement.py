"""Whether a blueprint says what the stages before it say: the same people, and sensors that are
there. It is told and no error, because a person may know better than the text."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.generate.text.equipment import NeededEquipment
from smsl_studio.generate.text.steps import TextProcedure, every_step

_SYSTEM = frozenset(("", "robot", "system"))
_MOST = 20


def disagreements(
    procedure: TextProcedure, equipment: NeededEquipment, blueprint: Blueprint
) -> tuple[str, ...]:
    """Return a sentence for each thing that a blueprint says otherwise, at most twenty."""
    found = [*_people(procedure, blueprint), *_sensors(equipment, blueprint)]
    if procedure.cautions and not blueprint.fields.get("_hazards"):
        many = len(procedure.cautions)
        words = "1 caution stands" if many == 1 else f"{many} cautions stand"
        found.append(f"{words} in pm.md, and no hazard in the blueprint: make one by hand")
    return tuple(found[:_MOST])


def _people(procedure: TextProcedure, blueprint: Blueprint) -> Iterator[str]:
    named: dict[str, str] = {}
    for step in every_step(procedure.steps):
        for role in (step.who, *step.confirm, *(one.who for one in step.remedies)):
            if role.casefold() not in _SYSTEM:
                named.setdefault(role.casefold(), f"{role} in step {step.mark}")
    drawn: dict[str, str] = {}
    for branch in blueprint:
        for key, note in branch.notes.operations.items():
            for role in (*note.roles, *note.confirm):
                drawn.setdefault(role.casefold(), f"{branch.name}/{key} is for {role}")
    for role, where in named.items():
        if role not in drawn:
            yield f"pm.md names {where}, and no operation of the blueprint is theirs"
    for role, where in drawn.items():
        if role not in named:
            yield f"{where}, whom pm.md does not name"


def _sensors(equipment: NeededEquipment, blueprint: Blueprint) -> Iterator[str]:
    there = {one.name for one in equipment.devices}
    for branch in blueprint:
        for digit in range(branch.num_facts):
            note = branch.fact_note(digit)
            for sensor in note.sensors if note is not None else ():
                if sensor not in there:
                    yield f"{branch.name}/{digit} is seen by {sensor}, which him.toml does not list"
