"""Who decided what in a run, after how long, and against whom."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio import front
from smsl_studio.front.inputs import read
from smsl_studio.front.script.lines import read_script
from smsl_studio.runlog.decisions import DecidedBy, deciders, told_by
from smsl_studio.runlog.events import (
    Commanded,
    Event,
    Held,
    OperationRefused,
    OperationStarted,
    RiskEstimated,
    TaskAnswered,
    TaskClosed,
    TaskOpened,
)
from smsl_studio.shipped import samples_dir

A, B = "SB1/State_aa/Op_1b", "SB1/State_ba/Op_2c"
NAME = "limit:risk=0.2"


def estimated(address: str, t: float = 0.0) -> RiskEstimated:
    return RiskEstimated(t=t, address=address, risk=0.4, reasons=())


def opened(task: str, address: str, t: float) -> TaskOpened:
    return TaskOpened(
        t=t,
        task=task,
        kind="supervise",
        address=address,
        question="May it begin?",
        options=("go_on", "veto"),
        role="",
        persons=1,
        deadline=t + 120,
    )


def answered(task: str, by: str, answer: str, t: float) -> list[Event]:
    return [
        TaskAnswered(t=t, task=task, by=by, role=""),
        TaskClosed(t=t, task=task, outcome="answered", answer=answer, answers={by: answer}),
    ]


def said(found: tuple[DecidedBy, ...]) -> dict[str, str]:
    return {one.name: one.decided for one in found}


def test_an_agent_approves_asks_and_a_person_answers_against_it() -> None:
    events: list[Event] = [
        estimated(A),
        OperationStarted(t=0.0, address=A, target="S", function="f"),
        estimated(B, 1.0),
        Commanded(t=1.0, command="ask", by=NAME, address=B, reason="a risk of 40%"),
        opened("T1", B, 1.0),
        *answered("T1", "Ada", "go_on", 3.5),
        OperationStarted(t=3.5, address=B, target="S", function="f"),
    ]
    agent, person = deciders(events, NAME)
    assert (agent.name, agent.automatic, agent.decided) == (NAME, True, "1 approve, 1 ask")
    assert (person.name, person.automatic, person.decided) == ("Ada", False, "1 go on")
    assert (person.waits, person.waited, person.against) == ((2.5,), "2.5 s", 1)
    assert deciders([*told_by(events)], NAME) == (agent, person)


def test_who_agrees_with_the_agent_is_not_against_it() -> None:
    doubt = Commanded(t=0.0, command="ask", by=NAME, address=A, reason="a risk")
    veto = Commanded(t=2.0, command="veto", by="Ada", address=A)
    events: list[Event] = [
        estimated(A), doubt, opened("T1", A, 0.0), *answered("T1", "Ada", "veto", 2.0), veto,
    ]  # fmt: skip
    found = {one.name: one for one in deciders(events, NAME)}
    assert found["Ada"].against == 0
    assert found["Ada"].decided == "1 veto", "what follows from an answer is not counted again"


def test_a_veto_of_an_agent_that_a_person_asks_for_all_the_same() -> None:
    events: list[Event] = [
        Commanded(t=0.0, command="veto", by="rules", address=A),
        OperationRefused(t=0.0, address=A, reasons=("rules says no: it strays",)),
        Held(t=1.0, reason="no way"),
        Commanded(t=4.0, command="ask", by="Ada", address=A),
        Commanded(t=9.0, command="pause", by="Ada"),
        Commanded(t=9.0, command="inject", by="Ada"),
        Commanded(t=9.0, command="veto", by="Ben", address=B, refused="too late"),
    ]
    rules, ada = deciders(events)
    assert (rules.automatic, ada.automatic) == (True, False)
    assert (ada.decided, ada.waits, ada.against) == ("1 ask, 1 pause", (3.0,), 1)


def test_nobody_decides_in_a_run_without_people() -> None:
    done = front.run(read(samples_dir() / "hanoi-2.json"))
    assert deciders(done.events) == ()


@pytest.mark.parametrize(
    ("supervisor", "decided"), [("limit:risk=0.9", "3 approve"), ("limit:risk=0.1", "veto")]
)
def test_the_decisions_of_a_shipped_agent(supervisor: str, decided: str) -> None:
    done = front.run(read(samples_dir() / "hanoi-2.json"), supervisor=supervisor)
    (one,) = deciders(done.events, supervisor)
    assert one.automatic
    assert decided in one.decided


def test_a_person_of_a_script_who_answers_an_agent(tmp_path: Path) -> None:
    file = tmp_path / "script.jsonl"
    act: dict[str, Any] = {
        "do": "answer", "kind": "supervise", "option": "go_on", "by": "Ada",
    }  # fmt: skip
    file.write_text(json.dumps(act))
    blueprint = read(samples_dir() / "hanoi-2.json")
    asks = "limit:risk=0.1,above=ask"
    done = front.run(blueprint, supervisor=asks, script=read_script(file, blueprint))
    found = said(deciders(done.events, asks))
    assert found[asks].endswith("ask")


def test_several_decisions_of_a_kind_are_in_the_plural() -> None:
    assert DecidedBy("Ada", False, {"fact told": 1, "go_on": 2}).decided == "1 fact told, 2 go on"
    assert DecidedBy("Ada", False, {"fact told": 2}).decided == "2 facts told"
