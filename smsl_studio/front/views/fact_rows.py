"""The facts of a run as rows: the believed value, the sensed value, and whether they agree."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint.check import CheckResult, FactKey, Reading, state_check
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.freshness import age_of_nothing, limit_of, slow_words
from smsl_studio.host.protocol import SensorInfo

LOST = "process gone"


@dataclass(frozen=True)
class FactRow:
    """One fact of one SB. ``sensed`` is None if it is unknown.

    ``quality`` is ``agrees``, ``differs``, ``unknown``, ``transit``, or ``believed`` if nobody
    senses the fact. A row with ``group`` is the heading of an SB. ``chip`` is the look of the
    believed value on the canvas (on, off, value). ``sub`` says that a sub-SB expands it. ``age``
    and ``limit`` are seconds: the age of its reading, and the largest valid age, which bars show.
    ``key`` is the fact, None for a heading. ``expected`` is the value that the running operation
    will bring, and empty if it does not change the fact.
    """

    name: str
    believed: str
    sensed: str | None
    age: float | None
    quality: str
    words: str
    group: bool = False
    chip: str = ""
    sub: bool = False
    limit: float | None = None
    key: FactKey | None = None
    expected: str = ""


def as_they_were(rows: tuple[FactRow, ...]) -> tuple[FactRow, ...]:
    """Return the rows of a run that is over. They keep the last readings, but have no age."""
    return tuple(replace(row, age=None) for row in rows)


def fact_rows(
    blueprint: Blueprint, status: DispatchStatus, lost: bool = False
) -> tuple[FactRow, ...]:
    """Return a row for every fact of every SB. With several SBs each SB has a heading.

    ``lost`` says that the world is gone, so the last readings are unknown now.
    """
    rows: list[FactRow] = []
    expected = _expected(blueprint, status)
    for branch in blueprint:
        state = status.configuration.get(branch.name)
        if state is None:
            continue
        if len(blueprint) > 1:
            rows.append(FactRow(branch.name, state, "", None, "group", "", group=True))
        for digit, believed in enumerate(branch.facts(state)):
            name, key = branch.fact_name(digit), (branch.name, digit)
            if digit in branch.subs:
                sub = branch.subs[digit]
                words = f"follows {sub}, {status.configuration.get(sub, '')}"
                rows.append(FactRow(name, believed, "", None, "believed", words, key=key))
                continue
            reading = status.scene.get(branch.name, digit)
            if lost and reading is not None:
                rows.append(FactRow(name, believed, None, None, "unknown", LOST, key=key))
                continue
            limit = None
            if reading is not None:
                limit = limit_of(status.sources, key, reading.value, reading.age)
            row = _fact_row(name, believed, reading, expected.get(key), limit)
            rows.append(replace(row, key=key, expected=expected.get(key, "")))
    return tuple(rows)


def last_check(blueprint: Blueprint, status: DispatchStatus, lost: bool) -> CheckResult | None:
    """Return the state check at the end of a run, for the SB of the first goal, else for the first
    SB. None if nothing is sensed.
    """
    branch = next((goal.branch for goal in status.goals), next(iter(status.configuration), ""))
    state = status.configuration.get(branch)
    if state is None or lost or not status.scene.readings:
        return None
    return state_check(blueprint, branch, state, status.scene, status.configuration)


def rate_words(sensors: Sequence[SensorInfo]) -> str:
    """Return how often facts are sensed (Hz), in words."""
    rates = sorted({round(1 / sensor.period) for sensor in sensors if sensor.period > 0})
    if not rates:
        return "nobody senses them"
    return f"sensed at {' to '.join(str(rate) for rate in dict.fromkeys((rates[0], rates[-1])))} Hz"


def _expected(blueprint: Blueprint, status: DispatchStatus) -> Mapping[tuple[str, int], str]:
    """Return the facts that the running operation will change, with their expected values."""
    running = status.running
    if running is None:
        return {}
    branch = blueprint[running.branch]
    before = branch.facts(running.state)
    after = branch.facts(branch.table[running.state][running.operation])
    return {
        (branch.name, digit): new
        for digit, (old, new) in enumerate(zip(before, after, strict=True))
        if old != new
    }


def _fact_row(
    name: str,
    believed: str,
    reading: Reading | None,
    expected: str | None,
    limit: float | None = None,
) -> FactRow:
    if reading is None or not reading.sensed:
        return FactRow(name, believed, "", None, "believed", "believed, nobody senses it")
    if expected is not None:
        words = f"moving, expects {expected}"
        return FactRow(name, believed, reading.value, reading.age, "transit", words)
    if reading.value is None:
        words = reading.reason or "no reading"
        return FactRow(name, believed, None, age_of_nothing(reading), "unknown", words)
    quality, words = "differs", f"not {believed}"
    if reading.value == believed:
        quality = words = "agrees"
    words += slow_words(reading.age, limit)
    return FactRow(name, believed, reading.value, reading.age, quality, words, limit=limit)
