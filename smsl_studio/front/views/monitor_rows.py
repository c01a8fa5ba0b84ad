"""The rows of the monitor page, from the status of a run. Pure functions, no widget."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.check import FactKey, Reading, Scene
from smsl_studio.blueprint.estimate import Estimate, estimate
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.freshness import age_words
from smsl_studio.monitor.facts import SourceState

COLUMNS = ("Fact", "Source", "Value", "Quality", "Age", "Latency", "Counted", "Repeated", "Late",
           "Disturbed")  # fmt: skip
FIGURES = range(4, 9)
"""The columns with numbers."""
GROUP, FACT, SOURCE = "group", "fact", "source"
KNOWN, UNKNOWN, CONFLICT, BELIEVED = "known", "unknown", "conflict", "believed"
GONE = "the world is gone"
LONG = 36
"""The largest number of characters of a name in a place where it cannot be shortened to fit."""

Disturbances = Mapping[str, str]
"""For each sensor the disturbances that are switched on, in words."""


@dataclass(frozen=True)
class MonitorRow:
    """One row: an SB, a fact, or one of several sources of a fact. A fact with one source has one
    row.

    ``cells`` are the words of the columns. ``standing`` is ``known``, ``unknown``, ``conflict`` or
    ``believed``. An SB is known if exactly one state fits. ``sensor`` is what a disturbance applies
    to (a name, or ``SB/digit``), empty if there is no sensor.
    """

    kind: str
    key: tuple[str, ...]
    cells: tuple[str, ...]
    standing: str
    sensor: str = ""
    tip: str = ""

    @property
    def spoken(self) -> str:
        """The whole row as text for a screen reader."""
        pairs = zip(COLUMNS, self.cells, strict=True)
        return ", ".join(f"{name} {cell}" for name, cell in pairs if cell)


def monitor_rows(
    blueprint: Blueprint,
    status: DispatchStatus,
    estimates: Mapping[str, Estimate],
    disturbed: Disturbances,
) -> tuple[MonitorRow, ...]:
    """Return a row for each SB, for each fact, and for each source of a fact with several
    sources.
    """
    sources: dict[FactKey, list[SourceState]] = {}
    for source in status.sources:
        sources.setdefault(source.fact, []).append(source)
    found: list[MonitorRow] = []
    for branch in blueprint:
        state = status.configuration.get(branch.name)
        if state is None:
            continue
        found.append(_group(branch, state, estimates.get(branch.name), moved(status, branch.name)))
        for digit in range(branch.num_facts):
            key = (branch.name, digit)
            reading = status.scene.get(*key)
            found += _fact(branch, digit, state, reading, sources.get(key, ()), disturbed)
    return tuple(found)


def of_lost(status: DispatchStatus) -> DispatchStatus:
    """Return the status of a run whose world is gone. All sensed facts are unknown in it."""
    readings = {
        key: reading._replace(value=None, reason=GONE) if reading.sensed else reading
        for key, reading in status.scene.readings.items()
    }
    sources = tuple(
        replace(source, said=replace(source.said, value=None, reason=GONE))
        for source in status.sources
    )
    return replace(status, scene=Scene(readings, status.scene.time), sources=sources, check=None)


def summary(rows: Sequence[MonitorRow]) -> str:
    """Return the number of known facts, and of others, as one sentence."""
    facts = [row.standing for row in rows if row.kind == FACT]
    counts = {word: facts.count(word) for word in (KNOWN, UNKNOWN, CONFLICT, BELIEVED)}
    words = {KNOWN: "known", UNKNOWN: "unknown", CONFLICT: "in conflict", BELIEVED: "not sensed"}
    said = ", ".join(f"{count} {words[word]}" for word, count in counts.items() if count)
    return f"{len(facts)} {'fact' if len(facts) == 1 else 'facts'}: {said}" if facts else "No facts"


def estimate_words(estimate: Estimate, moving: bool) -> str:
    """Return the place of an SB according to its sensors, in words. ``moving`` says that an
    operation moves it.
    """
    if moving and estimate.kind == "off the map":
        return "between states, an operation moves it"
    if estimate.kind == "unknown":
        return f"unknown, could be {' or '.join(map(short, estimate.possible))}"
    if estimate.kind == "off the map":
        return "off the map, no state fits"
    return f"{estimate.kind}, {' or '.join(map(short, estimate.states))}"


def moved(status: DispatchStatus, branch: str) -> bool:
    """Return whether an operation of this SB is being carried out."""
    return status.running is not None and status.running.branch == branch


def short(name: str) -> str:
    """Return a name, without its middle if it is long."""
    return name if len(name) <= LONG else f"{name[: LONG // 2]}…{name[-LONG // 2 + 1 :]}"


def _group(branch: StateBranch, state: str, estimate: Estimate | None, moving: bool) -> MonitorRow:
    """Return the row of an SB. While an operation moves it, no state has to fit, so this is no
    conflict.
    """
    words, standing = "", UNKNOWN
    if estimate is not None:
        words = f"by its sensors: {estimate_words(estimate, moving)}"
        off = estimate.kind == "ambiguous" or (estimate.kind == "off the map" and not moving)
        standing = KNOWN if estimate.kind == "located" else CONFLICT if off else UNKNOWN
    cells = (branch.name, f"believed in {state}", "", words, *[""] * 6)
    return MonitorRow(GROUP, (branch.name,), cells, standing, tip=f"{cells[1]}; {words}")


def _fact(
    branch: StateBranch,
    digit: int,
    state: str,
    reading: Reading | None,
    sources: Sequence[SourceState],
    disturbed: Disturbances,
) -> Iterator[MonitorRow]:
    name = branch.fact_name(digit)
    key = (branch.name, str(digit))
    if digit in branch.subs:
        words = f"follows the state check of {branch.subs[digit]}"
        believed = branch.facts(state)[digit]
        yield MonitorRow(FACT, key, (name, "", believed, words, *[""] * 6), BELIEVED, tip=words)
    elif reading is None or not reading.sensed:
        words = "believed, nobody senses it"
        believed = branch.facts(state)[digit]
        yield MonitorRow(FACT, key, (name, "", believed, words, *[""] * 6), BELIEVED, tip=words)
    elif len(sources) == 1:
        yield _only(name, key, reading, sources[0], disturbed)
    else:
        standing, words = _standing(reading, sources)
        note = branch.fact_note(digit)
        how = (note.aggregation if note else "single").replace("_", " ")
        said = f"{len(sources)} sources, {how}" if sources else ""
        value = "?" if reading.value is None else reading.value
        cells = (name, said, value, words, *[""] * 6)
        target = fact_text(branch.name, digit)
        yield MonitorRow(FACT, key, cells, standing, target, f"{name}: {words}")
        for source in sources:
            yield _source(key, source, disturbed)


def _only(
    name: str,
    key: tuple[str, ...],
    reading: Reading,
    source: SourceState,
    disturbed: Disturbances,
) -> MonitorRow:
    row = _source(key, source, disturbed)
    standing, words = _standing(reading, (source,))
    value = "?" if reading.value is None else reading.value
    cells = (name, row.cells[1], value, _last(words, source), *row.cells[4:])
    return MonitorRow(FACT, key, cells, standing, row.sensor, f"{name}: {cells[3]}")


def _source(key: tuple[str, ...], source: SourceState, disturbed: Disturbances) -> MonitorRow:
    said, sample = source.said, source.sample
    known = said.value is not None
    cells = (
        "",
        said.source,
        said.value if said.value is not None else "?",
        "good" if known else _last(said.reason, source),
        age_words(said.age) if sample is not None or said.human else "",
        age_words(source.latency) if sample is not None else "",
        *(f"{n:,}" if sample is not None or n else "" for n in _counts(source)),
        disturbed.get(said.source, ""),
    )
    sensor = "" if said.human else said.source
    tip = f"{said.source}: {cells[3]}"
    return MonitorRow(SOURCE, (*key, said.source), cells, KNOWN if known else UNKNOWN, sensor, tip)


def _counts(source: SourceState) -> tuple[int, int, int]:
    return source.counted, source.repeated, source.late


def _last(words: str, source: SourceState) -> str:
    """Add the last value of a source whose reading is too old. If two speakers share the source, no
    last value is added.
    """
    sample, said = source.sample, source.said
    if (
        not said.contested
        and said.value is None
        and sample is not None
        and sample.value is not None
    ):
        return f"{words}, last {sample.value}"
    return words


def _standing(reading: Reading, sources: Sequence[SourceState]) -> tuple[str, str]:
    if reading.value is not None:
        return KNOWN, "good"
    contested = any(source.said.contested for source in sources)
    conflict = contested or reading.reason.startswith("conflict")
    return CONFLICT if conflict else UNKNOWN, reading.reason or "no valid reading"


class Estimates:
    """The estimates of the places of SBs in one run. They are computed only if a reading has
    changed.
    """

    def __init__(self) -> None:
        self._key: object = None
        self._found: Mapping[str, Estimate] = {}

    def of(self, blueprint: Blueprint, status: DispatchStatus) -> Mapping[str, Estimate]:
        """Return the estimated place of each SB from its sensors."""
        values = tuple(reading.value for reading in status.scene.readings.values())
        key = (id(blueprint), values, tuple(status.configuration.items()))
        if key != self._key:
            self._key = key
            believed = status.configuration
            self._found = {
                name: estimate(blueprint, name, status.scene, believed) for name in believed
            }
        return self._found
