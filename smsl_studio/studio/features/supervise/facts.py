"""The state check of the shown SB by facts: pure functions from the status of a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from smsl_studio.blueprint.check import CheckResult, Term, state_check, sub_below
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.written_check import written_check
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.fact_rows import FactRow
from smsl_studio.front.views.freshness import age_of_nothing, limit_of, slow_words
from smsl_studio.monitor.facts import SourceState
from smsl_studio.studio.base.chips import kind_of
from smsl_studio.studio.running.state_check import SO_FAR

LOST = "process gone"
SIGNS = {True: "true", False: "false", None: "unknown"}


@dataclass(frozen=True)
class CheckView:
    """A state check: its state, verdict, facts, formula, and the reason of every term.

    ``kind`` selects the colour of the verdict: good, held, unknown. ``awaited`` says that an
    operation to this state still runs.
    """

    state: str
    verdict: str
    kind: str
    rows: tuple[FactRow, ...]
    written: str
    terms: str
    awaited: bool = False


def check_view(
    blueprint: Blueprint, status: DispatchStatus, branch: str, lost: bool = False
) -> CheckView | None:
    """The check that decides next in an SB; None if the SB has no active state.

    While an operation runs, it is the check of its target, otherwise that of the active state.
    ``lost`` says that the world has failed, so no reading is valid.
    """
    state = status.configuration.get(branch, "")
    own = blueprint.branches.get(branch)
    if own is None or state not in own.table:
        return None
    awaited = status.check
    if awaited is None or awaited.branch != branch:
        awaited = state_check(blueprint, branch, state, status.scene, status.configuration)
    running = status.running is not None and awaited.state != state
    truth = None if lost or (running and awaited.truth is False) else awaited.truth
    verdict, kind = {
        True: (SO_FAR, "unknown") if running else ("True", "good"),
        False: ("Not true", "held"),
        None: ("Not yet known" if running else "Unknown", "unknown"),
    }[truth]
    said = written_check(blueprint, awaited)
    return CheckView(
        state=awaited.state,
        verdict=verdict,
        kind=kind,
        rows=_rows(blueprint, own, status, awaited, state, lost),
        written=f"{said.name} := {said.text}",
        terms="\n".join(f"{term.text}: {SIGNS[term.truth]}, {term.why}" for term in said.terms),
        awaited=running,
    )


def sensed_marks(
    blueprint: Blueprint, status: DispatchStatus, branch: str
) -> tuple[tuple[int, str], ...]:
    """The facts of the active state that sensors contradict or do not know, while no operation
    runs."""
    state = status.configuration.get(branch, "")
    own = blueprint.branches.get(branch)
    if own is None or state not in own.table or status.running is not None:
        return ()
    found = []
    for digit, believed in enumerate(own.facts(state)):
        reading = status.scene.get(branch, digit)
        if reading is not None and reading.sensed and reading.value != believed:
            found.append((digit, "unknown" if reading.value is None else "differs"))
    return tuple(found)


class _Here(NamedTuple):
    """The active state, whether an operation leaves it now, and whether the world has failed."""

    state: str
    moving: bool
    lost: bool


def _rows(
    blueprint: Blueprint,
    own: StateBranch,
    status: DispatchStatus,
    check: CheckResult,
    state: str,
    lost: bool,
) -> tuple[FactRow, ...]:
    terms = {term.fact: term for term in check.terms}
    here = _Here(state, check.state != state, lost)
    return tuple(
        replace(
            _row(blueprint, own, status, terms.get((own.name, digit)), digit, here),
            key=(own.name, digit),
        )
        for digit in range(len(own.facts(state)))
    )


def _row(
    blueprint: Blueprint,
    own: StateBranch,
    status: DispatchStatus,
    term: Term | None,
    digit: int,
    here: _Here,
) -> FactRow:
    state, moving, lost = here
    believed, name = own.facts(state)[digit], own.fact_name(digit)
    chip, sub = kind_of(own, state, digit), sub_below(blueprint, own, digit)
    if sub is not None:
        return _sub_row(name, believed, chip, sub, status, term)
    reading = status.scene.get(own.name, digit)
    if reading is None or not reading.sensed:
        words = "believed, nobody senses it"
        return FactRow(name, believed, "", None, "believed", words, chip=chip)
    if lost or reading.value is None:
        words = LOST if lost else reading.reason or "no reading"
        age = None if lost else age_of_nothing(reading)
        return FactRow(name, believed, None, age, "unknown", words, chip=chip)
    wanted = term.wanted if term is not None else believed
    if moving and wanted != believed:
        quality, words = "transit", f"moving, expects {wanted}"
    else:
        quality = "agrees" if reading.value == believed else "differs"
        words = _sources(status.sources, (own.name, digit), reading.value)
        words = words if quality == "agrees" else f"not {believed}; {words}"
    limit = limit_of(status.sources, (own.name, digit), reading.value, reading.age)
    words += slow_words(reading.age, limit)
    return FactRow(
        name, believed, reading.value, reading.age, quality, words, chip=chip, limit=limit
    )


def _sub_row(
    name: str,
    believed: str,
    chip: str,
    sub: StateBranch,
    status: DispatchStatus,
    term: Term | None,
) -> FactRow:
    """The row of a fact that a sub-SB expands.

    It has no sensor; the sub-SB's state check is its value.
    """
    words = f"{sub.name} in {status.configuration.get(sub.name, 'no state')}"
    sensed = term.reading if term is not None else None
    if term is not None and term.truth is None and term.reason:
        words = f"{words}; {term.reason}"
    quality = "unknown" if sensed is None else "agrees" if sensed == believed else "differs"
    ages = [
        reading.age
        for (branch, _), reading in status.scene.readings.items()
        if branch == sub.name and reading.sensed
    ]
    age = max(ages, default=None)
    return FactRow(name, believed, sensed, age, quality, words, chip=chip, sub=True)


def _sources(sources: Sequence[SourceState], fact: tuple[str, int], value: str) -> str:
    """Which sources agree with the value, and which do not."""
    here = [one.said for one in sources if one.fact == fact]
    # If a person has stated the fact, that counts and comes first.
    here.sort(key=lambda said: not said.human)
    agree = [said.source for said in here if said.value == value]
    silent = [said.source for said in here if said.value != value]
    if not here:
        return "agrees"
    words = ", ".join(agree) + (" agree" if len(agree) > 1 else "")
    return f"{words}; not {', '.join(silent)}" if silent else words
