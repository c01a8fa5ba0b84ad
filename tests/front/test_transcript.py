"""What people did by hand becomes a script, and the script makes the same run again."""

from __future__ import annotations

import json
from dataclasses import replace
from random import Random
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import open_request, run_request
from smsl_studio.front.script.lines import script_of
from smsl_studio.front.script.transcript import Transcript
from smsl_studio.front.script_text import script_text
from smsl_studio.runlog.events import Event
from smsl_studio.shipped import samples_dir

SAMPLES = ("hanoi-corrected", "hfsm", "three-levels", "registration-failures",
           "registration-people", "registration-digitization")  # fmt: skip
HANOI = smsl.read(samples_dir() / "hanoi-corrected.json")
MOST = 400
"""Ticks after which a random person ends the run."""


class Hand:
    """A person at a run, whose commands are written down."""

    def __init__(self, blueprint: Blueprint, **asked: Any) -> None:
        self.request = RunRequest(blueprint, host="local", attended=True, **asked)
        self.dispatcher: Dispatcher = open_request(self.request)
        self.transcript = Transcript()
        self.events: list[Event] = []
        self._hear(self.dispatcher.open())
        self.transcript.hear(self.events)

    def tick(self, count: int = 1) -> None:
        for _ in range(count):
            self.transcript.before(self.dispatcher)
            events = self.dispatcher.tick()
            self._hear(events)
            self.transcript.after(self.dispatcher, events)

    def say(self, word: str, *args: Any, **said: Any) -> None:
        getattr(self.dispatcher, word)(*args, by="Ada", **said)
        self.tick()

    def until(self, phase: str) -> None:
        for _ in range(MOST):
            if self.dispatcher.phase == phase:
                return
            self.tick()
        raise AssertionError(f"never {phase}: {self.dispatcher.phase}")

    def _hear(self, events: tuple[Event, ...]) -> None:
        self.events += events

    @property
    def text(self) -> str:
        return script_text(self.request, self.transcript.lines)

    @property
    def lines(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.text.splitlines()][1:]

    def again(self) -> list[str]:
        """The events of the same run without a person, under the script."""
        blueprint = self.request.blueprint
        script = script_of(self.text.encode(), "script", blueprint)
        asked = replace(self.request, script=script, attended=True if script.acts else None)
        run = run_request(asked)
        return [event.line() for event in run.events]

    @property
    def told(self) -> list[str]:
        return [event.line() for event in self.events]


def test_a_pause_in_the_middle_and_what_is_done_in_it_comes_again_at_the_same_tick() -> None:
    hand = Hand(HANOI)
    hand.tick()
    assert hand.dispatcher.under_way == Address("SB1", "State_aaa", "Op_1c")
    for word in ("pause", "resume", "pause"):
        hand.say(word)
    hand.say("set_cost", Address("SB1", "State_bba", "Op_3c"), 2.5)
    hand.say("resume")
    hand.tick()
    hand.say("disturb", "SB1/2", "stuck", value="b")
    hand.until("fault_hold")
    hand.tick(7)
    hand.say("disturb", "SB1/2", "none")
    hand.tick()
    for word in ("resume", "stop", "end"):
        hand.say(word)
    assert hand.events[-1].event == "run_finished"
    op = "SB1/State_aaa/Op_1c"
    assert hand.lines[:3] == [
        {"during": op, "do": "pause", "by": "Ada"},
        {"during": op, "turn": 2, "do": "resume", "by": "Ada"},
        {"during": op, "turn": 3, "do": "pause", "by": "Ada"},
    ]
    assert hand.again() == hand.told


def test_a_run_by_hand_with_a_take_over_and_a_stop() -> None:
    hand = Hand(HANOI, goals=("SB1/State_bbb",), seed=4)
    hand.say("set_automatic", automatic=False)
    hand.tick(5)
    hand.say("ask", Address("SB1", "State_aaa", "Op_1c"))
    hand.say("take_over")
    hand.tick(3)
    hand.say("inject", fault="set", fact="SB1/0", value="c")
    hand.say("give_back")
    hand.say("accept")
    hand.say("full_map", on=True)
    hand.say("ask", Address("SB1", "State_caa", "Op_2b"))
    hand.say("stop")
    hand.say("stop")
    hand.say("reset")
    hand.say("prune", Address("SB1", "State_caa", "Op_2b"), "it slipped")
    hand.say("stop")
    hand.say("end")
    assert hand.lines[0] == {"at": 0.0, "do": "by_hand", "by": "Ada"}
    assert hand.events[-1].event == "run_finished"
    assert hand.again() == hand.told


def test_a_parameter_called_after_is_no_moment() -> None:
    hand = Hand(smsl.read(samples_dir() / "hanoi-2.json"), world="hanoi", goals=("SB1/State_ca",))
    hand.tick(3)
    hand.say("inject", fault="gripper_opens", after=0.1, seconds=0.5)
    while not hand.dispatcher.finished and hand.dispatcher.phase != "held":
        hand.tick()
    hand.say("end")
    assert hand.lines[0]["with"] == {"after": 0.1, "seconds": 0.5}
    assert "failed" in "".join(hand.told)
    assert hand.again() == hand.told


def test_the_first_line_says_how_the_script_is_run() -> None:
    hand = Hand(HANOI, starts=("SB1/State_caa",), goals=("SB1/State_bbb",), seed=7,
                levels={"supervision": "automatic"})  # fmt: skip
    hand.say("pause")
    first, level, _ = (json.loads(line) for line in hand.text.splitlines())
    assert first == {
        "_run": "smsl-studio run hanoi-corrected.json --world table --start SB1/State_caa "
        "--goal SB1/State_bbb --seed 7 --script SCRIPT"
    }
    assert level == {"do": "level", "of": "supervision", "level": "automatic"}


def test_people_answer_again() -> None:
    hand = Hand(smsl.read(samples_dir() / "registration-people.json"))
    random = Random(1)
    for _ in range(MOST):
        if hand.dispatcher.finished:
            break
        tasks = hand.dispatcher.status.tasks
        if tasks and random.random() < 0.5:
            task = tasks[0]
            yes = next((one for one in task.options if one.yes), task.options[0])
            role = task.roles[len(task.answered)] if task.roles else ""
            who = f"{role} {len(task.answered)}"
            hand.dispatcher.answer(task.name, yes.value, role, by=who)
        hand.tick()
    answers = [line for line in hand.lines if line["do"] == "answer"]
    assert len(answers) > 3
    assert {"kind", "option", "role"} <= set(answers[0])
    assert hand.again()[: len(hand.told)] == hand.told


@pytest.mark.parametrize("name", SAMPLES)
@pytest.mark.parametrize("seed", range(6))
def test_whatever_is_done_by_hand_the_script_does_again(name: str, seed: int) -> None:
    """A random person commands at random ticks, in every run state."""
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    hand, random = Hand(blueprint, seed=seed), Random(f"{name} {seed}")
    hand.say("full_map", on=True)
    for _ in range(MOST):
        if hand.dispatcher.finished:
            break
        for _ in range(random.choice([0, 0, 0, 0, 1, 1, 2])):
            _do_anything(hand, random)
        hand.tick()
    again = hand.again()
    assert again[: len(hand.told)] == hand.told


def _do_anything(hand: Hand, random: Random) -> None:
    dispatcher, status = hand.dispatcher, hand.dispatcher.status
    blueprint = hand.request.blueprint
    edges = [edge.address for branch in blueprint for edge in branch.edges()]
    edge = random.choice([one.address for one in status.possible] or edges)
    facts = [(branch, digit) for branch in blueprint for digit in range(branch.num_facts)
             if digit not in branch.subs]  # fmt: skip
    branch, digit = random.choice(facts)
    fact, value = f"{branch.name}/{digit}", random.choice(branch.alphabet[digit])
    word = random.choice(
        ("pause", "resume", "resume", "step", "ask", "inject", "disturb", "veto", "prune",
         "restore", "set_cost", "take_over", "give_back", "accept", "adopt", "stop", "reset",
         "set_automatic", "full_map", "answer")
    )  # fmt: skip
    if word == "ask" and status.phase == "running":
        return  # a script pauses the run for it
    arguments: dict[str, dict[str, Any]] = {
        "ask": {"address": edge}, "veto": {"address": edge}, "restore": {"address": edge},
        "prune": {"address": edge, "reason": "by chance"},
        "set_cost": {"address": edge, "cost": random.choice([0.5, 3.0])},
        "set_automatic": {"automatic": random.random() < 0.6}, "full_map": {"on": True},
        "inject": random.choice([{"fault": "set", "fact": fact, "value": value},
                                 {"fault": "fail"}, {"fault": "nothing"}]),
        "disturb": {"target": fact, "kind": random.choice(["dropout", "stuck", "none", "none"])},
    }  # fmt: skip
    said = arguments.get(word, {})
    if word == "answer":
        if not status.tasks:
            return
        task = random.choice(status.tasks)
        role = random.choice(task.roles or ("",))
        said = {"task": task.name, "option": random.choice(task.options).value, "role": role}
    getattr(dispatcher, word)(**said, by=random.choice(["Ada", "Bo"]))
