"""All commands in all run states, as in the table of docs/supervision.md."""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature
from pathlib import Path
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.supervision.row import CommandRow
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.phase import RUN_STATES
from tests.dispatch.arguments import drawn_arguments, needed
from tests.dispatch.runs import Story, blueprint, branch
from tests.dispatch.supervision.runs import (
    between,
    facts_of,
    fault_hold,
    hanoi,
    middle,
    no_route,
    paused,
    ready,
    said,
    stopped,
    taken_over,
)

COLUMNS = (
    "ready", "running", "middle", "paused", "waiting", "no_route", "taken_over", "fault_hold",
    "stopped",
)  # fmt: skip
PAGE = Path(__file__).parents[3] / "docs" / "supervision.md"


def waiting() -> Story:
    """A person is asked whether the first operation may begin."""
    note = {"Op_1c": {"confirm": ["surgeon"]}}
    values = {"SB1": branch({"0": "Op_1c>1", "1": "Op_2b>0"}, operations=note)}
    story = hanoi(blueprint=blueprint(values), goals=["SB1/State1"]).tick()
    assert story.phase == "waiting"
    return story


STATES: dict[str, Callable[[], Story]] = {
    "ready": ready,
    "running": between,
    "middle": middle,
    "paused": paused,
    "waiting": waiting,
    "no_route": no_route,
    "taken_over": taken_over,
    "fault_hold": fault_hold,
    "stopped": stopped,
}


def written_table() -> dict[tuple[str, str], bool]:
    """(command, run state) -> whether it is taken there, as the page says."""
    lines = iter(PAGE.read_text("utf-8").splitlines())
    head = next(line for line in lines if line.startswith("| command | with it |"))
    states = [cell.strip() for cell in head.strip("|").split("|")][2:]
    assert states == list(STATES)
    next(lines)
    found: dict[tuple[str, str], bool] = {}
    for line in lines:
        if not line.startswith("|"):
            break
        word, _, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        assert set(cells) <= {"yes", "no"}
        found |= {(word, state): cell == "yes" for state, cell in zip(states, cells, strict=True)}
    return found


TABLE = written_table()


def test_the_page_has_every_command_and_every_run_state() -> None:
    assert {word for word, _ in TABLE} == set(COMMANDS)
    page = PAGE.read_text("utf-8")
    assert [state for state in RUN_STATES if f"| `{state}` |" not in page] == []


def test_the_page_says_what_the_rows_say() -> None:
    """Where this fails, the page is written anew from the lines that are missing in it."""
    page = PAGE.read_text("utf-8").splitlines()
    assert [line for line in map(written, COMMANDS) if line not in page] == []


def written(word: str) -> str:
    """A row of the table as the page has it."""
    row = COMMANDS[word]
    taken = (row.takes(COLUMNS[1], True) if one == "middle" else row.takes(one) for one in COLUMNS)
    return f"| {word} | {said_with(row)} | {' | '.join('yes' if one else 'no' for one in taken)} |"


def said_with(row: CommandRow) -> str:
    """What a script says with a command; in parentheses what it may leave out."""
    if row.script_words is not None:
        return " or ".join(f"`{word}`" for word in row.script_words)
    said = {name: one for name, one in row.arguments.items() if one.scripted}
    words = [f"`{name}`" if one.needed else f"(`{name}`)" for name, one in said.items()]
    return ", ".join([*words, "its parameters"] if row.free else words)


def test_what_is_said_with_a_command_is_what_its_effect_takes() -> None:
    """An answer names a task, which a script finds by its kind and address."""
    beside = {"ask": {"every_time"}, "answer": {"task", "kind", "address"}}
    for word, row in COMMANDS.items():
        driver, *taken = (
            one.name for one in signature(row.effect).parameters.values()
            if one.kind is not one.VAR_KEYWORD
        )  # fmt: skip
        assert {driver, "by"} <= {"driver", *taken}
        assert {*row.arguments} ^ {*taken} - {"by"} == beside.get(word, set()), word
        assert row.sentence or row.sentences, word


def parameters(word: str, story: Story) -> dict[str, Any]:
    """What makes sense to say with a command in this very state."""
    given: dict[str, dict[str, Any]] = {
        "inject": {"fault": "slip"},
        "answer": {"task": "task-1", "option": "confirm", "role": "surgeon"},
    }
    more = drawn_arguments(needed(COMMANDS[word].arguments), Random(0), [here(story)], ["SB1/0"])
    return given.get(word, more)


def here(story: Story) -> Address:
    """An edge out of the active state that is not being carried out."""
    carried = story.dispatcher.status.carrying
    edges = (edge.address for edge in story.blueprint["SB1"].edges())
    return next(
        edge for edge in edges if edge.state == story.configuration["SB1"] and edge != carried
    )


def prepare(word: str, state: str, story: Story) -> None:
    """Whatever would refuse the command besides the run state is put right."""
    if word == "restore":
        said(story, "prune", here(story), "for this test")
    elif (word, state) == ("accept", "taken_over"):
        said(story, "give_back")
    elif (word, state) == ("ask", "no_route"):
        said(story, "restore", here(story))
    elif (word, state) == ("ask", "fault_hold"):
        facts_of(story)["SB1", 0] = "a"


@pytest.mark.parametrize(("word", "state"), TABLE)
def test_a_command_in_a_run_state(word: str, state: str) -> None:
    story = STATES[state]()
    prepare(word, state, story)
    refused = said(story, word, **parameters(word, story), by="Brandt").refused
    assert (refused == "") is TABLE[word, state], refused


def test_before_the_world_stands_commands_wait() -> None:
    story = hanoi()
    story.dispatcher.pause()
    assert [one.command for one in story.of("commanded")] == []
    assert [one.command for one in story.tick().of("commanded")] == ["pause"]


def test_a_finished_run_takes_no_command_and_its_record_is_closed() -> None:
    story = hanoi().run()
    assert (story.phase, story.end.event) == ("done", "run_finished")
    story.dispatcher.pause()
    assert story.dispatcher.tick() == ()


def test_what_waits_when_the_world_dies_is_answered() -> None:
    story = hanoi(host={"broken_at": 3})
    story.tick(3)
    for word in ("pause", "stop"):
        getattr(story.dispatcher, word)()
    story.tick(2)
    answers = {one.command: one.refused for one in story.of("commanded")}
    assert set(answers) == {"pause", "stop"}
    assert story.end.reason == "failed"
