"""The bindings file beside a blueprint names the facts of remote sensors, and their sources."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from shutil import copy

import pytest

from smsl_studio import front
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli import main
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import HostError, PluginError, UsageError
from smsl_studio.front.elsewhere import with_remote
from smsl_studio.front.inputs import read
from smsl_studio.front.request import RunRequest
from smsl_studio.front.run_header import log_header
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import OpenedWorld
from smsl_studio.host.remote import Remote, WithRemote
from smsl_studio.monitor.reception import Reception
from smsl_studio.monitor.topics import FactTopic
from smsl_studio.runlog.events import Event, OperationStarted
from smsl_studio.runlog.grammar.log_reader import read_log
from smsl_studio.shipped import samples_dir
from tests.monitor.broker import MAX_AGE, Broker, Node, Speaker, until, with_ages

MQTT = '[mqtt]\nbroker = "127.0.0.1:1"\nsite = "lab"\nrun = "trial"\n'
Declare = Callable[[str], Blueprint]


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    made = Broker(tmp_path)
    yield made
    made.kill()


@pytest.fixture
def declare(tmp_path: Path) -> Declare:
    """A blueprint of Hanoi with this text beside it."""

    def make(text: str) -> Blueprint:
        with_ages("hanoi-2", tmp_path)
        (tmp_path / "hanoi-2.toml").write_text(text, "utf-8")
        return read(tmp_path / "hanoi-2.json")

    return make


def _host(blueprint: Blueprint, broker: str = "", site: str = "") -> object:
    return with_remote(
        RunRequest(blueprint, broker=broker, site=site), LocalHost(blueprint, "table")
    )


def test_where_nothing_is_declared_a_host_is_what_it_is(declare: Declare) -> None:
    for text in ("", MQTT.replace('broker = "127.0.0.1:1"\n', "")):
        assert isinstance(_host(declare(text)), LocalHost)


def test_what_is_declared_is_a_sensor_of_the_run(declare: Declare) -> None:
    host = _host(declare(MQTT + '[mqtt.facts]\n"SB1/0" = ["eye", "ear"]\n'))
    assert isinstance(host, WithRemote)
    said = [(s.name, s.branch, s.digit, s.max_age, s.remote) for s in host.remote.sensors]
    assert said == [("eye", "SB1", 0, MAX_AGE, True), ("ear", "SB1", 0, MAX_AGE, True)]
    view = host.remote.view()
    assert (view.broker, view.site, view.run) == ("127.0.0.1:1", "lab", "trial")


def test_what_is_asked_for_takes_the_place_of_the_file(declare: Declare) -> None:
    blueprint = declare(MQTT + '[mqtt.facts]\n"SB1/0" = "eye"\n')
    host = _host(blueprint, broker="10.0.0.1", site="ward")
    assert isinstance(host, WithRemote)
    assert (host.remote.view().broker, host.remote.view().site) == ("10.0.0.1", "ward")


def test_the_header_of_a_log_names_what_is_heard_and_where(declare: Declare) -> None:
    blueprint = declare(MQTT + '[mqtt.facts]\n"SB1/0" = ["eye", "ear"]\n"SB1/1" = "eye"\n')
    facts = {"SB1/0": ["eye", "ear"], "SB1/1": ["eye"]}
    heard = {"broker": "127.0.0.1:1", "site": "lab", "run": "trial", "facts": facts}
    assert log_header(RunRequest(blueprint), None)["mqtt"] == heard
    asked = log_header(RunRequest(blueprint, broker="10.0.0.1", site="ward"), None)
    assert asked["mqtt"] == {**heard, "broker": "10.0.0.1", "site": "ward"}
    assert log_header(RunRequest(declare(MQTT)), None)["mqtt"] is None
    assert log_header(RunRequest(declare("no toml")), None)["mqtt"] is None


@pytest.mark.parametrize(
    ("facts", "words"),
    [
        ('"SB1/7" = "eye"', "'SB1/7' is no fact that a sensor could read"),
        ('"SB1" = "eye"', "'SB1' is no fact that a sensor could read"),
        ('"SB1/0" = ""', "'SB1/0' names a source without a name"),
        ('"SB1/0" = 3', "mqtt.facts.SB1/0"),
    ],
)
def test_what_makes_no_sense_is_said_with_its_place(
    facts: str, words: str, declare: Declare
) -> None:
    with pytest.raises(PluginError, match=words) as caught:
        _host(declare(f"{MQTT}[mqtt.facts]\n{facts}\n"))
    assert caught.value.place is not None
    assert caught.value.place.line == 6


def test_an_expanded_fact_has_no_sensor_elsewhere_either(tmp_path: Path) -> None:
    copy(samples_dir() / "hfsm.json", tmp_path)
    (tmp_path / "hfsm.toml").write_text(f'{MQTT}[mqtt.facts]\n"SB1/1" = "eye"\n', "utf-8")
    with pytest.raises(PluginError, match="'SB1/1' is no fact that a sensor could read"):
        _host(read(tmp_path / "hfsm.json"))


def test_facts_without_a_broker_and_a_broker_without_facts(declare: Declare) -> None:
    with pytest.raises(UsageError, match=r"no broker is named .* elsewhere: SB1"):
        _host(declare('[mqtt.facts]\n"SB1/0" = "eye"\n'))
    with pytest.raises(UsageError, match="a broker is named and no fact is sensed elsewhere"):
        _host(declare(""), broker="localhost")


class _Line:
    """What brings messages, without a network: a test puts them into the reception itself."""

    broker, lost, connections, connected = "nowhere", None, 1, True
    secure = False

    def open(self) -> None:
        """Nothing to connect to."""

    def close(self) -> None:
        """Nothing to leave."""


def _opened(
    declare: Declare, facts: str, sensors: str
) -> tuple[WithRemote, Reception, OpenedWorld]:
    blueprint = declare(f"{MQTT}[mqtt.facts]\n{facts}\n")
    declared = _host(blueprint)
    assert isinstance(declared, WithRemote)
    reception = Reception("lab", "trial", declared.remote.sensors)
    values = {("SB1", 0): ("a", "b", "c")}
    remote = Remote(_Line(), reception, declared.remote.sensors, values, 0)
    rules = {("SB1", 0): declared._rules["SB1", 0]}
    host = WithRemote(LocalHost(blueprint, "table"), remote, rules, frozenset({("SB1", 0)}))
    for sequence, source in enumerate(sensors.split()):
        topic = str(FactTopic("lab", "trial", "SB1", 0, source))
        said = {"version": 1, "boot": 1, "sequence": sequence, "time": 1.0, "value": "a"}
        reception.receive(topic, json.dumps(said).encode(), False, remote.clock())
    return host, reception, host.open({"SB1": "State_aa"})


def test_on_the_table_a_fact_is_not_sensed_twice(declare: Declare) -> None:
    host, _, opened = _opened(declare, '"SB1/0" = ["eye", "ear"]', "eye ear")
    assert [(s.name, s.digit) for s in opened.sensors if s.remote] == [("eye", 0), ("ear", 0)]
    assert [(s.name, s.digit) for s in opened.sensors if not s.remote] == [("table_SB1_1", 1)]
    assert {sample.source for sample in host.sense()} == {"table_SB1_1"}
    assert {sample.source for sample in host.tick().samples} <= {"table_SB1_1"}
    assert opened.settle >= MAX_AGE
    host.close()


def test_disturbances_reach_whoever_is_meant(declare: Declare) -> None:
    host, _, opened = _opened(declare, '"SB1/0" = ["eye", "ear"]', "eye ear")
    assert host.disturb("eye", "stuck", value="c") == ("eye",)
    assert host.disturb("table_SB1_1", "stuck") == ("table_SB1_1",)
    assert opened.remote is not None
    assert {one.source: one.value for one in opened.remote.heard()} == {"eye": "c", "ear": "a"}
    assert host.disturb("SB1/0", "dropout") == ("eye", "ear")
    with pytest.raises(UsageError, match="nothing called 'nose' is sensed"):
        host.disturb("nose", "stuck")
    with pytest.raises(UsageError, match="there is no disturbance 'stick'"):
        host.disturb("eye", "stick")
    host.close()


def test_a_run_that_is_closed_waits_for_nobody(declare: Declare) -> None:
    """The ear has not spoken, and never will."""
    declared = _host(declare(f'{MQTT}[mqtt.facts]\n"SB1/0" = "ear"\n'))
    assert isinstance(declared, WithRemote)
    reception = Reception("lab", "trial", declared.remote.sensors)
    remote = Remote(_Line(), reception, declared.remote.sensors, {}, 0)
    remote.close()
    with pytest.raises(HostError, match="the host is closed"):
        remote.open()


def test_a_headless_run_hears_a_node(
    tmp_path: Path, broker: Broker, declare: Declare, capsys: pytest.CaptureFixture[str]
) -> None:
    declare('[mqtt]\nsite = "lab"\n[mqtt.facts]\n"SB1/1" = "eye"\n')
    node = Node(broker, "SB1/1:eye=a")
    try:
        command = ["run", str(tmp_path / "hanoi-2.json"), "--world", "table", "--format", "json"]
        goal = ["--start", "State_aa", "--goal", "State_ba", "--broker", broker.address]
        assert main([*command, *goal]) == 0
        told = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
        assert told[-1]["reason"] == "goal_reached"
        node.kill()
        assert main([*command, "--start", "State_aa", "--broker", broker.address]) == 1
        last = json.loads(capsys.readouterr().out.splitlines()[-1])
        assert (last["reason"], "no reading yet" in last["sentence"]) == ("refused", True)
        where = f"SB1/1 as eye to the site 'lab' and the run 'main' at {broker.address}."
        assert where in last["sentence"]
    finally:
        node.kill()


def test_a_run_waits_for_sensors_elsewhere_however_fast_it_may_go(
    broker: Broker, declare: Declare, tmp_path: Path
) -> None:
    """The eye is told of the move when it begins: by the time the check decides, it says so."""
    blueprint = declare('[mqtt]\nsite = "lab"\n[mqtt.facts]\n"SB1/0" = "eye"\n')
    node = Node(broker, "SB1/0:eye=a")

    def hear(event: Event) -> None:
        if isinstance(event, OperationStarted):
            node.say("eye b")

    try:
        done = front.run(
            blueprint,
            "table",
            "State_ba",
            "State_aa",
            broker=broker.address,
            on_event=hear,
            log=tmp_path / "log",
        )
        assert read_log(tmp_path / "log", COMMANDS).header["mqtt"]["broker"] == broker.address
        assert (done.reason, done.sentence) == ("goal_reached", "SB1/State_ba holds.")
    finally:
        node.kill()


def test_a_value_that_comes_from_elsewhere_decides(broker: Broker, declare: Declare) -> None:
    """The table has moved the disk long since; the edge is committed when the eye says so."""
    blueprint = declare('[mqtt]\nsite = "lab"\n[mqtt.facts]\n"SB1/0" = "eye"\n')
    node, speaker = Node(broker, "SB1/0:eye=a"), Speaker(broker)
    dispatcher = front.open_run(
        blueprint, "table", host="local", automatic=False, broker=broker.address
    )
    try:
        dispatcher.open()
        dispatcher.ask(blueprint.resolve("SB1/State_aa/Op_1b"))
        dispatcher.tick()
        assert dispatcher.status.running is not None
        opened = dispatcher.opened
        assert opened is not None
        assert opened.remote is not None
        remote = opened.remote
        node.kill()
        until(lambda: (remote.view().nodes[0].heard or 0.0) > MAX_AGE, "the first node is silent")
        topic = str(FactTopic("lab", "main", "SB1", 0, "eye"))
        said = {"version": 1, "node": "n", "boot": 2**52, "sequence": 1, "time": 0, "value": "b"}
        speaker.send(topic, said)
        until(lambda: any(one.name == "n" for one in remote.view().nodes), "b is heard")
        while dispatcher.status.running is not None:
            dispatcher.tick()
        assert dispatcher.status.configuration == {"SB1": "State_ba"}
    finally:
        dispatcher.close()
        speaker.close()
        node.kill()
