"""The rows of the monitor page: known facts, unknown facts, and sources that disagree."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pytest
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.check import Scene
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.monitor_rows import (
    GONE,
    Estimates,
    MonitorRow,
    monitor_rows,
    of_lost,
    short,
    summary,
)
from smsl_studio.host.local import LocalHost
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.nodes import NodeState
from smsl_studio.monitor.reception import Received, RefusedMessages, RemoteView
from smsl_studio.monitor.sample import Sample
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.monitor.checks import Checks
from smsl_studio.studio.features.monitor.network import network_rows
from smsl_studio.studio.features.monitor.table import MonitorModel
from tests.dispatch.runs import sample


@dataclass(frozen=True)
class Sensor:
    name: str
    digit: int
    branch: str = "SB1"
    max_age: float = 0.3
    aggregation: str = "single"


SENSORS = [Sensor("eye", 0), Sensor("ear", 0), Sensor("scale", 1)]


@pytest.fixture(scope="module")
def hanoi() -> Blueprint:
    return sample("hanoi-2")


def _status(hanoi: Blueprint, **said: str | None) -> DispatchStatus:
    """How a run stands 0.2 s after its sensors said this; who says nothing did so a second ago."""
    dispatcher = Dispatcher(hanoi, LocalHost(hanoi, "table"), RunTerms(automatic=False))
    dispatcher.open()
    status = dispatcher.status
    dispatcher.close()
    monitor = FactMonitor(SENSORS, {("SB1", 0): FactRule("k_of_n", 2, critical=True)})
    for sensor in SENSORS:
        value = said.get(sensor.name, "a")
        when = 9.0 if sensor.name not in said else 9.8
        monitor.accept([Sample("SB1", sensor.digit, sensor.name, value, when, 1)], when)
    return replace(status, time=10.0, scene=monitor.scene(10.0), sources=monitor.sources(10.0))


def _rows(hanoi: Blueprint, status: DispatchStatus) -> dict[tuple[str, ...], MonitorRow]:
    rows = monitor_rows(hanoi, status, Estimates().of(hanoi, status), {"scale": "noise"})
    return {row.key: row for row in rows}


def test_a_conflict_shows_both_values_and_who_says_them(hanoi: Blueprint) -> None:
    rows = _rows(hanoi, _status(hanoi, eye="a", ear="b", scale="a"))
    fact = rows["SB1", "0"]
    assert (fact.cells[:4], fact.standing) == (
        ("Fact 1", "2 sources, single", "?", "conflict: eye says a, ear says b"), "conflict",
    )  # fmt: skip
    assert [rows["SB1", "0", name].cells[2] for name in ("eye", "ear")] == ["a", "b"]
    assert fact.sensor == "SB1/0"
    assert rows["SB1", "0", "eye"].sensor == "eye"
    assert summary(tuple(rows.values())) == "2 facts: 1 known, 1 in conflict"


def test_two_speakers_are_a_conflict_with_both_names(hanoi: Blueprint) -> None:
    monitor = FactMonitor(SENSORS)
    for node in ("bench", "intruder"):
        monitor.accept([Sample("SB1", 1, "scale", "a", 0.0, 1, received=9.8, node=node)], 0.0)
    scene, sources = monitor.scene(10.0, 10.0), monitor.sources(10.0, 10.0)
    status = replace(_status(hanoi), time=10.0, scene=scene, sources=sources)
    rows = _rows(hanoi, status)
    scale = rows["SB1", "1"]
    assert scale.cells[2:4] == ("?", "two speakers for scale: bench, intruder")
    assert scale.standing == "conflict"
    assert summary(tuple(rows.values())) == "2 facts: 1 unknown, 1 in conflict"


def test_a_stale_reading_is_no_value(hanoi: Blueprint) -> None:
    rows = _rows(hanoi, _status(hanoi, eye="a", ear="a"))
    scale = rows["SB1", "1"]
    assert scale.cells[1:5] == ("scale", "?", "no reading for 1.0 s, last a", "1.0 s")
    assert (scale.standing, scale.cells[-1]) == ("unknown", "noise")
    assert rows["SB1",].cells[3].startswith("by its sensors: unknown, could be State_aa")
    assert "Value ?" in scale.spoken
    assert "Quality no reading for 1.0 s, last a" in scale.spoken


def test_what_fits_no_state_is_off_the_map(hanoi: Blueprint) -> None:
    rows = _rows(hanoi, _status(hanoi, eye="z", ear="z", scale="a"))
    assert rows["SB1",].cells[3] == "by its sensors: off the map, no state fits"
    assert rows["SB1",].standing == "conflict"


def test_what_an_operation_moves_stands_in_no_state_and_that_is_not_wrong(hanoi: Blueprint) -> None:
    status = _status(hanoi, eye="z", ear="z", scale="a")
    rows = _rows(hanoi, replace(status, running=hanoi.resolve("SB1/State_aa/Op_1b")))
    assert rows["SB1",].cells[3] == "by its sensors: between states, an operation moves it"
    assert rows["SB1",].standing == "unknown"


@pytest.mark.parametrize("moved", [False, True])
def test_the_card_of_a_check_and_the_row_of_its_sb_say_the_same(
    qtbot: QtBot, hanoi: Blueprint, moved: bool
) -> None:
    status = _status(hanoi, eye="z", ear="z", scale="a")
    if moved:
        status = replace(status, running=hanoi.resolve("SB1/State_aa/Op_1b"))
    checks = Checks(LIGHT)
    qtbot.addWidget(checks)
    checks.show_checks(hanoi, status, Estimates().of(hanoi, status))
    card = checks.cards["SB1"].estimate.text()
    assert card.lower() == _rows(hanoi, status)["SB1",].cells[3]
    assert ("off the map" in card) is not moved


def test_of_a_world_that_is_gone_nothing_is_known(hanoi: Blueprint) -> None:
    rows = _rows(hanoi, of_lost(_status(hanoi, eye="a", ear="a", scale="a")))
    facts = [row for row in rows.values() if row.kind == "fact"]
    assert [(row.cells[2], row.standing) for row in facts] == [("?", "unknown")] * 2
    assert all(GONE in row.cells[3] for row in facts)


def test_what_nobody_senses_is_believed(hanoi: Blueprint) -> None:
    status = replace(_status(hanoi, eye="a"), scene=Scene(), sources=())
    rows = _rows(hanoi, status)
    assert rows["SB1", "0"].cells[:4] == ("Fact 1", "", "a", "believed, nobody senses it")
    assert rows["SB1", "0"].sensor == ""


def test_a_sub_sb_is_followed() -> None:
    hfsm = sample("hfsm")
    dispatcher = Dispatcher(hfsm, LocalHost(hfsm, "table"), RunTerms(automatic=False))
    dispatcher.open()
    rows = _rows(hfsm, dispatcher.status)
    assert rows["SB1", "1"].cells[3] == "follows the state check of SB2"
    dispatcher.close()


def test_only_cells_that_changed_are_told(hanoi: Blueprint, qtbot: QtBot) -> None:
    model = MonitorModel()
    status = _status(hanoi, eye="a", ear="a", scale="a")
    assert model.show(tuple(_rows(hanoi, status).values()))
    resets: list[bool] = []
    told: list[tuple[int, int]] = []
    model.modelReset.connect(lambda: resets.append(True))
    model.dataChanged.connect(lambda a, _: told.append((a.row(), a.column())))
    assert not model.show(tuple(_rows(hanoi, status).values()))
    assert told == []
    older = tuple(
        replace(source, said=replace(source.said, age=source.said.age + 0.033))
        if source.said.source == "scale" else source
        for source in status.sources
    )  # fmt: skip
    assert not model.show(tuple(_rows(hanoi, replace(status, sources=older)).values()))
    assert told == [(4, 4)]
    assert resets == []


def test_nodes_and_what_counted_for_nothing() -> None:
    nodes = (
        NodeState("bench", "alive", 1, 1, 0.0, 3.0, ("SB1/0 eye",)),
        NodeState("wrist", "frozen", 1, 2, 4.3, 4.0),
        NodeState("table", "gone", 1, 1, 9.0, 8.6),
        NodeState("new", "expected", 1, 1, None, 0.1),
    )
    refusals = (RefusedMessages("retained fact", 3, "SB1/0 eye"),)
    view = RemoteView("b:1", "lab", "main", 2.2, 1, nodes, Received(9, 6, 0, refusals))
    rows = {row.text: row for row in network_rows("hanoi", True, (), view)}
    assert [(rows[n].right, rows[n].severity) for n in ("bench", "wrist", "table", "new")] == [
        ("alive", ""), ("frozen for 4 s, boot 2", "W"), ("gone for 9 s", "W"),
        ("no sample yet", "I"),
    ]  # fmt: skip
    assert "SB1/0 eye" in rows["bench"].tip
    assert (rows["b:1"].right, rows["b:1"].severity) == ("lost for 2 s", "W")
    assert (rows["retained fact"].right, rows["retained fact"].beside) == ("3", "SB1/0 eye")
    ended = {row.text: row for row in network_rows("hanoi", False, (), view)}
    assert (ended["b:1"].right, ended["b:1"].severity) == ("left with the end of the run", "")
    assert [row.text for row in network_rows("", False, (), None)] == [
        "Nodes",
        "Starts with the run",
    ]


def test_long_names_lose_their_middle() -> None:
    assert short("State_aaa") == "State_aaa"
    assert short("State_" + "0" * 60) == "State_000000000000…00000000000000000"
    assert len(short("x" * 500)) == 36
