"""Facts that predicates decide from measures: random stories, and each rule by itself."""

from __future__ import annotations

import re
import sys
from random import Random
from types import FrameType
from typing import Any

import pytest

from smsl_studio.blueprint.check import Reading
from smsl_studio.blueprint.predicates import sense_of
from smsl_studio.blueprint.predicates.measure import measure_of, measure_text
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.sample import UNCERTAIN, Sample
from tests.monitor.predicate_stories import FACT, JUNK, Source, told_apart

STORIES = 250
"""A twentieth of those in the bench ``predicates``."""


class Told:
    """A fact with its sources, which a test lets speak and looks at."""

    def __init__(self, *names: str, there: str = "", rule: FactRule | None = None, **entry: Any):
        sense = sense_of(entry)
        assert sense is not None
        sources = [Source(name, 0.3) for name in (there.split() if there else names)]
        base = rule or FactRule()
        self.monitor = FactMonitor(
            sources, {FACT: FactRule(base.aggregation, shared=base.shared, sense=sense)}
        )
        self._sequence = 0

    def look(self, now: float, quality: str = "good", node: str = "", **said: str) -> Reading:
        self._sequence += 1
        samples = [
            Sample("SB", 0, name, text, now, self._sequence, 0, "", quality, None, node)
            for name, text in said.items()
        ]
        self.monitor.accept(samples, now)
        reading = self.monitor.scene(now).get(*FACT)
        assert reading is not None
        return reading


def clamp(**more: Any) -> Told:
    sources: dict[str, Any] = {"sources": {"force": "N"}, "range": {"force": [-5, 50]}}
    return Told(
        "force", **sources, **{"predicate": {"0": "force < 1 N", "1": "force > 2 N"}, **more}
    )


@pytest.mark.parametrize("part", range(5))
def test_random_predicates_and_streams_are_decided_as_in_the_plain_way(part: int) -> None:
    for number in range(part * STORIES // 5, (part + 1) * STORIES // 5):
        assert told_apart(number) == ""


def test_between_the_bounds_the_last_value_stays_for_its_largest_age() -> None:
    told = clamp()
    assert told.look(0.0, force="1.5").reason == "its measures mean none of its values"
    assert told.look(0.1, force="2.5").value == "1"
    assert told.look(0.2, force="1.5").value == "1"
    assert told.look(0.4, force="1.5").value == "1"
    reading = told.look(0.5, force="1.5")
    assert reading.value is None
    assert reading.reason == "its measures are between those of its values for 0.4 s"
    assert told.look(0.6, force="0.5").value == "0"


def test_an_unknown_between_ends_what_stays() -> None:
    told = clamp()
    assert told.look(0.0, force="2.5").value == "1"
    assert told.look(0.1, force="60").reason == "force: 60 N is outside -5 to 50 N"
    assert told.look(0.2, force="1.5").value is None


def test_two_values_at_once_are_told() -> None:
    told = clamp(predicate={"0": "force < 3 N", "1": "force > 2 N", "2": "force < 9 N"})
    assert told.look(0.0, force="2.5").reason == "3 values are true at once: 0 and 1 and 2"


@pytest.mark.parametrize("text", JUNK)
def test_what_is_no_number_is_unknown(text: str) -> None:
    told = clamp()
    assert told.look(0.0, force="2.5").value == "1"
    reading = told.look(0.1, force=text)
    assert reading.value is None
    assert reading.reason.startswith("force: ")


def test_quality_age_and_a_missing_source_are_told() -> None:
    told = clamp()
    assert told.look(0.0).reason == "force: no reading yet"
    assert told.look(0.1, UNCERTAIN, force="2.5").reason == "force: its reading is uncertain"
    assert told.look(0.2, force="2.5").value == "1"
    assert told.look(0.5).value == "1"
    assert told.look(0.6).reason == "force: no reading for 0.4 s"
    alone = Told("force", sources={"force": "N", "gap": "mm"}, there="force",
                 predicate={"1": "force > 2 N and gap < 1 mm", "0": "force < 1 N"})  # fmt: skip
    assert alone.look(0.0, force="2.5").reason == "gap: this world has no such source"
    assert alone.look(0.1, force="0.5").value == "0"


def test_a_second_speaker_makes_it_unknown() -> None:
    told = clamp()
    assert told.look(0.0, node="one", force="2.5").value == "1"
    reading = told.look(0.1, node="two", force="2.5")
    assert reading.reason.endswith("two speakers for force: one, two")


def test_a_person_tells_what_the_sources_leave_unknown() -> None:
    told = clamp(rule=FactRule(shared=True))
    told.monitor.answer("SB", 0, "0", "nurse", 0.0)
    assert told.look(0.0).value == "0"
    assert told.look(0.1, force="2.5").value == "1"


def test_a_predicate_that_cannot_be_read_leaves_the_fact_unknown() -> None:
    told = clamp(predicate={"0": "force < 1 mm", "1": "force > 2 N"})
    reading = told.look(0.0, force="2.5")
    assert reading.value is None
    assert "1 mm is compared with a measure in N" in reading.reason


def test_a_tag_that_is_no_longer_read_has_an_age() -> None:
    told = Told("tag", sources={"tag": "1"},
                predicate={"in": "age(tag) < 1 s", "out": "age(tag) > 2 s"})  # fmt: skip
    assert told.look(0.0).reason == "tag: no reading yet"
    for at, wanted in ((0.25, None), (1.5, None), (2.5, "out")):
        assert told.look(at).value == wanted
    assert told.look(2.75, tag="1").value == "in"
    assert told.look(3.5).value == "in"
    assert told.look(3.9).value is None
    assert told.look(5.0).value == "out"


def test_numbers_are_sent_as_they_are() -> None:
    for number in (0.1, -1e-300, 5, 1 / 3, 2**52 + 1):
        text = measure_text(number)
        assert text is not None
        assert measure_of(text, position=False) == number
    place = measure_text((0.1, 2, -3.5))
    assert place is not None
    assert measure_of(place, position=True) == (0.1, 2.0, -3.5)
    for wrong in (float("nan"), float("inf"), True, "1", None, [1, 2], ["1", 2, 3], [[1, 2, 3]] * 3,
                  2**60, object()):  # fmt: skip
        assert measure_text(wrong) is None


def test_a_number_is_read_as_its_grammar_says() -> None:
    grammar = re.compile(r"-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
    chance = Random(7)
    read = 0
    for _ in range(4000):
        text = "".join(
            chance.choices("0123456789.-+eE_ xnaif\n\u0661", (6,) * 10 + (4, 3) + (1,) * 12, k=4)
        )
        found = measure_of(text, position=False)
        assert isinstance(found, float) is (grammar.fullmatch(text) is not None), text
        read += isinstance(found, float)
    assert read > 400


def test_a_sample_costs_few_calls() -> None:
    many, calls = 50, 0
    sense = sense_of({"sources": {"force": "N"}, "range": {"force": [-5, 50]},
                      "predicate": {"0": "force < 1 N", "1": "force > 2 N for 0.1 s"}})  # fmt: skip
    monitor = FactMonitor(
        [Source("force", 0.3, digit=at) for at in range(many)],
        {("SB", at): FactRule(sense=sense) for at in range(many)},
    )

    def count(frame: FrameType, event: str, _: Any) -> None:
        nonlocal calls
        calls += event == "call"

    for number, text in enumerate(("0.5", "1.5", "2.5")):
        now = number / 100
        samples = [Sample("SB", at, "force", text, now, number) for at in range(many)]
        calls = 0
        sys.setprofile(count)
        monitor.accept(samples, now)
        scene = monitor.scene(now)
        sys.setprofile(None)
        assert number == 0 or calls <= 12 * many + 10
        assert scene.get("SB", 0) is not None
