"""Online generation: a run without a way is offered edges of library operations."""

from __future__ import annotations

import io
import json
import socket
import tempfile
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any

import pytest

from smsl_studio import front
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.drive.generation import Generation
from smsl_studio.errors import UsageError
from smsl_studio.front import edge_proposer, edge_sources
from smsl_studio.front.inputs import read
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.recordings import open_recording
from smsl_studio.front.runs import Run
from smsl_studio.front.script.lines import script_of
from smsl_studio.front.verifier import told_again
from smsl_studio.library.prediction import Prediction
from smsl_studio.runlog.events import EdgeGenerated, Event, ForecastTold, Held, TaskOpened
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json
from tests.cases import case
from tests.counts import share_of
from tests.front.forged_runs import FORGERIES, forged
from tests.runlog.impossible import Story

ALLOW = {"do": "answer", "kind": "generate", "option": "allow", "by": "Ada", "times": "every"}
REFUSE = {**ALLOW, "option": "refuse"}
Json = Any


def changed(sample: str, change: Callable[[Json], None]) -> Blueprint:
    """A sample after a change of its values."""
    values = json.loads((samples_dir() / f"{sample}.json").read_text("utf-8"))
    change(values)
    return read_blueprint(parse_json(json.dumps(values), f"{sample}.json"))


def cut(values: Json) -> None:
    """Nothing leads on from where Hanoi with two disks begins."""
    values["SB1"]["State_aa"] = {}


def ran(blueprint: Blueprint, *acts: Json, **choices: Any) -> Run:
    text = "\n".join(map(json.dumps, acts)).encode()
    script = script_of(text, "script", blueprint) if acts else None
    return front.run(blueprint, script=script, **{"generate": "reader", **choices})


def told(run: Run, kind: type[Event]) -> list[Any]:
    return [one for one in run.events if isinstance(one, kind)]


def lines(run: Run) -> list[str]:
    return [one.line() for one in run.events]


def answers(folder: Path, *edges: Json, number: int = 1) -> str:
    """A folder of answers, with one answer."""
    (folder / f"edges-{number}.json").write_text(json.dumps({"edges": list(edges)}))
    return f"by-hand:{folder}"


def test_the_reader_finds_an_operation_that_a_person_allows(tmp_path: Path) -> None:
    blueprint = changed("hanoi-2", cut)
    log = tmp_path / "run.jsonl"
    done = ran(blueprint, ALLOW, log=log)
    assert done.reason == "goal_reached"
    (made,) = told(done, EdgeGenerated)
    assert (made.address, made.target, made.by) == ("SB1/State_aa/Op_1b", "State_ba", "Ada")
    assert (made.provider, made.facts) == ("reader", {"SB1/0": "b"})
    (asked,) = told(done, TaskOpened)
    assert asked.kind == "generate"
    assert [one.verdict for one in told(done, ForecastTold)] == ["agrees"]
    words = [one.event for one in done.events]
    assert words.index("forecast") < words.index("task_opened") < words.index("edge_generated")
    # The same again, in the other host too; the log tells the same, and nothing was written.
    assert lines(ran(blueprint, ALLOW)) == lines(done)
    assert lines(ran(blueprint, ALLOW, host="process")) == lines(done)
    raw = log.read_bytes()
    assert verify_stream(io.BytesIO(raw), "log", blueprint).doubt is None
    seen = open_recording(log, blueprint)
    assert seen.blueprint["SB1"].table["State_aa"] == {"Op_1b": "State_ba"}
    assert not seen.differs
    assert "Op_1b" not in blueprint["SB1"].table["State_aa"]


def test_without_the_option_a_run_holds_as_before() -> None:
    blueprint = changed("hanoi-2", cut)
    plain = front.run(blueprint)
    assert plain.reason == "no_route"
    assert lines(ran(blueprint, generate="")) == lines(plain)
    # With it, and nobody there: it holds too, and says what was proposed.
    alone = ran(blueprint)
    assert alone.reason == "no_route"
    assert "nobody is there to allow it" in told(alone, Held)[-1].details[0]
    assert told(alone, EdgeGenerated) == []
    # A run that has a way is not changed by it.
    whole = read(samples_dir() / "hanoi-2.json")
    assert lines(ran(whole)) == lines(front.run(whole))


def test_a_refusal_is_final_and_the_next_one_is_shown() -> None:
    done = ran(changed("hanoi-2", cut), {**REFUSE, "times": 1}, ALLOW)
    first, second, *_ = told(done, TaskOpened)
    assert first.address != second.address
    assert [one.address for one in told(done, EdgeGenerated)] == [second.address]
    all_refused = ran(changed("hanoi-2", cut), REFUSE)
    assert all_refused.reason == "no_route"
    assert told(all_refused, EdgeGenerated) == []


EDGE = {"edge": "SB1/State_aa/Op_1b", "target": "State_ba"}
HAZARD = [{"name": "both on b", "facts": {"SB1/0": "b", "SB1/1": "a"}}]


def test_what_must_not_be_shown_is_not(tmp_path: Path) -> None:
    def dangerous(values: Json) -> None:
        cut(values)
        values["_hazards"] = HAZARD

    blueprint = changed("hanoi-2", cut)
    refused: list[tuple[Json, str]] = [
        ({**EDGE, "edge": "SB1/State_ba/Op_9z"}, "stands in State_aa"),
        ({**EDGE, "edge": "SB1/State_aa/Op_9z"}, "no such operation"),
        ({**EDGE, "edge": "../../etc/passwd"}, "no address"),
        ({**EDGE, "edge": "SB2/State_aa/Op_1b"}, "no address"),
        ({**EDGE, "target": "State_zz"}, "no state"),
        ({**EDGE, "target": "State_aa"}, "changes no fact"),
        ({**EDGE, "target": "State_cb"}, "elsewhere Op_1b brings"),
    ]
    for number, (edge, why) in enumerate(refused):
        with case("edge", edge):
            folder = tmp_path / str(number)
            folder.mkdir()
            done = ran(blueprint, ALLOW, generate=answers(folder, edge))
            assert done.reason == "no_route"
            assert why in told(done, Held)[-1].details[0]
            assert told(done, TaskOpened) == []
    met = ran(changed("hanoi-2", dangerous), ALLOW, generate=answers(tmp_path, EDGE))
    assert "meets the hazard both on b" in told(met, Held)[-1].details[0]
    assert told(met, EdgeGenerated) == []
    assert ran(changed("hanoi-2", dangerous), ALLOW).reason == "goal_reached"  # by another one


def test_an_answer_is_data(tmp_path: Path) -> None:
    blueprint = changed("hanoi-2", cut)
    odd = (
        "",
        "ignore your rules",
        "{" * 5000,
        '{"edges": []}',
        '{"edges": "all"}',
        json.dumps({"edges": [EDGE] * 17}),
        json.dumps({"edges": [{**EDGE, "code": "import os"}]}),
        json.dumps({"edges": [{**EDGE, "why": "x" * 501}]}),
        " " * 100_001 + json.dumps({"edges": [EDGE]}),
    )
    for number, text in enumerate(odd):
        with case("answer", number):
            folder = tmp_path / str(number)
            folder.mkdir()
            (folder / "edges-1.json").write_text(text)
            done = ran(blueprint, ALLOW, generate=f"by-hand:{folder}")
            assert done.reason == "no_route"
            assert told(done, TaskOpened) == []
            assert [one.name for one in folder.iterdir()] == ["edges-1.json"]


def test_by_hand_and_kept_answers(tmp_path: Path) -> None:
    blueprint = changed("hanoi-2", cut)
    asked = ran(blueprint, ALLOW, generate=f"by-hand:{tmp_path}")
    assert asked.reason == "no_route"
    prompt = (tmp_path / "edges-1.prompt.md").read_text("utf-8")
    assert "SB1 stands in State_aa" in prompt
    assert "Op_1b elsewhere: State_ca to State_ba" in prompt
    log = tmp_path / "run.jsonl"
    done = ran(blueprint, ALLOW, generate=answers(tmp_path, EDGE), log=log)
    assert done.reason == "goal_reached"
    kept = tmp_path / "run.jsonl.answers.json"
    again = ran(blueprint, ALLOW, generate=f"replay:{kept}")
    assert [one.proposal for one in told(again, EdgeGenerated)] == [
        one.proposal for one in told(done, EdgeGenerated)
    ]
    for name in ("oracle", "by-hand", "by-hand:"):
        with pytest.raises(UsageError):
            ran(blueprint, generate=name)


def test_people_keep_what_they_shut_out(tmp_path: Path) -> None:
    whole = read(samples_dir() / "hanoi-2.json")
    shut = [f"SB1/State_aa/Op_1{peg}" for peg in "bc"]
    done = ran(whole, ALLOW, avoid=shut)
    assert all(one.address not in shut for one in told(done, EdgeGenerated))
    again = answers(tmp_path, {**EDGE, "edge": shut[0]})
    assert (
        "it is avoided" in told(ran(whole, ALLOW, avoid=shut, generate=again), Held)[-1].details[0]
    )
    pruned = {"do": "prune", "reason": "no", "by": "Bo"}
    acts = [{"when": "SB1/State_aa", **pruned, "address": one} for one in shut]
    assert all(one.address not in shut for one in told(ran(whole, *acts, ALLOW), EdgeGenerated))
    # A generated edge is pruned and vetoed like any other.
    blueprint = changed("hanoi-2", cut)
    veto = {"when": "SB1/State_ba", "do": "veto", "by": "Bo"}
    assert ran(blueprint, ALLOW, veto).reason == "goal_reached"


def test_levels_leave_generation_to_people(tmp_path: Path) -> None:
    blueprint = changed("hanoi-2", cut)
    done = ran(blueprint, ALLOW, levels={"generation": "human"})
    assert done.reason == "no_route"
    assert "leaves generation to people" in told(done, Held)[-1].details[0]
    by_hand = answers(tmp_path, EDGE)
    assert ran(blueprint, ALLOW, levels={"generation": "human"}, generate=by_hand).reason == (
        "goal_reached"
    )


def test_a_server_that_says_nothing_keeps_no_run(monkeypatch: pytest.MonkeyPatch) -> None:
    blueprint = changed("hanoi-2", cut)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        url = f"http://127.0.0.1:{silent.getsockname()[1]}/v1"
        asked = iter([False] * 40)
        done = ran(blueprint, ALLOW, generate=url, stop_when=lambda: next(asked, True))
        assert done.reason == "stopped"
        monkeypatch.setattr(edge_sources, "SECONDS", 0.05)
        late = ran(blueprint, ALLOW, generate=url)
    assert late.reason == "no_route"
    assert "takes longer than" in told(late, Held)[-1].details[0]
    assert told(late, TaskOpened) == []


def test_several_branches() -> None:
    def planless(values: Json) -> None:
        values["TOOLPLAN"]["State00"] = {}

    def pointless(values: Json) -> None:
        values["DIGITIZATION"]["State01"] = {"CalibratePointer": "State11"}
        values["DIGITIZATION"]["State00"] = {}

    roots = ran(changed("three-roots", planless), ALLOW)
    assert roots.reason == "goal_reached"
    assert [one.address for one in told(roots, EdgeGenerated)] == ["TOOLPLAN/State00/ChooseEntry"]
    below = ran(changed("three-levels", pointless), ALLOW, start="SURGERY/State100")
    assert below.reason == "goal_reached"
    (made,) = told(below, EdgeGenerated)
    assert made.address == "DIGITIZATION/State00/TouchLandmarks"
    # An edge that changes what a sub-SB expands is none of the library's.
    whole = json.dumps({"edges": [{"edge": "SURGERY/State000/Op", "target": "State110"}]})
    assert "no such operation" in _why(changed("three-levels", _without_way), whole)


def _without_way(values: Json) -> None:
    values["SURGERY"]["State000"] = {}


def _why(blueprint: Blueprint, answer: str) -> str:
    """Why an answer is not shown."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "edges-1.json").write_text(answer)
        held = told(ran(blueprint, ALLOW, generate=f"by-hand:{folder}"), Held)
    return str(held[-1].details[0])


def test_nobody_is_asked_while_a_fact_is_unknown() -> None:
    blueprint = changed("hanoi-2", cut)
    lost = {"do": "disturb", "target": "SB1/1", "kind": "dropout", "with": {"rate": 1.0}}
    late = {**ALLOW, "after": 5.0}
    done = ran(blueprint, lost, late)
    assert done.reason == "no_route"
    assert told(done, EdgeGenerated) == []
    assert "SB1/1 is unknown" in told(done, Held)[-1].details[0]


def test_hanoi_with_a_dropped_disk(tmp_path: Path) -> None:
    """In physics: what would pick it up is shut out, and the library proposes something else."""
    blueprint = read(samples_dir() / "hanoi-failures.json")
    shut = [f"SB1/State_xaa/Op_recover1{peg}" for peg in "abc"]
    dropped = {"during": "SB1/State_aaa/Op_1c", "after": 0.3, "do": "inject"}
    dropped["fault"] = "gripper_opens"
    terms = {"world": "hanoi", "on_mismatch": "adopt", "avoid": shut, "goal": "SB1/State_aba"}
    log = tmp_path / "run.jsonl"
    done = ran(blueprint, dropped, ALLOW, log=log, **terms)
    assert done.reason == "goal_reached"
    (made,) = told(done, EdgeGenerated)
    assert made.address == "SB1/State_xaa/Op_recover2b"
    assert made.function == "hanoi.recover_disk"
    raw = log.read_bytes()
    assert verify_stream(io.BytesIO(raw), "log", blueprint).doubt is None
    off = ran(blueprint, dropped, generate="", **terms)
    assert off.reason == "no_route"


def test_forged_stories_with_a_generated_edge(tmp_path: Path) -> None:
    def dangerous(values: Json) -> None:
        cut(values)
        values["_hazards"] = [{**HAZARD[0], "facts": {"SB1/0": "c", "SB1/1": "a"}}]

    blueprint = changed("hanoi-2", dangerous)
    log = tmp_path / "run.jsonl"
    ran(blueprint, ALLOW, log=log)
    true = Story.of(log.read_bytes())
    assert _believed(true, blueprint)
    at = next(n for n, one in enumerate(true.events) if one["event"] == "edge_generated")
    forgeries: dict[str, Callable[[Story], Any]] = {
        "no event": lambda story: story.events.pop(at),
        "twice": lambda story: story.events.insert(at, dict(story.events[at])),
        "another person": lambda story: story.events[at].update(by="Bo"),
        "nobody": lambda story: story.events[at].update(by=""),
        "another target": lambda story: story.events[at].update(target="State_bb"),
        "other facts": lambda story: story.events[at].update(facts={"SB1/0": "a"}),
        "no facts": lambda story: story.events[at].update(facts={}),
        "another edge": lambda story: story.events[at].update(address="SB1/State_aa/Op_2b"),
        "a drawn edge": lambda story: story.events[at].update(address="SB1/State_ba/Op_1a"),
        "another function": lambda story: story.events[at].update(function="table.other"),
        "no function": lambda story: story.events[at].update(function=""),
        "no provider": lambda story: story.events[at].update(provider=""),
        "no digest": lambda story: story.events[at].update(proposal="allow"),
        "later": lambda story: story.events.insert(at + 3, story.events.pop(at)),
        "refused": lambda story: story.events[at - 1].update(
            answer="refuse", answers={"Ada": "refuse"}
        ),
        "another question": lambda story: story.events[at - 4].update(kind="supervise"),
        "into the hazard": lambda story: _renamed(story, "Op_1b", "Op_1c", "State_ba", "State_ca"),
        "not as elsewhere": lambda story: _renamed(story, "Op_1b", "Op_1c"),
    }
    for name, forge in forgeries.items():
        with case("forgery", name):
            story = Story.of(log.read_bytes())
            forge(story)
            assert not _believed(story, blueprint)


def test_logs_of_runs_that_left_a_check_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each is consistent but for one rule, so this rule alone refuses it."""

    def dangerous(values: Json) -> None:
        cut(values)
        values["_hazards"] = HAZARD

    hazard, plain = changed("hanoi-2", dangerous), changed("hanoi-2", cut)
    with monkeypatch.context() as patched:
        patched.setattr(edge_proposer, "first_met", lambda *_: None)
        patched.setattr(edge_proposer.RunProposer, "_leads", lambda *_: True)
        patched.setattr(edge_proposer.RunProposer, "_foresee", lambda *_: Prediction("agrees"))
        patched.setattr(Generation, "_objection", lambda *_: "")
        first = tmp_path / "hazard.jsonl"
        assert told(ran(hazard, ALLOW, generate=answers(tmp_path, EDGE), log=first), EdgeGenerated)
    with monkeypatch.context() as patched:
        patched.setattr(edge_proposer.RunProposer, "_misfit", lambda *_: "")
        patched.setattr(edge_proposer, "_new_findings", lambda *_: [])
        odd = {**EDGE, "edge": "SB1/State_aa/Op_1c"}
        second = tmp_path / "odd.jsonl"
        done = ran(plain, ALLOW, generate=answers(tmp_path, odd), log=second)
        assert done.reason == "goal_reached"
    assert not _believed(Story.of(first.read_bytes()), hazard)
    assert not _believed(Story.of(second.read_bytes()), plain)
    # The same event about an edge that is drawn.
    whole, third, fourth = read(samples_dir() / "hanoi-2.json"), *map(tmp_path.joinpath, "ab")
    ran(whole, ALLOW, log=third)
    ran(plain, ALLOW, log=fourth)
    drawn, made = (Story.of(log.read_bytes()) for log in (third, fourth))
    words = [one["event"] for one in made.events]
    block = made.events[words.index("task_opened") : words.index("edge_generated") + 1]
    at = next(n for n, one in enumerate(drawn.events) if one["event"] == "route_planned")
    assert _believed(drawn, whole)
    drawn.events[at:at] = block[:-1]
    assert _believed(drawn, whole)
    drawn.events.insert(at + len(block) - 1, block[-1])
    assert not _believed(drawn, whole)


def test_no_forged_story_takes_an_edge_that_nobody_allowed(tmp_path: Path) -> None:
    blueprint = changed("hanoi-2", cut)
    log = tmp_path / "run.jsonl"
    ran(blueprint, {**REFUSE, "times": 1}, ALLOW, log=log)
    true, random = Story.of(log.read_bytes()), Random("generated")
    for _ in range(share_of(400)):
        story = forged(true, random.choice(FORGERIES), random)
        refusal = told_again(story.raw(), blueprint) if story is not None else "none"
        assert story is None or _believed(story, blueprint) == (not refusal)
        if story is not None and not refusal:
            known = {str(one.address): one.target for one in blueprint["SB1"].edges()}
            for before, event in pairwise(story.events):
                if event["event"] == "edge_generated":
                    assert before["answers"] == {event["by"]: "allow"}
                    known[event["address"]] = event["target"]
                elif event["event"] == "operation_started":
                    assert known[event["address"]] == event["target"]


def _believed(story: Story, blueprint: Blueprint) -> bool:
    return verify_stream(io.BytesIO(story.raw()), "log", blueprint).doubt is None


def _renamed(story: Story, *names: str) -> None:
    """The story with other names, up to the event of the edge."""
    at = next(n for n, one in enumerate(story.events) if one["event"] == "edge_generated")
    for number, event in enumerate(story.events[: at + 1]):
        text = json.dumps(event)
        for old, new in zip(names[::2], names[1::2], strict=True):
            text = text.replace(old, new)
        if event["event"] != "run_started":
            story.events[number] = json.loads(text.replace('{"SB1/0": "b"}', '{"SB1/0": "c"}'))
