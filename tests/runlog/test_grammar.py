"""Logs with impossible stories are not verified, even with a valid chain; every true log is."""

from __future__ import annotations

import io
import itertools
import json
from collections import Counter
from copy import deepcopy
from pathlib import Path
from random import Random
from typing import NoReturn

import pytest

import smsl_studio as smsl
from smsl_studio.dispatch.route import planner
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import ReadError
from smsl_studio.front.script.lines import script_of
from smsl_studio.runlog.decoder import EVENTS as KNOWN
from smsl_studio.runlog.events import (
    Committed,
    EdgeSwept,
    Event,
    GoalReached,
    OperationStarted,
    RoutePlanned,
    RunStarted,
    StateChecked,
    SweepFinished,
)
from smsl_studio.runlog.grammar.automaton import TABLE, Grammar
from smsl_studio.runlog.grammar.log_reader import LogVerdict, read_log, verify
from smsl_studio.runlog.grammar.memory import Begun
from smsl_studio.runlog.grammar.operations import WITHOUT_FAILURE
from tests.dispatch.generated import blueprint_values
from tests.plugin_folder import blueprint_of
from tests.runlog.impossible import OPERATORS, Operator, Story, impossible
from tests.runlog.logs import EVENTS, OTHER, chained
from tests.runlog.true_stories import log_of_a_dying_world, true_log

TRUE = 48
"""Of 500, which ``benches/stories.py`` has."""
ENDS = {"goal_reached", "no_route", "held", "refused", "stopped", "failed"}


@pytest.fixture(scope="module")
def true_logs(tmp_path_factory: pytest.TempPathFactory) -> list[bytes]:
    folder = tmp_path_factory.mktemp("true")
    paths = [true_log(number, folder) for number in range(TRUE)]
    return [path.read_bytes() for path in (*paths, log_of_a_dying_world(folder))]


def judged(raw: bytes) -> LogVerdict:
    return verify(io.BytesIO(raw), "log", COMMANDS)


def test_true_stories_of_every_end_verify(true_logs: list[bytes]) -> None:
    doubts = [(n, str(judged(raw).doubt)) for n, raw in enumerate(true_logs) if judged(raw).doubt]
    assert doubts == []
    assert {Story.of(raw).end["reason"] for raw in true_logs} == ENDS
    told = Counter(one["event"] for raw in true_logs for one in Story.of(raw).events)
    rare = {"costs_changed", "task_escalated", "within", "measured", "risk_estimated",
            "forecast", "edge_generated"}  # fmt: skip
    """``within`` has its true stories in ``tests/front/test_procedures.py``, ``measured`` in
    ``tests/library/test_measures.py``, ``risk_estimated`` in ``tests/front/agents``, forecasts in
    ``tests/front/test_forecasts.py``, ``edge_generated`` in ``tests/front/test_online.py``."""
    assert {kind.event for kind in TABLE} - told.keys() <= rare


def test_a_story_made_anew_and_not_changed_verifies(true_logs: list[bytes]) -> None:
    """What refuses a changed one is its story, and not how its chain was made."""
    assert [Story.of(raw).raw() for raw in true_logs] == true_logs


@pytest.mark.parametrize("operator", OPERATORS, ids=lambda one: one.__name__)
def test_an_impossible_story_is_refused_and_its_line_named(
    operator: Operator, true_logs: list[bytes]
) -> None:
    refused = 0
    for number, raw in enumerate(true_logs):
        story = Story.of(raw)
        changed = impossible(story, operator, Random(f"{number} {operator.__name__}"))
        if changed is None or refused >= 5:
            continue
        doubt = judged(changed.raw()).doubt
        assert doubt is not None, (number, operator.__doc__)
        assert doubt.sentence.startswith("the story is impossible: ")
        assert doubt.place.line > _first_change(story, changed)
        refused += 1
    assert refused, "the operator has changed a story at least"


def _first_change(story: Story, changed: Story) -> int:
    """How many events are alike before the first that differs; none where the headers do."""
    if story.header != changed.header:
        return 0
    pairs = zip(story.events, changed.events, strict=False)
    alike = next((n for n, (one, two) in enumerate(pairs) if one != two), None)
    return min(len(story.events), len(changed.events)) if alike is None else alike


def test_every_kind_is_of_its_own() -> None:
    assert len(OPERATORS) > 75
    assert all(operator.__doc__ for operator in OPERATORS)


def test_every_event_of_a_run_has_a_row() -> None:
    assert {kind.event for kind in TABLE} == KNOWN.keys() - {EdgeSwept.event, SweepFinished.event}


def test_the_line_is_named_with_what_is_wrong() -> None:
    begins = next(n for n, one in enumerate(EVENTS) if one.event == "operation_started")
    events = [one for n, one in enumerate(EVENTS) if n != begins]
    raw = chained([b'{"log":"smsl-run","version":2}', *(one.line().encode() for one in events)])
    words = "time passes until 0.05 s, but nothing in the run takes time"
    assert str(judged(raw).doubt) == f"log:6:1: not verified: the story is impossible: {words}"


def test_a_log_that_was_cut_says_so_and_nothing_else(
    true_logs: list[bytes], tmp_path: Path
) -> None:
    """A killed writer leaves no head; what there is can be read."""
    for raw in true_logs[:20]:
        lines = raw.splitlines(keepends=True)
        for end in {2, len(lines) // 2, len(lines) - 1}:
            path = tmp_path / "cut"
            path.write_bytes(b"".join(lines[:end]))
            found = read_log(path, COMMANDS)
            assert len(found.records) == end - 1
            assert found.doubt is not None
            assert found.doubt.sentence.startswith("the log has no head: ")


def test_once_a_story_is_impossible_nothing_more_is_judged() -> None:
    grammar = Grammar({}, COMMANDS)
    assert grammar.follow(EVENTS[4]) == "operation started comes before the beginning of the run"
    assert [grammar.follow(one) for one in EVENTS] == [""] * len(EVENTS)
    assert grammar.end() == ""


def test_both_sample_stories_are_possible() -> None:
    for events in (EVENTS, OTHER):
        grammar = Grammar({}, COMMANDS)
        assert [grammar.follow(one) for one in events] == [""] * len(events)
        assert grammar.end() == ""


@pytest.mark.parametrize("header", [None, [], {}, "x", 3, 1.5, True, [[None]], ["a/b", 7, {}]])
def test_a_header_may_say_anything_of_what_was_asked(header: object) -> None:
    """It is a foreign file: a value of another type than a run writes is refused, and never by
    an exception."""
    keys = ("world", "start", "goals", "avoid", "digests", "by_hand")
    grammar = Grammar(
        {key: header for key in keys if not (key == "world" and header == "x")}, COMMANDS
    )
    said = grammar.follow(EVENTS[0])
    assert said.startswith("the header has a value of ")


@pytest.mark.parametrize(
    ("place", "wrong"),
    [
        (("world",), 7),
        (("seed",), "0"),
        (("seed",), True),
        (("by_hand",), 0),
        (("wall_time",), 7),
        (("node",), None),
        (("process",), "7"),
        (("host",), True),
        (("on_mismatch",), 1),
        (("attended",), "no"),
        (("levels",), []),
        (("levels",), {"supervision": 1}),
        (("script",), "s.jsonl"),
        (("script",), {"file": "s.jsonl"}),
        (("supervisor",), {}),
        (("policy",), 1),
        (("policy",), "approved"),
        (("policy",), {"verdict": "approved", "keys": "", "signers": [], "met": "all"}),
        (("policy",), {"verdict": "approved", "keys": "", "signers": [1], "met": []}),
        (("policy",), {"verdict": "approved", "keys": "", "signers": [], "met": [], "serial": "1"}),
        (("mqtt",), {"broker": "a", "site": "b", "run": "c", "facts": {"SB/0": "x"}}),
        (("file",), 1),
        (("versions",), {"python": 3}),
        (("names",), {"facts": {"SB/0": 1}}),
        (("digests", "file"), 7),
        (("digests", "closure"), None),
        (("grounds", "functions"), {"SB": ["f"]}),
        (("grounds", "costs"), {"SB": {"Op": "1"}}),
        (("grounds", "costs"), {"SB": {"Op": -1}}),
        (("grounds", "priced"), 0),
        (("avoid",), "SB"),
        (("digests",), []),
        (("digests", "behaviour"), ["a"]),
        (("grounds",), []),
        (("grounds", "states"), [[[]]]),
        (("grounds", "states"), {"SB": [["0"]]}),
        (("grounds", "states"), {"SB": {"State_0": "0"}}),
        (("grounds", "states"), {"SB": {"State_0": [0]}}),
        (("grounds", "sensed"), {"SB/0": 1}),
        (("grounds", "subs"), [[]]),
        (("grounds", "subs"), {"SB": ["SUB"]}),
        (("grounds", "subs"), {"SB": {"0": {"sub": "SUB"}}}),
        (("grounds", "subs"),
         {"SB": {"0": {"sub": "SUB", "activating": "A", "initial": "B", "on": "A"}}}),
    ],
)  # fmt: skip
def test_a_header_of_other_types_switches_nothing_off(
    place: tuple[str, ...], wrong: object, true_logs: list[bytes]
) -> None:
    story = deepcopy(Story.of(true_logs[0]))
    inside = story.header
    for key in place[:-1]:
        inside = inside[key]
    assert place[-1] in inside
    inside[place[-1]] = wrong
    doubt = judged(story.raw()).doubt
    assert doubt is not None
    words = f"the header has a value of {'.'.join(place)} that no run writes"
    assert doubt.sentence == f"the story is impossible: {words}"


FALLING = {
    "A": {"HEADER": {"INITIAL": "State10", "ACTIVATING": "State01", "NUM_FACTS": 2,
                     "SUB_SBS": {"B": 0}},
          "State10": {"Fall": "State00"}, "State00": {"Go": "State01"}, "State01": {}},
    "B": {"HEADER": {"INITIAL": "State00", "ACTIVATING": "State11", "NUM_FACTS": 2},
          "State11": {"x": "State10"}, "State10": {"y": "State00"}, "State00": {"z": "State11"}},
}  # fmt: skip
"""The base commits with B/State11/x, its last crossing; B/State10/y follows singly."""


def test_an_asked_step_that_is_paused_between_two_commits_verifies(tmp_path: Path) -> None:
    """The run was paused before it was asked, and its way goes on until it is paused again."""
    blueprint = blueprint_of(FALLING)
    acts = [{"do": "ask", "address": "A/State10/Fall"}, {"when": "B/State10", "do": "pause"},
            {"at": 1, "do": "resume"}]  # fmt: skip
    lines = "".join(f"{json.dumps(act)}\n" for act in acts)
    script = script_of(lines.encode(), "script", blueprint)
    smsl.run(blueprint, script=script, log=tmp_path / "log")
    told = read_log(tmp_path / "log", COMMANDS)
    assert told.doubt is None
    assert [one.event for one in told.events].count("paused") == 2
    assert told.events[-1].event == "run_finished"


def test_a_joint_step_may_do_an_operation_twice_and_commits_it_twice(tmp_path: Path) -> None:
    made, path = blueprint_of(blueprint_values(87)), tmp_path / "twice.jsonl"
    line = {"at": 0.0, "do": "prune", "address": "B/S111/o1", "reason": "another way"}
    smsl.run(made, script=script_of(json.dumps(line).encode(), "script", made), seed=87, log=path)
    told = read_log(path, COMMANDS)
    commits = [one.operations for one in told.events if isinstance(one, Committed)]
    assert any(len(set(one)) < len(one) for one in commits)
    assert told.doubt is None


def test_the_words_of_a_route_are_those_of_the_planner() -> None:
    assert WITHOUT_FAILURE == planner.WITHOUT_FAILURE


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda raw: raw.replace(b"\n", b"\r\n"), "does not end in a link"),
        (lambda raw: raw.replace(b"\n", b"\n\n", 1), "does not end in a link"),
        (lambda raw: b"\xef\xbb\xbf" + raw, "this is no run log"),
        (lambda raw: raw + raw, "something stands behind the head"),
    ],
)
def test_other_lines_than_a_run_writes_are_no_log(change: object, words: str) -> None:
    raw = chained([b'{"log":"smsl-run","version":2}', *(one.line().encode() for one in OTHER)])
    assert judged(raw).doubt is None
    assert callable(change)
    assert words in _answer(change(raw))


def _answer(raw: bytes) -> str:
    try:
        return str(judged(raw).doubt)
    except ReadError as error:
        return str(error)


def test_an_event_costs_the_same_however_much_has_begun() -> None:
    """Nothing is walked through that a log may have as many of as it likes."""
    many = 20_000
    start = {f"S{n}": "A" for n in range(many)}
    goals = tuple(f"S{n}/A" for n in range(many))
    started = RunStarted(t=0.0, world="w", seed=0, start=start, goals=goals)
    events: list[Event] = [started]
    events += [StateChecked(t=0.0, address=goal, result="true") for goal in goals]
    events += [GoalReached(t=1.0, goal=goal) for goal in goals]
    steps = tuple(f"{goal}/Op" for goal in goals)
    events += [RoutePlanned(t=1.0, goal="S0/A", operations=steps, cost=1.0)]
    events += [OperationStarted(t=1.0, address=step, target="B") for step in steps]
    grammar = Grammar({}, COMMANDS)
    grammar._memory.begun = _Walked()
    assert {grammar.follow(one) for one in events} == {""}


class _Walked(dict[str, Begun]):
    """What has begun, of which nobody goes through all."""

    def values(self) -> NoReturn:
        raise AssertionError("all that has begun is walked through")

    def items(self) -> NoReturn:
        raise AssertionError("all that has begun is walked through")


def test_an_operation_that_nobody_asked_for_is_refused_after_another_one(tmp_path: Path) -> None:
    """The command for the first step of an SB without subs says nothing about the next one."""
    blueprint = smsl.read(Path(__file__).parents[2] / "samples" / "hanoi-corrected.json")
    asks = [("State_aaa", "Op_1c"), ("State_caa", "Op_2b"), ("State_cba", "Op_1a")]
    acts = [{"when": "SB1/State_aaa", "do": "by_hand"}] + [
        {"when": f"SB1/{state}", "do": "ask", "address": f"SB1/{state}/{name}"}
        for state, name in asks
    ]
    lines = "".join(f"{json.dumps(act)}\n" for act in acts)
    script = script_of(lines.encode(), "script", blueprint)
    smsl.run(blueprint, script=script, log=tmp_path / "log")
    raw = (tmp_path / "log").read_bytes()
    assert judged(raw).doubt is None
    story = Story.of(raw)
    _, second, _ = story.at("commanded", command="ask")
    del story.events[second]
    doubt = judged(story.raw()).doubt
    assert doubt is not None
    assert "Op_2b begins" in str(doubt)


@pytest.mark.parametrize("number", [1547, 2451])
def test_a_hazard_may_be_met_where_an_operation_fails(number: int, tmp_path: Path) -> None:
    """In these random runs the hazard is told directly after the operation became risky."""
    raw = true_log(number, tmp_path).read_bytes()
    events = [one["event"] for one in Story.of(raw).events]
    assert ("operation_risky", "hazard_met") in itertools.pairwise(events)
    assert judged(raw).doubt is None
