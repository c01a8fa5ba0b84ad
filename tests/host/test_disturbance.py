"""Disturbed sensors: every kind of disturbance, switched during a run, equal in both hosts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import UsageError
from smsl_studio.host.local import LocalHost
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.protocol import Host, Outcome
from smsl_studio.monitor.facts import FactMonitor
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

ON = Address("LAMP", "State_0", "Op_on")
START = {"LAMP": "State_0"}
TWO = LAMP_PLUGIN.replace(
    '    @library.operation("Op_{to}"',
    '    @library.sensor("eye_{n}", fact="{n}", period=0.05, max_age=0.2)\n'
    "    def eye(world, n: int):\n"
    '        return world.fact("LAMP", n - 1)\n\n'
    '    @library.operation("Op_{to}"',
    1,
)


@pytest.fixture
def host(tmp_path: Path) -> Iterator[LocalHost]:
    write_plugin(tmp_path, "lamp", TWO)
    host = LocalHost(blueprint_of(LAMP), "lamp", 7, [tmp_path])
    host.open(START)
    yield host
    host.close()


def _values(host: Host, ticks: int, sensor: str = "eye_1") -> list[str | None]:
    """What a sensor is heard to say, tick by tick; a dot where it is not heard."""
    found: list[str | None] = []
    for _ in range(ticks):
        heard = [sample.value for sample in host.tick().samples if sample.source == sensor]
        found.extend(heard or ["."])
    return found


def test_a_stuck_sensor_says_what_it_read_or_what_it_is_told(host: LocalHost) -> None:
    assert host.disturb("eye_1", "stuck") == ("eye_1",)
    host.begin(ON)
    assert _values(host, 4) == ["0"] * 4
    assert _values(host, 4, "bulb_1") == [".", "1", ".", "1"]
    host.disturb("eye_1", "stuck", value="x")
    assert _values(host, 2) == ["x", "x"]
    host.disturb("eye_1", "none")
    assert _values(host, 2) == ["1", "1"]


def test_a_fact_means_all_its_sensors(host: LocalHost) -> None:
    assert host.disturb("LAMP/0", "dropout") == ("bulb_1", "eye_1")
    assert host.sense() == ()
    host.disturb("bulb_1", "none")
    assert [sample.source for sample in host.sense()] == ["bulb_1"]


def test_a_lost_sensor_is_unknown_as_soon_as_it_is_too_old(host: LocalHost) -> None:
    opened = host.open(START)
    monitor = FactMonitor([one for one in opened.sensors if one.name == "eye_1"])
    monitor.accept(host.sense(), 0.0)
    host.disturb("eye_1", "dropout", rate=1.0)
    known = []
    for _ in range(6):
        tick = host.tick()
        monitor.accept(tick.samples, tick.time)
        known.append(monitor.scene(tick.time).readings["LAMP", 0].value)
    assert known == ["0"] * 4 + [None] * 2


def test_a_delay_brings_what_was_so_before(host: LocalHost) -> None:
    host.disturb("eye_1", "delay", seconds=0.1)
    host.begin(ON)
    assert _values(host, 6) == [".", ".", "0", "0", "1", "1"]
    late = [one for one in host.tick().samples if one.source == "eye_1"]
    assert late[0].time == pytest.approx(host.tick().time - 0.15)
    host.disturb("eye_1", "none")
    assert [one.sequence for one in host.tick().samples if one.source == "eye_1"] == [7, 9]


def test_a_drift_moves_on_and_stays_at_the_last(host: LocalHost) -> None:
    host.disturb("eye_1", "drift", every=0.1)
    assert _values(host, 5) == ["0", "0", "1", "1", "1"]


def test_noise_reads_another_value_now_and_then(host: LocalHost) -> None:
    host.disturb("eye_1", "noise", rate=0.5)
    heard = _values(host, 40)
    assert 8 < heard.count("1") < 32
    host.disturb("eye_1", "noise", rate=0.0)
    assert set(_values(host, 10)) == {"0"}


def test_kinds_add_up_until_all_end(host: LocalHost) -> None:
    host.disturb("eye_1", "delay", seconds=0.05)
    host.disturb("eye_1", "stuck", value="1")
    assert _values(host, 3) == [".", "1", "1"]
    host.open(START)
    assert _values(host, 2) == ["0", "0"]


@pytest.mark.parametrize(
    ("target", "kind", "parameters", "words"),
    [
        ("eye", "stuck", {}, "nothing called 'eye' is sensed"),
        ("LAMP/1", "stuck", {}, "nothing called 'LAMP/1' is sensed"),
        ("eye_1", "noisy", {}, "there is no disturbance 'noisy'"),
        ("eye_1", "noise", {"seconds": 1.0}, "the disturbance noise has no 'seconds'"),
        ("eye_1", "none", {"rate": 1.0}, "the disturbance none has no 'rate'"),
        ("eye_1", "noise", {"rate": 1.5}, "rate of noise is 1.5, not a number from 0 to 1"),
        ("eye_1", "noise", {"rate": float("nan")}, "rate of noise is nan"),
        ("eye_1", "noise", {"rate": True}, "rate of noise is True"),
        ("eye_1", "delay", {"seconds": -1}, "seconds of delay is -1"),
        ("eye_1", "drift", {"every": 0}, "every of drift is 0, not a number from above 0"),
        ("eye_1", "stuck", {"value": 3}, "stuck at a text, not at 3"),
    ],
)
def test_what_cannot_be_disturbed_is_said(
    host: LocalHost, target: str, kind: str, parameters: dict[str, Any], words: str
) -> None:
    with pytest.raises(UsageError, match=words):
        host.disturb(target, kind, **parameters)
    assert set(_values(host, 3)) == {"0"}


switches = st.lists(
    st.tuples(
        st.sampled_from(["eye_1", "bulb_1", "LAMP/0"]),
        st.sampled_from(
            [("stuck", {}), ("stuck", {"value": "1"}), ("noise", {"rate": 0.5}), ("none", {}),
             ("dropout", {"rate": 0.4}), ("delay", {"seconds": 0.1}), ("drift", {"every": 0.2})]
        ),
    ),
    min_size=1, max_size=5,
)  # fmt: skip


def _story(host: Host, switched: Sequence[Any]) -> list[Any]:
    found: list[Any] = [host.open(START), host.sense()]
    host.begin(ON)
    for target, (kind, parameters) in switched:
        found.append(host.disturb(target, kind, **parameters))
        found.extend(host.tick() for _ in range(8))
    assert Outcome.RETURNED in [one.outcome for one in found if hasattr(one, "outcome")]
    return found


def test_both_hosts_are_disturbed_alike(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", TWO)
    child = ProcessHost(blueprint_of(LAMP), "lamp", 7, [tmp_path])
    try:
        with_child(child, tmp_path)
    finally:
        child.close()


def with_child(child: ProcessHost, folder: Path) -> None:
    """One child for all examples: it is opened anew for each, and so is what it is compared to."""
    local = LocalHost(blueprint_of(LAMP), "lamp", 7, [folder])

    @settings(max_examples=10, database=None)
    @given(switches)
    def alike(switched: Sequence[Any]) -> None:
        assert _story(local, switched) == _story(child, switched)

    alike()
    local.open(START)
    with pytest.raises(UsageError, match="nothing called") as caught:
        child.disturb("eye_2", "stuck")
    assert caught.value.advice == "Did you mean eye_1?"


def test_the_seed_decides_what_goes_wrong(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", TWO)
    heard = []
    for seed in (1, 1, 2):
        host = LocalHost(blueprint_of(LAMP), "lamp", seed, [tmp_path])
        host.open(START)
        host.disturb("eye_1", "noise", rate=0.5)
        heard.append(_values(host, 30))
        host.close()
    assert heard[0] == heard[1] != heard[2]
