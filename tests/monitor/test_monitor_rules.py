"""Facts by their declared rules: missing sensors, short conflicts, people, late samples."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.check import Reading
from smsl_studio.errors import UsageError
from smsl_studio.monitor.aggregate import NOBODY, FactRule
from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.sample import UNCERTAIN, Sample

FACT = ("SB1", 0)


@dataclass(frozen=True)
class Sensor:
    name: str
    branch: str = "SB1"
    digit: int = 0
    max_age: float = 0.3
    aggregation: str = "single"


def _monitor(rule: FactRule, *names: str) -> FactMonitor:
    return FactMonitor([Sensor(name) for name in names], {FACT: rule})


def _say(monitor: FactMonitor, now: float, sequence: int, **said: str | None) -> None:
    samples = [Sample(*FACT, name, value, now, sequence) for name, value in said.items()]
    monitor.accept(samples, now)


def _read(monitor: FactMonitor, now: float) -> Reading:
    reading = monitor.scene(now).get(*FACT)
    assert reading is not None
    return reading


def test_a_named_sensor_that_nobody_has_counts_as_silent() -> None:
    monitor = _monitor(FactRule("all", sensors=("eye", "ear")), "eye")
    _say(monitor, 0.0, 1, eye="1")
    reading = _read(monitor, 0.0)
    assert reading.value is None
    assert reading.reason == ("not all sensors have a reading (ear: this world has no such sensor)")
    assert _read(_monitor(FactRule("all", sensors=("eye",))), 0.0).value is None
    any_of = _monitor(FactRule("any", sensors=("eye", "ear")), "eye")
    _say(any_of, 0.0, 1, eye="1")
    assert _read(any_of, 0.0).value == "1"


def test_a_short_disagreement_leaves_what_was_agreed() -> None:
    monitor = _monitor(FactRule("all", conflict_after=0.2), "eye", "ear")
    _say(monitor, 0.0, 1, eye="0", ear="0")
    assert _read(monitor, 0.0).value == "0"
    _say(monitor, 0.1, 2, eye="1", ear="0")
    assert _read(monitor, 0.1) == Reading("0", "", 0.1)
    assert _read(monitor, 0.2).value == "0"
    assert _read(monitor, 0.21).reason == "conflict: eye says 1, ear says 0"
    _say(monitor, 0.22, 3, ear="1")
    assert _read(monitor, 0.22).value == "1"


def test_a_disagreement_from_the_first_is_a_conflict_at_once() -> None:
    monitor = _monitor(FactRule("any", conflict_after=0.2), "eye", "ear")
    _say(monitor, 0.0, 1, eye="0", ear="1")
    assert _read(monitor, 0.0).value is None


def test_what_nobody_says_any_more_does_not_stay() -> None:
    monitor = _monitor(FactRule("any", conflict_after=0.2), "eye", "ear")
    _say(monitor, 0.0, 1, eye="a", ear="a")
    _read(monitor, 0.0)
    _say(monitor, 0.1, 2, eye="b", ear="c")
    assert _read(monitor, 0.1).value is None


def test_what_was_unknown_in_between_does_not_come_back() -> None:
    monitor = _monitor(FactRule("any", conflict_after=0.5), "eye", "ear")
    _say(monitor, 0.0, 1, eye="0", ear="0")
    _read(monitor, 0.0)
    _say(monitor, 0.1, 2, eye=None, ear=None)
    assert _read(monitor, 0.1).value is None
    _say(monitor, 0.2, 3, eye="0", ear="1")
    assert _read(monitor, 0.2).value is None


def test_disagreement_is_a_conflict_at_once_where_nothing_is_declared() -> None:
    monitor = _monitor(FactRule("any"), "eye", "ear")
    _say(monitor, 0.0, 1, eye="0", ear="0")
    assert _read(monitor, 0.0).value == "0"
    _say(monitor, 0.0, 2, eye="1", ear="0")
    assert _read(monitor, 0.0).value is None


def test_a_person_answers_and_no_sensor_does() -> None:
    monitor = _monitor(FactRule("human", max_age=60.0), "eye")
    _say(monitor, 0.0, 1, eye="1")
    assert _read(monitor, 0.0).reason == NOBODY
    monitor.answer(*FACT, "0", "Ada", 1.0)
    assert _read(monitor, 61.0) == Reading("0", "", 60.0)
    assert _read(monitor, 61.1).reason == "the answer is 60.1 s old"
    monitor.answer(*FACT, None, "Ada", 62.0)
    assert _read(monitor, 62.0).reason == NOBODY


def test_a_sensor_may_not_pass_for_a_person() -> None:
    monitor = _monitor(FactRule("human"))
    monitor.answer(*FACT, "0", "Ada", 0.0)
    _say(monitor, 0.1, 1, Ada="1")
    assert _read(monitor, 0.1).value == "0"
    assert monitor.strangers == 1


def test_a_person_answers_only_what_is_asked_of_one() -> None:
    monitor = _monitor(FactRule("any"), "eye")
    for digit in (0, 7):
        with pytest.raises(UsageError, match=f"SB1/{digit} is not a fact that a person answers"):
            monitor.answer("SB1", digit, "1", "Ada", 0.0)


def test_a_person_may_say_what_sensors_leave_unknown() -> None:
    monitor = _monitor(FactRule(shared=True), "eye")
    assert _read(monitor, 0.0).value is None
    monitor.answer(*FACT, "0", "Ada", 0.5)
    assert _read(monitor, 1.0) == Reading("0", "", 0.5)
    assert monitor.answered() == (FACT,)
    _say(monitor, 1.0, 1, eye="1")
    assert _read(monitor, 1.0).value == "1", "where a sensor knows, it counts"
    assert _read(monitor, 9.0).value == "0", "and a person again where it is stale"
    monitor.answer(*FACT, None, "Ada", 9.0)
    assert _read(monitor, 9.0).value is None
    assert monitor.answered() == ()


def test_a_person_settles_what_sensors_disagree_about() -> None:
    monitor = _monitor(FactRule("all", shared=True), "eye", "ear")
    _say(monitor, 0.0, 1, eye="1", ear="0")
    assert _read(monitor, 0.0).reason.startswith("conflict")
    monitor.answer(*FACT, "0", "Ada", 0.0)
    assert _read(monitor, 0.0) == Reading("0", "", 0.0)


def test_only_a_good_reading_is_evidence() -> None:
    monitor = _monitor(FactRule(), "eye")
    monitor.accept([Sample(*FACT, "eye", "1", 0.0, 1, quality=UNCERTAIN)], 0.0)
    assert _read(monitor, 0.0).reason == "its reading is uncertain"


def test_what_was_held_up_too_long_refreshes_nothing() -> None:
    """A broker froze for 2 s, and hands out what it kept: the clocks are 100 s apart."""
    monitor = _monitor(FactRule(), "eye")
    for sequence in range(3):
        monitor.accept([Sample(*FACT, "eye", "1", 100 + sequence / 10, sequence)], sequence / 10)
    kept = [Sample(*FACT, "eye", "0", 100 + s / 10, s) for s in range(3, 22)]
    monitor.accept(kept[:15], 2.2)
    assert _read(monitor, 2.2).reason == "no reading for 2.0 s"
    monitor.accept(kept[15:], 2.2)
    assert _read(monitor, 2.2).value == "0"
    (state,) = monitor.sources(2.2)
    assert (state.counted, state.late, state.repeated) == (6, 16, 0)
    assert state.latency == pytest.approx(0.1, abs=0.01)


def test_a_slow_clock_is_no_late_sample() -> None:
    monitor = _monitor(FactRule(), "eye")
    for second in range(2000):
        monitor.accept([Sample(*FACT, "eye", "1", second * 0.9995, second)], float(second))
    (state,) = monitor.sources(1999.0)
    assert (state.late, state.said.value) == (0, "1")


def test_a_source_without_a_clock_is_never_late() -> None:
    monitor = _monitor(FactRule(), "eye")
    for second in range(3):
        monitor.accept([Sample(*FACT, "eye", "1", float("nan"), second)], float(second))
    assert _read(monitor, 2.0).value == "1"
    for sequence, time in ((3, -100.0), (4, float("inf")), (5, -99.8)):
        monitor.accept([Sample(*FACT, "eye", "0", time, sequence)], 2.5)
    (state,) = monitor.sources(2.5)
    assert (state.counted, state.late, state.latency) == (6, 0, 0.0)


def test_a_new_boot_has_a_clock_of_its_own() -> None:
    monitor = _monitor(FactRule(), "eye")
    monitor.accept([Sample(*FACT, "eye", "0", 500.0, 900)], 0.0)
    monitor.accept([Sample(*FACT, "eye", "1", 0.0, 1, boot=1)], 10.0)
    assert _read(monitor, 10.0).value == "1"


def test_every_source_is_seen_also_one_that_does_not_count() -> None:
    monitor = _monitor(FactRule("k_of_n", 2, sensors=("eye", "ear")), "eye")
    for now in (0.0, 0.1):
        monitor.accept([Sample(*FACT, "eye", "1", 0.0, 1)], now)
    eye, ear = monitor.sources(0.1)
    assert (eye.said.source, eye.said.value, eye.repeated) == ("eye", "1", 1)
    assert (ear.said.source, ear.said.value, ear.sample) == ("ear", None, None)
    assert eye.limit == 0.3


@given(
    st.permutations([(name, s) for name in ("eye", "ear") for s in range(4)]),
    st.sampled_from(["single", "any", "all", "k_of_n", "priority"]),
    st.lists(st.sampled_from(["0", "1", None]), min_size=8, max_size=8),
)
def test_the_order_of_arrival_does_not_matter(
    arrived: list[tuple[str, int]], mode: str, read: list[str | None]
) -> None:
    def after(order: list[tuple[str, int]]) -> Reading:
        monitor = _monitor(FactRule(mode, 2), "eye", "ear")
        for name, sequence in order:
            value = read[sequence + 4 * (name == "ear")]
            monitor.accept([Sample(*FACT, name, value, 0.0, sequence)], 0.0)
        return _read(monitor, 0.0)._replace(reason="")

    assert after(arrived) == after(sorted(arrived))
