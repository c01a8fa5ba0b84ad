"""Facts have an age, a reason if they are unknown, and are refreshed only by newer samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import nan

from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.check import FactKey, Reading
from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.sample import Sample


@dataclass(frozen=True)
class Sensor:
    name: str = "eye"
    branch: str = "SB1"
    digit: int = 0
    max_age: float = 0.3
    aggregation: str = "single"


def _sample(value: str | None, sequence: int, boot: int = 0, source: str = "eye") -> Sample:
    return Sample("SB1", 0, source, value, 0.0, sequence, boot, "" if value else "it is dark")


def _read(monitor: FactMonitor, now: float) -> Reading:
    reading = monitor.scene(now).get("SB1", 0)
    assert reading is not None
    return reading


def test_a_fact_is_known_until_it_is_too_old() -> None:
    monitor = FactMonitor([Sensor()])
    assert _read(monitor, 0.0) == Reading(None, "no reading yet", 0.0)
    monitor.accept([_sample("a", 1)], 1.0)
    assert _read(monitor, 1.0) == Reading("a", "", 0.0)
    assert _read(monitor, 1.3).value == "a"
    assert _read(monitor, 1.31).value is None
    assert _read(monitor, 2.2).reason == "no reading for 1.2 s"


def test_no_valid_reading_is_unknown_with_its_reason() -> None:
    monitor = FactMonitor([Sensor()])
    monitor.accept([_sample("a", 1)], 1.0)
    monitor.accept([_sample(None, 2)], 1.1)
    assert _read(monitor, 1.1) == Reading(None, "it is dark", 0.0)


def test_late_and_repeated_samples_refresh_nothing() -> None:
    monitor = FactMonitor([Sensor()])
    monitor.accept([_sample("a", 5, boot=1)], 1.0)
    monitor.accept([_sample("a", 5, boot=1), _sample("c", 4, boot=1)], 1.4)
    assert _read(monitor, 1.4).reason == "no reading for 0.4 s"
    monitor.accept([_sample("d", 9)], 2.0)
    assert _read(monitor, 2.0).value is None, "a boot that is over"
    monitor.accept([_sample("e", 1, boot=2)], 2.4)
    assert _read(monitor, 2.4).value == "e"


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 5)), min_size=1, unique=True))
def test_only_what_is_newer_counts_whatever_the_order(samples: list[tuple[int, int]]) -> None:
    """Each comes when all before are too old; the source has no clock. A boot counts where no
    higher one was heard before it, and then with a growing sequence."""
    monitor, newest, highest = FactMonitor([Sensor()]), dict[int, int](), -1
    for now, (boot, sequence) in enumerate(samples):
        sample = _sample(f"{boot}.{sequence}", sequence, boot)
        monitor.accept([sample._replace(time=nan)], float(now))
        counts = sequence > newest[boot] if boot in newest else boot > highest
        value = _read(monitor, now + 0.1).value
        assert value == (f"{boot}.{sequence}" if counts else None)
        if counts:
            newest[boot] = sequence
        highest = max(highest, boot)


def test_strangers_are_not_heard() -> None:
    monitor = FactMonitor([Sensor()])
    monitor.accept([_sample("a", 1, source="passer-by")], 1.0)
    assert _read(monitor, 1.0).value is None
    assert monitor.scene(1.0).get("SB1", 1) is None


def test_sensors_that_disagree_make_a_fact_unknown() -> None:
    monitor = FactMonitor([Sensor("eye"), Sensor("ear")])
    monitor.accept([_sample("a", 1)], 1.0)
    assert _read(monitor, 1.0).value == "a"
    monitor.accept([_sample("a", 1, source="ear")], 1.1)
    assert _read(monitor, 1.1) == Reading("a", "", 0.0)
    monitor.accept([_sample("b", 2, source="ear")], 1.2)
    assert _read(monitor, 1.2).reason == "conflict: eye says a, ear says b"


def test_by_priority_the_first_that_can_speak_decides() -> None:
    first, second = Sensor("eye", aggregation="priority"), Sensor("ear", aggregation="priority")
    monitor = FactMonitor([first, second])
    monitor.accept([_sample("b", 1, source="ear"), _sample("a", 1)], 1.0)
    assert _read(monitor, 1.0).value == "a"
    monitor.accept([_sample("b", 2, source="ear"), _sample(None, 2)], 1.1)
    assert _read(monitor, 1.1).value == "b"


_ROUND = st.tuples(
    st.sampled_from([0.0, 0.05, 0.5]), st.tuples(*[st.sampled_from(["-", None, "a", "b"])] * 2)
)


@given(st.lists(_ROUND, max_size=12))
def test_a_scene_says_of_each_lone_source_what_the_source_says_now(
    rounds: list[tuple[float, tuple[str | None, ...]]],
) -> None:
    """Whether all sources, some or none have spoken at this instant, or twice (``-``: silent)."""
    monitor = FactMonitor([Sensor(digit=0), Sensor(digit=1)])
    now = 1.0
    former: list[tuple[Mapping[FactKey, Reading], dict[FactKey, Reading]]] = []
    both: tuple[float, tuple[str | None, ...]] = (0.05, ("a", "b"))
    for sequence, (pause, values) in enumerate([both, both, *rounds], 1):
        now += pause
        spoken = [pair for pair in enumerate(values) if pair[1] != "-"]
        if spoken:
            monitor.accept([Sample("SB1", d, "eye", v, now, sequence) for d, v in spoken], now)
        readings = monitor.scene(now).readings
        said = {one.fact: one.said for one in monitor.sources(now)}
        assert dict(readings) == {k: Reading(v.value, v.reason, v.age) for k, v in said.items()}
        former.append((readings, dict(readings)))
    assert all(readings == copy for readings, copy in former), "a scene never changes"
