"""The reader in the place of the PSM: a blueprint of steps.

Each step is a fact that is done or not, and the operation that does it. Steps of a step are a
sub-SB under its fact. What may go wrong is a failure value, with an operation that leads out of it.
A part begins only after the step before it, so parts do not overtake each other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.generate.text.blueprint_names import FreshNames
from smsl_studio.generate.text.language_words import ENGLISH, GERMAN, Wording
from smsl_studio.generate.text.sentences import capital
from smsl_studio.generate.text.step_numbers import WORDS
from smsl_studio.generate.text.steps import Remedy, Source, TextProcedure, TextStep

Json = Any
FAILURES = "xyzuvwqrstkm"
"""The values of what may go wrong with a step, in their order."""
ROBOT = "robot"


def blueprint_values(
    procedure: TextProcedure, sensors: Mapping[str, Sequence[str]] | None = None
) -> dict[str, Json]:
    """Return the plain values of the blueprint of a procedure, without its origin.

    ``sensors`` has, by the number of a step, the sensors that see whether it is done.
    """
    return _Serialization(procedure, sensors or {}).values


@dataclass
class _BranchOfSteps:
    name: str
    title: str
    steps: tuple[TextStep, ...]
    gate: Mapping[str, str]
    """The fact that must hold before the first step begins: ``{"SB/digit": value}``."""
    subs: dict[str, int] = field(default_factory=dict)
    names: FreshNames = field(default_factory=FreshNames)

    def state(self, digit: int, value: str = "") -> str:
        """Return the state in which the steps before ``digit`` are done. ``value`` is that of the
        step itself."""
        done = "1" * digit + value
        return f"State_{done.ljust(len(self.steps), '0')}"


class _Serialization:
    def __init__(self, procedure: TextProcedure, sensors: Mapping[str, Sequence[str]]) -> None:
        self._wording: Wording = GERMAN if procedure.language == "de" else ENGLISH
        self._sensors = sensors
        self._branches = FreshNames()
        self.values: dict[str, Json] = {}
        self._branch(procedure.title, procedure.steps, {})

    def _branch(self, title: str, steps: tuple[TextStep, ...], gate: Mapping[str, str]) -> str:
        branch = _BranchOfSteps(self._branches.branch(title), title, steps, gate)
        values: dict[str, Json] = {}
        self.values[branch.name] = values  # bases stand before their sub-SBs
        for digit, step in enumerate(steps):
            if step.steps:
                before = {f"{branch.name}/{digit - 1}": "1"} if digit else dict(gate)
                branch.subs[self._branch(step.do, step.steps, before)] = digit
        values.update(self._written(branch))
        return branch.name

    def _written(self, branch: _BranchOfSteps) -> dict[str, Json]:
        many = len(branch.steps)
        first = branch.steps[0]
        header: dict[str, Json] = {
            "INITIAL": branch.state(0), "ACTIVATING": branch.state(many), "NUM_FACTS": many,
        }  # fmt: skip
        if branch.subs:
            header["SUB_SBS"] = branch.subs
        states = {branch.state(0): {"title": f"{self._wording.start}: {branch.title}"}}
        sources: dict[str, Json] = {branch.state(0): _cited(first.sources)}
        operations: dict[str, Json] = {}
        table: dict[str, dict[str, str]] = {branch.state(digit): {} for digit in range(many + 1)}
        for digit, step in enumerate(branch.steps):
            name = branch.names.operation(step.do)
            after = branch.state(digit + 1)
            table[branch.state(digit)][name] = after
            states[after] = {"title": capital(self._done(step))}
            sources[after] = sources[name] = _cited(step.sources)
            operations[name] = _note(step, branch.gate if digit == 0 else {})
            for value, remedy in zip(FAILURES, _remedies(step), strict=False):
                failed = branch.state(digit, value)
                again = branch.names.operation(remedy.do)
                table[failed] = {again: self._back(branch, digit, remedy)}
                states[failed] = {"title": remedy.when}
                cited = _cited(remedy.sources or step.sources)
                sources[failed] = sources[again] = cited
                operations[again] = _remedy_note(remedy)
        return {
            "HEADER": header,
            "_facts": {str(at): self._fact(step) for at, step in enumerate(branch.steps)},
            "_states": states,
            "_operations": operations,
            "_sources": sources,
            **table,
        }

    def _done(self, step: TextStep) -> str:
        return step.until or f"{self._wording.done}{step.do}"

    def _fact(self, step: TextStep) -> dict[str, Json]:
        values = {"0": self._wording.no, "1": self._wording.yes}
        remedies = dict(zip(FAILURES, _remedies(step), strict=False))
        note: dict[str, Json] = {
            "name": capital(step.until or step.do),
            "values": {**values, **{value: one.when for value, one in remedies.items()}},
        }
        if remedies:
            note["failure"] = list(remedies)
        sensors = self._sensors.get(step.mark, ())
        if sensors and not step.steps:
            note["sensors"] = list(sensors)
        return note

    def _back(self, branch: _BranchOfSteps, digit: int, remedy: Remedy) -> str:
        """Return where a remedy leads: to a state in which no sub-SB has to go back."""
        lowest = max((at + 1 for at in branch.subs.values() if at < digit), default=0)
        if remedy.back == "on":
            return branch.state(digit + 1)
        if remedy.back == "start":
            return branch.state(lowest)
        if remedy.back not in WORDS:
            marks = [step.mark for step in branch.steps]
            at = marks.index(remedy.back) if remedy.back in marks else digit
            return branch.state(max(lowest, min(at, digit)))
        return branch.state(digit)


def _remedies(step: TextStep) -> tuple[Remedy, ...]:
    return () if step.steps else step.remedies[: len(FAILURES)]


def _note(step: TextStep, gate: Mapping[str, str]) -> dict[str, Json]:
    """Return what is written about an operation. One that has parts is done by them."""
    note: dict[str, Json] = {"title": step.do}
    if step.steps:
        return note
    if step.who and step.who != ROBOT:
        note |= {"actor": "human", "roles": [step.who]}
    elif step.who:
        note["actor"] = ROBOT
    if step.risk:
        note["risk"] = step.risk
    if step.confirm:
        note["confirm"] = list(step.confirm)
    if step.takes is not None:
        note["duration"] = _plain(step.takes)
    if step.within is not None:
        human = note.get("actor") == "human"
        note["answer_within" if human else "timeout"] = _plain(step.within)
    if gate:
        note["requires"] = dict(gate)
    return note


def _remedy_note(remedy: Remedy) -> dict[str, Json]:
    note: dict[str, Json] = {"title": remedy.do}
    if remedy.who and remedy.who != ROBOT:
        note |= {"actor": "human", "roles": [remedy.who]}
    return note


def _cited(sources: tuple[Source, ...]) -> list[Json]:
    return [source.citation.as_json() for source in sources]


def _plain(seconds: float) -> float | int:
    return int(seconds) if math.floor(seconds) == seconds else seconds
