"""A second speaker of a source makes its fact unknown, until one of the two is silent."""

from __future__ import annotations

import json
from dataclasses import dataclass
from itertools import count

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.check import Reading
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.bus import MOST_SPEAKERS, FactBus
from smsl_studio.monitor.facts import FactMonitor, SourceState
from smsl_studio.monitor.ledger import MOST
from smsl_studio.monitor.reception import Reception
from smsl_studio.monitor.sample import BAD, Sample
from smsl_studio.monitor.topics import FactTopic

FACT = ("SB1", 0)
MODES = ("single", "any", "all", "k_of_n", "priority")
CLOCK = 500.0
"""What the clock of a node is ahead of the receiver's."""


@dataclass(frozen=True)
class Sensor:
    name: str = "camera"
    branch: str = "SB1"
    digit: int = 0
    max_age: float = 0.3
    aggregation: str = "single"


class Heard:
    """A monitor that hears one camera from elsewhere, and perhaps a scale."""

    def __init__(self, rule: FactRule | None = None, scale: bool = False) -> None:
        names = ("camera", "scale") if scale else ("camera",)
        self.monitor = FactMonitor([Sensor(n) for n in names], {FACT: rule} if rule else {})
        self._sequences = count(1)

    def say(
        self, node: str, value: str | None, now: float, boot: int = 1, *,
        sequence: int | None = None, time: float | None = None, source: str = "camera",
    ) -> None:  # fmt: skip
        """A sample that comes at ``now``; its sequence grows where none is given."""
        number = next(self._sequences) if sequence is None else sequence
        clock = CLOCK + now if time is None else time
        sample = Sample(*FACT, source, value, clock, number, boot, received=now, node=node)
        self.monitor.accept([sample], 0.0)

    def read(self, now: float) -> Reading:
        found = self.monitor.scene(0.0, now).get(*FACT)
        assert found is not None
        return found

    def source(self, now: float) -> SourceState:
        return self.monitor.sources(0.0, now)[0]


@pytest.mark.parametrize("boots", [(1, 2), (2, 1), (5, 5)])
def test_a_second_speaker_makes_the_fact_unknown_and_both_are_named(boots: tuple[int, int]) -> None:
    heard = Heard()
    heard.say("bench", "a", 0.0, boots[0])
    heard.say("intruder", "b", 0.1, boots[1])
    assert heard.read(0.1) == Reading(None, "two speakers for camera: bench, intruder", 0.0)
    heard.say("bench", "a", 0.2, boots[0])
    assert heard.read(0.2).reason == "two speakers for camera: bench, intruder"
    assert heard.source(0.2).counted == 3


@pytest.mark.parametrize("boots", [(1, 2), (2, 1), (5, 5)])
@pytest.mark.parametrize("silent", ["bench", "intruder"])
def test_when_one_is_silent_for_its_age_the_other_counts(
    silent: str, boots: tuple[int, int]
) -> None:
    heard, values = Heard(), {"bench": ("a", boots[0]), "intruder": ("b", boots[1])}
    for tenth in range(11):
        now = tenth / 10
        for node, (value, boot) in values.items():
            if node != silent or tenth <= 5:
                heard.say(node, value, now, boot)
        assert (heard.read(now).value is None) == (tenth <= 8)
    (other,) = values.keys() - {silent}
    assert heard.read(1.0).value == values[other][0]


def test_one_name_and_two_boots_are_two_speakers() -> None:
    heard = Heard()
    heard.say("bench", "a", 0.0, 1)
    heard.say("bench", "b", 0.1, 2)
    reason = "two speakers for camera: bench of boot 1, bench of boot 2"
    assert heard.read(0.1).reason == reason
    heard.say("bench", "a", 0.2, 1)
    heard.say("bench", "a", 0.3, 1)
    heard.say("bench", "a", 0.4, 1)
    assert heard.read(0.4).reason == reason
    heard.say("bench", "a", 0.5, 1)
    assert heard.read(0.5).value == "a", "who was there first, though its boot is lower"


def test_a_node_that_was_started_again_counts_when_its_former_boot_is_old() -> None:
    heard = Heard()
    heard.say("bench", "a", 0.0, 1, sequence=900)
    heard.say("bench", "b", 0.2, 2, sequence=1)
    assert heard.read(0.2).value is None
    heard.say("bench", "b", 0.3, 2, sequence=2)
    assert heard.read(0.31).value == "b"
    heard.say("bench", "a", 0.4, 1, sequence=900, time=CLOCK)
    assert heard.read(0.4).value == "b", "a word that came already"


def test_who_is_held_up_on_the_way_is_not_silent() -> None:
    """Else a flood under its name would hold up its words until it is no more heard."""
    heard = Heard()
    heard.say("bench", "a", 0.0, sequence=1)
    heard.say("flood", "b", 0.1)
    for tenth in range(2, 20):
        heard.say("flood", "b", tenth / 10)
        heard.say("bench", "a", tenth / 10, sequence=tenth, time=CLOCK + tenth / 10 - 0.8)
        assert heard.read(tenth / 10).value is None
    assert heard.source(1.9).late > 5


def test_a_boot_that_is_over_never_counts() -> None:
    """Its words may still come in from somewhere: somebody speaks, and it is not evidence."""
    heard = Heard()
    heard.say("bench", "a", 0.0, 2)
    heard.say("bench", "b", 0.2, 1)
    assert heard.read(0.2).reason.startswith("two speakers for camera: bench of boot 2, bench")
    heard.say("bench", "b", 0.4, 1)
    assert heard.read(0.4) == Reading(None, "its samples are older than what was known", 0.0)


def test_two_programs_that_share_name_boot_and_clock_are_told_apart() -> None:
    """A sequence cannot fall while the clock goes on."""
    heard = Heard()
    heard.say("bench", "a", 0.0, sequence=20)
    heard.say("bench", "b", 0.05, sequence=1000)
    heard.say("bench", "a", 0.1, sequence=21)
    assert heard.read(0.1).reason == "two speakers for camera: bench, another program as bench"
    heard.say("bench", "b", 0.15, sequence=1001)
    heard.say("bench", "a", 0.2, sequence=22)
    assert heard.read(0.2).value is None
    for n, now in enumerate((0.3, 0.4, 0.5)):
        heard.say("bench", "a", now, sequence=23 + n)
    assert heard.read(0.5).value == "a"


@pytest.mark.parametrize("ahead", [5.0, 1e9, -0.1])
def test_a_borrowed_name_with_another_clock_is_noticed_at_once(ahead: float) -> None:
    heard = Heard()
    heard.say("bench", "a", 0.0, sequence=20)
    heard.say("bench", "a", 0.1, sequence=21)
    heard.say("bench", "b", 0.15, sequence=1000, time=CLOCK + 0.15 + ahead)
    assert heard.read(0.15).value is None
    for n, now in enumerate((0.2, 0.3, 0.4)):
        heard.say("bench", "a", now, sequence=22 + n)
        assert heard.read(now).value is None
    heard.say("bench", "a", 0.5, sequence=25)
    assert heard.read(0.5).value == "a"


def test_who_runs_ahead_of_another_under_its_name_is_noticed() -> None:
    """Its sequence and clock are copied and a little ahead: the other's words look overtaken."""
    heard = Heard()
    values = []
    for tenth in range(20):
        now = tenth / 10
        heard.say("bench", "a", now, sequence=20 + tenth)
        if 3 <= tenth < 12:
            heard.say("bench", "b", now + 0.02, sequence=40 + tenth, time=CLOCK + now + 0.15)
        values.append(heard.read(now + 0.02).value)
    assert values[:3] == ["a"] * 3
    assert values[6:14] == [None] * 8
    assert values[-1] == "a"


def test_words_that_come_once_more_or_too_late_are_no_second_speaker() -> None:
    heard = Heard()
    for tenth in range(5):
        heard.say("bench", "a", tenth / 10, sequence=tenth)
    heard.say("bench", "a", 0.45, sequence=4, time=CLOCK + 0.4)
    for sequence in range(4):
        heard.say("bench", "b", 0.46, sequence=sequence, time=CLOCK + sequence / 10)
    heard.say("bench", "b", 0.47, sequence=9, time=CLOCK - 9.0)
    assert heard.read(0.47).value == "a"
    source = heard.source(0.47)
    assert (source.counted, source.repeated, source.late) == (5, 5, 1)


@pytest.mark.parametrize("critical", [False, True])
@pytest.mark.parametrize("mode", MODES)
def test_under_no_rule_is_such_a_source_outvoted_or_replaced(mode: str, critical: bool) -> None:
    heard = Heard(FactRule(mode, 1, critical, conflict_after=5.0), scale=True)
    heard.say("bench", "a", 0.0)
    heard.say("bench", "a", 0.0, source="scale")
    assert heard.read(0.0).value == "a"
    heard.say("intruder", "a", 0.1)
    assert heard.read(0.1).reason == "two speakers for camera: bench, intruder"


def test_people_are_asked_as_ever() -> None:
    for rule in (FactRule("human"), FactRule(shared=True)):
        heard = Heard(rule)
        heard.say("bench", "a", 0.0)
        heard.say("intruder", "b", 0.0)
        assert heard.read(0.0).value is None
        heard.monitor.answer(*FACT, "b", "Ada", 0.0)
        assert heard.read(0.0).value == "b", "a person is not one of the two"


def test_who_says_nothing_valid_speaks_as_well() -> None:
    heard = Heard()
    heard.say("bench", "a", 0.0)
    heard.say("intruder", None, 0.1)
    assert heard.read(0.1).value is None
    heard.say("bench", "a", 0.2)
    assert heard.read(0.2).reason.startswith("two speakers")


def test_a_crowd_is_bounded_and_told_in_short() -> None:
    heard = Heard()
    heard.say("bench", "a", 0.0)
    for number in range(1000):
        heard.say(f"node {number} {'x' * 900}", "b", 0.1, number)
    reading = heard.read(0.1)
    assert reading.value is None
    assert reading.reason.startswith("several speakers for camera: bench, node 993 xx")
    assert len(reading.reason) < 400
    assert len(reading.reason.split(",")) == MOST
    heard.say("bench", "a", 0.5)
    assert heard.read(0.5).value == "a", "who was there first is never forgotten"


def test_what_nodes_without_a_name_are_called() -> None:
    heard = Heard()
    heard.say("", "a", 0.0, 1)
    heard.say("", "b", 0.0, 2)
    assert heard.read(0.0).reason == (
        "two speakers for camera: a node without a name of boot 1, a node without a name of boot 2"
    )


@given(
    st.lists(
        st.tuples(
            st.sampled_from(["bench", "intruder", ""]), st.integers(0, 4),
            st.integers(0, 50), st.floats(0.001, 1.6), st.floats(-5.0, 5.0),
        ),
        max_size=12,
    )
)  # fmt: skip
def test_whoever_else_speaks_is_never_believed(
    said: list[tuple[str, int, int, float, float]],
) -> None:
    """As long as the node that was there first goes on speaking under another name or boot."""
    heard = Heard()
    words = [(n / 10, "bench", 9, n, CLOCK + n / 10, "a") for n in range(17)]
    words += [(now, node, boot, number, CLOCK + now + off, "b")
              for node, boot, number, now, off in said if (node, boot) != ("bench", 9)]  # fmt: skip
    for now, node, boot, number, clock, value in sorted(words):
        heard.say(node, value, now, boot, sequence=number, time=clock)
        assert heard.read(now).value in ("a", None)
    heard.say("bench", "a", 1.9, 9, sequence=17)
    heard.say("bench", "a", 2.0, 9, sequence=18)
    assert heard.read(2.0).value == "a"


# on the way to the monitor ------------------------------------------------------------------------


def test_both_wait_on_the_bus_and_a_crowd_costs_no_memory() -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    bus.publish(Sample(*FACT, "camera", "a", n / 10, n, node="bench") for n in range(5))
    bus.publish([Sample(*FACT, "camera", "b", 0.2, 900, boot=7, node="intruder")])
    assert [(one.node, one.sequence) for one in inbox.take()] == [("bench", 4), ("intruder", 900)]
    bus.publish(Sample(*FACT, "camera", "b", 0.0, 1, boot=n) for n in range(5000))
    assert len(inbox.take()) == MOST_SPEAKERS


def test_two_words_that_cannot_be_of_one_speaker_both_wait() -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    first = Sample(*FACT, "camera", "b", 0.0, 900)
    bus.publish([first, Sample(*FACT, "camera", "a", 0.1, 21), first])
    assert [one.sequence for one in inbox.take()] == [900, 21]
    assert bus.counts.replaced == 1


def test_a_reception_hands_on_who_speaks_and_refuses_what_was_kept() -> None:
    reception = Reception("lab", "main", [Sensor()])
    monitor = FactMonitor([Sensor()])

    def say(node: str, boot: int, value: str, retained: bool = False) -> None:
        said = {"version": 1, "node": node, "boot": boot, "sequence": 1, "time": 0, "value": value}
        topic = str(FactTopic("lab", "main", *FACT, "camera"))
        reception.receive(topic, json.dumps(said).encode(), retained, 10.0)

    say("bench", 1, "a")
    say("intruder", 9, "b", retained=True)
    monitor.accept(reception.take(), 0.0)
    assert monitor.scene(0.0, 10.0).readings[FACT].value == "a"
    say("intruder", 9, "b")
    monitor.accept(reception.take(), 0.0)
    reading = monitor.scene(0.0, 10.0).readings[FACT]
    assert reading.reason == "two speakers for camera: bench, intruder"
    assert {node.name for node in reception.nodes(10.0)} == {"bench", "intruder"}
    say("x" * 2000, 9, "b")
    assert [one.kind for one in reception.received.refusals] == ["retained fact", "too long"]


def test_in_this_process_nobody_speaks_for_another_either() -> None:
    """The run's own sensors age on its clock; anybody may publish on its bus."""
    monitor = FactMonitor([Sensor("eye")])
    monitor.accept([Sample(*FACT, "eye", "a", 0.0, 1, 1)], 0.0)
    monitor.accept([Sample(*FACT, "eye", "a", 0.05, 2, 1)], 0.05)
    monitor.accept([Sample(*FACT, "eye", "b", 0.05, 10**6, 1)], 0.05)
    monitor.accept([Sample(*FACT, "eye", "a", 0.1, 3, 1)], 0.1)
    reason = "two speakers for eye: this program, another program as this program"
    assert monitor.scene(0.1).readings[FACT].reason == reason
    monitor.accept([Sample(*FACT, "eye", "b", 0.1, 1, 1, received=3.0, node="bench")], 0.1)
    assert monitor.scene(0.1, 3.0).readings[FACT].reason.startswith("three speakers for eye: this")
    assert monitor.scene(0.1, 3.0).readings[FACT].value is None


def test_a_bad_reading_of_the_only_speaker_is_bad() -> None:
    monitor = FactMonitor([Sensor("eye")])
    monitor.accept([Sample(*FACT, "eye", "a", 0.0, 1, 1, quality=BAD)], 0.0)
    assert monitor.scene(0.0).readings[FACT].reason == "its reading is bad"
