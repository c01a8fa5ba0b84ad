"""Automatic supervisors by name: those of the program and of plugins, and what they may not do."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.dispatch.drive.supervisor import ASK
from smsl_studio.errors import UsageError
from smsl_studio.front.agents.agent_child import answer_of
from smsl_studio.front.agents.agent_process import AgentProcess
from smsl_studio.front.agents.asked_agent import asked_agent
from smsl_studio.front.inputs import read_bytes
from smsl_studio.front.runs import Run
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.supervisor_view import SupervisorView
from smsl_studio.runlog.events import (
    Commanded,
    Committed,
    OperationStarted,
    RiskEstimated,
    TakenOver,
)
from smsl_studio.stop import Stopped, heeding

WAYS = (
    b'{"SB": {"_operations": {"Near": {"risk": "high"}, "Far": {"risk": "low", "cost": 5},'
    b' "On": {"risk": "low"}}, "State_a": {"Near": "State_c", "Far": "State_b"},'
    b' "State_b": {"On": "State_c"}, "State_c": {}}}'
)
"""Two ways from a to c: a short one of high risk, and a long one of low risk."""
PLUGIN = """
import os, time

def register(library):
    @library.supervisor("chosen", limit=0.3)
    def chosen(view, answer: str = "approve", spare: int = 0):
        return answer, f"as told at {view.operation}"

    @library.supervisor("hangs", limit=0.3)
    def hangs(view):
        time.sleep(60)

    @library.supervisor("dies")
    def dies(view):
        os._exit(3)

    @library.supervisor("lies")
    def lies(view):
        return "go"
"""


@pytest.fixture
def paths(tmp_path: Path) -> tuple[Path, ...]:
    folder = tmp_path / "odd"
    folder.mkdir()
    (folder / "plugin.toml").write_text('name = "odd"\n', "utf-8")
    (folder / "plugin.py").write_text(PLUGIN, "utf-8")
    return (folder,)


def run(*names: str, paths: tuple[Path, ...] = ()) -> Run:
    return front.run(read_bytes(WAYS, "ways.json"), supervisor=names, plugin_paths=paths)


def committed(done: Run) -> list[str]:
    return [name for e in done.events if isinstance(e, Committed) for name in e.operations]


def view() -> SupervisorView:
    edge = "SB/State_a/Near"
    return SupervisorView(0.0, {"SB": "State_a"}, edge, (edge,), "State_c", 1.0, "")


def test_the_limit_of_risk_sends_the_run_the_longer_way() -> None:
    assert committed(run("limit:risk=0.9")) == ["SB/State_a/Near"]
    done = run("limit:risk=0.5")
    assert committed(done) == ["SB/State_a/Far", "SB/State_b/On"]
    said = [event for event in done.events if isinstance(event, Commanded)]
    assert [(one.command, one.by, one.address) for one in said] == [
        ("veto", "limit:risk=0.5", "SB/State_a/Near")
    ]
    assert said[0].reason == "a risk of 80% is above 50%: its risk is high"


def test_the_risk_is_told_before_each_decision() -> None:
    told = [e for e in run("limit:risk=0.5").events if isinstance(e, RiskEstimated)]
    assert [(one.address, one.risk) for one in told] == [
        ("SB/State_a/Near", 0.8), ("SB/State_a/Far", 0.1), ("SB/State_b/On", 0.1),
    ]  # fmt: skip
    without = front.run(read_bytes(WAYS, "ways.json"))
    assert not any(isinstance(event, RiskEstimated) for event in without.events)


def test_the_weights_of_the_file_make_the_risk() -> None:
    drawn = read_bytes(b'{"_risk": {"declared": 0.5}, ' + WAYS[1:], "ways.json")
    told = [e for e in front.run(drawn, supervisor="limit:risk=0.9").events
            if isinstance(e, RiskEstimated)]  # fmt: skip
    assert told[0].risk == 0.4


def test_rules_decide_by_the_first_that_fits(tmp_path: Path) -> None:
    file = tmp_path / "rules.toml"
    file.write_text(
        '[[rule]]\noperation = "SB/*/Near"\nanswer = "veto"\nreason = "not this way"\n', "utf-8"
    )
    done = run(f"rules:file={file}")
    assert committed(done) == ["SB/State_a/Far", "SB/State_b/On"]
    assert [e.reason for e in done.events if isinstance(e, Commanded)] == ["not this way"]


def test_a_rule_that_is_wrong_is_told_with_its_line_before_the_run(tmp_path: Path) -> None:
    file = tmp_path / "rules.toml"
    file.write_text('[[rule]]\nrisk_above = 2\nanswer = "veto"\n', "utf-8")
    with pytest.raises(UsageError, match=r"rules\.toml:2:1: rule\.0\.risk_above"):
        run(f"rules:file={file}")


def test_what_no_recording_has_is_asked_about(tmp_path: Path) -> None:
    drawn = read_bytes(WAYS, "ways.json")
    front.run(drawn, avoid=["SB/State_a/Near"], log=tmp_path / "long.jsonl")
    done = front.run(drawn, supervisor=f"familiar:folder={tmp_path}")
    assert done.reason == "held"
    assert "SB/State_a/Near stands in none of 1 recorded runs" in done.sentence
    again = front.run(drawn, avoid=["SB/State_a/Near"], supervisor=f"familiar:folder={tmp_path}")
    assert again.reason == "goal_reached"


def test_the_most_careful_answer_counts(paths: tuple[Path, ...]) -> None:
    done = run("chosen:answer=approve", "chosen:answer=ask", paths=paths)
    assert done.reason == "held"
    assert "chosen: as told at SB/State_a/Near" in done.sentence
    took = run("chosen:answer=take_over", "chosen:answer=veto", paths=paths)
    assert took.reason == "held"
    assert "takes over before SB/State_a/Near" in took.sentence


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("hangs", "it gave no answer in 0.3 s"),
        ("dies", "it ended by itself with exit status 3"),
        ("lies", "'go' is no answer"),
    ],
)
def test_without_an_answer_that_counts_nothing_begins(
    name: str, words: str, paths: tuple[Path, ...]
) -> None:
    done = run(name, paths=paths)
    assert done.reason == "held"
    assert words in done.sentence
    assert not any(isinstance(event, OperationStarted) for event in done.events)


def test_a_lost_process_is_started_again_a_few_times(paths: tuple[Path, ...]) -> None:
    agents = AgentProcess([asked_agent("chosen"), asked_agent("dies")], paths)
    try:
        for _ in range(4):
            assert agents.ask(0, view())[0] == "approve"
            assert agents.ask(1, view())[0] == "ask"
        assert "not asked any more" in agents.ask(0, view())[1]
    finally:
        agents.close()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("lmiit", "there is no supervisor 'lmiit'"),
        ("limit:risk=much", "risk is 'much', not a number"),
        ("limit:rsk=1", "there is no parameter 'rsk'"),
        ("limit:risk=7", "a risk of 7 is not from 0 to 1"),
        ("limit:above=go", "there is no answer 'go'"),
        ("limit:risk", "the option 'risk' of limit has no name and value"),
        ("limit:risk=1,risk=0", "the option 'risk' of limit stands twice"),
        ("a b", "the supervisor 'a b' is no name"),
        ("familiar:folder=/nowhere", "/nowhere is no folder"),
        ("rules", "the argument 'file' is missing"),
    ],
)
def test_what_is_asked_for_wrongly_is_told_before_the_run(text: str, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        run(text)


HOSTILE = (
    None, True, 7, "", "approve ", "APPROVE", b"approve", ("approve",), ("veto", 3), ["veto", ""],
    ("approve", "", ""), {"approve": 1}, "x" * 10_000_000, ("go", "approve"), (None, "approve"),
)  # fmt: skip


@pytest.mark.parametrize("said", HOSTILE, ids=range(len(HOSTILE)))
def test_what_is_no_answer_means_that_a_person_is_asked(said: object) -> None:
    answer, reason = answer_of(lambda _: said, view())
    assert answer == ASK
    assert 0 < len(reason) < 500


def test_a_reason_is_one_short_line() -> None:
    said = answer_of(lambda _: ("approve", "a\nb\x1b[31m" + "c" * 10_000), view())
    assert said[0] == "approve"
    assert said[1].isprintable()
    assert len(said[1]) <= 500


def test_an_agent_takes_over_until_a_person_gives_back(
    paths: tuple[Path, ...], tmp_path: Path
) -> None:
    dispatcher = front.open_run(
        read_bytes(WAYS, "ways.json"),
        host="local",
        attended=True,
        supervisor="chosen:answer=take_over",
        plugin_paths=paths,
    )
    try:
        events = list(dispatcher.open())
        while dispatcher.phase != "taken_over":
            events += dispatcher.tick()
        assert [e.by for e in events if isinstance(e, TakenOver)] == ["chosen:answer=take_over"]
        assert not any(isinstance(event, OperationStarted) for event in events)
        dispatcher.give_back()
        dispatcher.tick()
        dispatcher.accept()
        dispatcher.tick()
        assert dispatcher.phase == "paused"
    finally:
        dispatcher.close()


def test_the_log_of_such_a_run_is_believed(tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    drawn = read_bytes(WAYS, "ways.json")
    front.run(drawn, supervisor="limit:risk=0.5", log=log)
    assert front.verify(log).doubt is None
    assert front.verify(log, drawn).doubt is None


def test_a_weight_that_does_not_count_is_a_finding() -> None:
    drawn = read_bytes(b'{"_risk": {"declared": 2, "luck": 1}, ' + WAYS[1:], "ways.json")
    found = [one.message for one in front.inspect(drawn) if one.rule == "R29"]
    assert found == [
        "declared is not understood: a weight is a number from 0 to 1",
        "luck is not understood: there is no such part of a risk. "
        "There are declared, failures, forecast, hazard, age",
    ]


def test_a_plugin_may_not_register_a_supervisor_that_its_manifest_leaves_out(
    paths: tuple[Path, ...],
) -> None:
    manifest = paths[0] / "plugin.toml"
    manifest.write_text('name = "odd"\nsupervisors = ["chosen", "hangs", "dies"]\n', "utf-8")
    with pytest.raises(UsageError, match="it registers 'lies', which is not among the supervisors"):
        run("chosen", paths=paths)


def test_plugins_are_listed_with_their_supervisors(paths: tuple[Path, ...]) -> None:
    (plugin,) = (one for one in describe(paths).plugins if one.name == "odd")
    told = {one.name: list(one.signature.types) for one in plugin.library.supervisors.values()}
    assert told == {"chosen": ["answer", "spare"], "hangs": [], "dies": [], "lies": []}


def test_a_question_that_was_broken_off_does_not_answer_the_next_one(
    paths: tuple[Path, ...],
) -> None:
    process = AgentProcess([asked_agent("chosen:answer=veto"), asked_agent("chosen")], paths)
    process.open()
    try:
        with pytest.raises(Stopped), heeding(_stop):
            process.ask(0, view())
        assert process.ask(1, view()) == ("approve", "as told at SB/State_a/Near")
        assert process.ask(0, view())[0] == "veto"
    finally:
        process.close()


def _stop() -> None:
    raise Stopped
