"""A blueprint that is too large to run is refused before the run, with the SB that is too large."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.cli import main
from smsl_studio.errors import RunRefused
from smsl_studio.runlog.events import EdgeSwept, RunFinished, SweepFinished
from smsl_studio.smsl.files import parse_bytes
from tests.bombs.table import BY_NAME

COMMANDS = [
    "check FILE",
    "check --format json FILE",
    "digest FILE",
    "fmt --check FILE",
    "convert FILE -o OUT.json",
    "convert FILE -o OUT.smsl",
    "convert FILE -o OUT.yaml",
    "diff FILE OTHER",
    "render FILE -o OUT.svg",
    "route FILE --sb B0 --from State0 --to State1",
    "run FILE --world table --goal B0/State1 --log OUT.jsonl",
    "run FILE --world table",
    "sweep FILE --world table",
]


def made(name: str, count: int) -> Blueprint:
    text = BY_NAME[name].make("json", count)
    return read_blueprint(parse_bytes(text.encode(), "large.json"))


def refusal_of_run(blueprint: Blueprint) -> str:
    """The sentence with which a run was refused."""
    events = front.run(blueprint, "table").events
    assert [type(event) for event in events] == [RunFinished]
    assert isinstance(events[0], RunFinished)
    assert events[0].reason == "refused"
    return events[0].sentence


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_every_command_gets_through_a_chain_of_300_levels(
    form: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    bomb = BY_NAME["sub_chain"]
    (tmp_path / f"chain.{form}").write_text(bomb.make(form, 300))
    (tmp_path / f"other.{form}").write_text(bomb.make(form, 290))
    places = {"FILE": f"chain.{form}", "OTHER": f"other.{form}", "OUT": f"out{form}"}
    for command in COMMANDS:
        words = command
        for word, name in places.items():
            words = words.replace(word, str(tmp_path / name))
        assert main(words.split()) in (0, 1), command
    capfd.readouterr()
    log = tmp_path / f"out{form}.jsonl"
    assert main(["replay", "--verify", str(log)]) == 0
    assert main(["replay", str(log)]) == 0
    assert "too many ways lead down from B0" in capfd.readouterr().out


def test_a_chain_is_refused_where_it_begins() -> None:
    blueprint = made("sub_chain", 300)
    asked: list[Callable[[], object]] = [
        lambda: list(front.sweep(blueprint)),
        lambda: front.plan_route(blueprint, "State0", "State1", branch="B0"),
        lambda: front.try_edge(blueprint, Address("B7", "State0", "on"), "table", host="local"),
    ]
    for what in asked:
        with pytest.raises(RunRefused, match="too many ways lead down from B0 ") as refused:
            what()
        assert refused.value.place == blueprint.place(Address("B0"))
    assert "too many ways lead down from B0 " in refusal_of_run(blueprint)


def test_a_chain_that_is_not_refused_is_run_to_its_goal() -> None:
    assert front.run(made("sub_chain", 87), "table", "B0/State1").reason == "goal_reached"
    assert "too many ways" in refusal_of_run(made("sub_chain", 88))


def test_sub_sbs_that_are_shared_again_and_again_are_refused() -> None:
    """Each layer doubles the ways down; with ten layers planning took seconds, with 16 minutes."""
    blueprint = made("sub_diamonds", 24)
    assert "too many ways lead down from l0 " in refusal_of_run(blueprint)
    with pytest.raises(RunRefused, match="too many ways"):
        front.plan_route(blueprint, "State00", "State11", branch="l0")
    with pytest.raises(RunRefused, match="too many ways"):
        list(front.sweep(blueprint))


def test_too_many_facts_are_refused_at_the_sb_with_the_most() -> None:
    words = "there are 1,001 facts, 1 of them in B0, and a run senses 1,000 at most"
    assert words in refusal_of_run(made("paired_sbs", 1_001))


def test_a_sweep_that_nobody_would_wait_for_is_refused_at_the_sb_where_it_is_too_long() -> None:
    blueprint = made("paired_sbs", 250)
    with pytest.raises(RunRefused, match="more than 160 operations would be swept") as refused:
        list(front.sweep(blueprint))
    assert refused.value.place == blueprint.place(Address("B80"))
    named = list(front.sweep(blueprint, branches=["B3", "B200"]))
    assert isinstance(named[-1], SweepFinished)
    assert named[-1].passed == named[-1].edges == 4
    with pytest.raises(RunRefused, match="more than 3 operations"):
        list(front.sweep(blueprint, branches=["B3", "B200"], most=3))
    first = next(iter(front.sweep(blueprint, most=500)))
    assert isinstance(first, EdgeSwept)
    assert first.passed


def test_a_sweep_that_was_waited_for_is_named_on_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "large.json"
    file.write_text(BY_NAME["paired_sbs"].make("json", 250))
    assert main(["sweep", str(file), "--world", "table"]) == 1
    assert "Name some of the State Branches" in capsys.readouterr().err
    assert main(["sweep", str(file), "--world", "table", "--sb", "B7", "--most", "2"]) == 0
    assert "2 of 2" in capsys.readouterr().out
