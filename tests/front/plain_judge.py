"""A plain judge of stories, written apart from ``verify.py`` and from the grammar of logs.

It knows the blueprint as Studio reads it, and says why a story is impossible where it is sure. It
looks at motion, facts, commits, questions to people and the end; the order of commands and the
choice of routes are not its concern.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.configuration import Hierarchy, disagreements
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import AddressError
from tests.runlog.impossible import Story

Json = Any


def why_impossible(story: Story, blueprint: Blueprint) -> str:
    """Why the story cannot be one of this blueprint. Empty where the judge sees nothing."""
    try:
        return next(_Judge(story, blueprint).faults(), "")
    except (LookupError, TypeError, ValueError, AttributeError, AddressError) as error:
        return f"it is no story at all: {error!r}"


class _Judge:
    def __init__(self, story: Story, blueprint: Blueprint) -> None:
        self.events, self.header = story.events, story.header
        self.blueprint, self.hierarchy = blueprint, Hierarchy(blueprint)
        self.facts: dict[tuple[str, int], str | None] = {}
        self.sensed: set[tuple[str, int]] = set()
        self.here: dict[str, str] = {}
        self.begun: dict[str, Json] = {}
        self.shut = set(story.header["avoid"])
        self.tasks: dict[str, Json] = {}
        self.answers: dict[str, dict[str, str]] = {}
        self.count, self.began = 0, False

    def faults(self) -> Iterator[str]:
        words = [one["event"] for one in self.events]
        if words[-1:] != ["run_finished"] or words.count("run_finished") != 1:
            yield "a run has one end, and it is the last event"
        if words.count("run_started") > 1:
            yield "a run begins once"
        before = 0.0
        for event in self.events:
            if event["t"] < before:
                yield "time goes back"
            before = event["t"]
            judge = getattr(self, event["event"], None)
            if judge is not None:
                yield from judge(event)

    def run_started(self, event: Json) -> Iterator[str]:
        self.here, self.began = dict(event["start"]), True
        self.sensed = {_fact(text) for text in event["sensed"]}
        if set(self.here) != set(self.blueprint.branches):
            yield "the start names other SBs"
        for name, state in self.here.items():
            if state not in self.blueprint[name].table:
                yield f"{name} has no {state}"
        if disagreements(self.hierarchy, self.here):
            yield "base and sub-SB disagree at the start"

    def fact_changed(self, event: Json) -> Iterator[str]:
        key, value = (event["branch"], event["digit"]), event["value"]
        branch = self.blueprint[event["branch"]]
        if not 0 <= event["digit"] < branch.num_facts:
            yield "there is no such fact"
        if key in self.facts and self.facts[key] == value:
            yield "the fact has this value already"
        if value is not None and event["digit"] in branch.subs:
            yield "a sub-SB expands this fact, so nobody senses it"
        self.facts[key] = value

    def state_checked(self, event: Json) -> Iterator[str]:
        name, state = Address.split(event["address"])
        branch = self.blueprint[name]
        own = [n for n in range(branch.num_facts) if n not in branch.subs]
        told = {n: self.facts.get((name, n)) for n in own if (name, n) in self.sensed}
        wrong = [n for n, value in told.items() if value not in (None, branch.facts(state)[n])]
        unknown = [n for n, value in told.items() if value is None]
        result = event["result"]
        if result == "true" and (wrong or unknown or event["misses"] or event["unknown"]):
            yield "the check is true, and the samples say otherwise"
        if result == "unknown" and (wrong or event["misses"]):
            yield "the check is unknown, and a sample contradicts the state"
        if not branch.subs and result == "false" and not wrong:
            yield "the check is false, and no sample contradicts the state"

    def operation_started(self, event: Json) -> Iterator[str]:
        name, state, word = Address.split(event["address"])
        branch = self.blueprint[name]
        if branch.table[state].get(word) != event["target"]:
            yield "the blueprint has no such edge"
        if event["address"] in self.shut:
            yield "the edge was shut out"
        if not self._below_or_above(name) and self.here[name] != state:
            yield "the SB stands elsewhere"
        for fact, wanted in branch.operation_note(state, word).requires.items():
            key = _fact(fact)
            moves = key[0] == name or self._below_or_above(key[0])
            if not moves and key in self.sensed and self.facts.get(key) != wanted:
                yield f"it requires {fact} to be {wanted}"
        self.begun[event["address"]] = event

    def _below_or_above(self, name: str) -> bool:
        """Whether the steps of an SB are joint with those of others."""
        return bool(self.hierarchy.bases[name] or self.hierarchy.subs[name])

    def operation_ended(self, event: Json) -> Iterator[str]:
        if event["address"] not in self.begun:
            yield "what ends has not begun"
        else:
            self.begun[event["address"]] = {**self.begun[event["address"]], "how": event["outcome"]}

    def committed(self, event: Json) -> Iterator[str]:
        there = {**self.here, **event["configuration"]}
        for address in event["operations"]:
            begun = self.begun.pop(address, None)
            if begun is None:
                yield "what commits has not begun"
            elif begun["function"] and begun.get("how") != "returned":
                yield "what commits has not ended well"
        ends = {Address.split(text)[0]: text for text in event["operations"]}
        for name, text in ends.items():
            _, state, word = Address.split(text)
            target = self.blueprint[name].table[state][word]
            if not self.hierarchy.bases[name] and there[name] != target:
                yield "it commits in another state"
        moved = {name for name in there if there[name] != self.here[name]}
        if not moved <= set(event["configuration"]):
            yield "an SB moves without a word"
        if disagreements(self.hierarchy, there):
            yield "base and sub-SB commit apart"
        for name, state in event["configuration"].items():
            branch = self.blueprint[name]
            for n, value in enumerate(branch.facts(state)):
                key = (name, n)
                if n not in branch.subs and key in self.sensed and self.facts.get(key) != value:
                    yield "it commits, and the samples are others"
        self.here, self.count = there, self.count + len(event["operations"])

    def relocalised(self, event: Json) -> Iterator[str]:
        if set(event["configuration"]) != set(self.blueprint.branches):
            yield "it is located in no configuration"
        if disagreements(self.hierarchy, event["configuration"]):
            yield "base and sub-SB are located apart"
        self.here = dict(event["configuration"])
        self.begun = {}

    def mismatch(self, event: Json) -> Iterator[str]:
        self.begun = {}
        if not event["facts"]:
            yield "nothing differs"

    def held(self, event: Json) -> Iterator[str]:
        self.begun = {}
        yield from ()

    stopped = taken_over = held

    def operation_pruned(self, event: Json) -> Iterator[str]:
        self.shut.add(event["address"])
        yield from ()

    def operation_restored(self, event: Json) -> Iterator[str]:
        self.shut.discard(event["address"])
        yield from ()

    def hazard_met(self, event: Json) -> Iterator[str]:
        named = {one.name: dict(one.facts) for one in self.blueprint.hazards}
        if named[event["name"]] != event["facts"]:
            yield "the hazard has other facts"
        for text, value in event["facts"].items():
            key = _fact(text)
            if key in self.sensed and self.facts.get(key) != value:
                yield "the hazard is not met by the samples"

    def task_opened(self, event: Json) -> Iterator[str]:
        if event["task"] in self.tasks:
            yield "a task has a name of its own"
        self.tasks[event["task"]], self.answers[event["task"]] = event, {}

    def task_answered(self, event: Json) -> Iterator[str]:
        if event["refused"]:
            return
        task, given = self.tasks[event["task"]], self.answers[event["task"]]
        wanted = [one.strip().casefold() for one in task["role"].split(",") if one.strip()]
        open_to_all = len(wanted) < task["persons"]
        if event["by"] in given:
            yield "one person answers twice"
        escalated = task.get("also", "")
        if not open_to_all and event["role"].casefold() not in (*wanted, escalated.casefold()):
            yield "this role may not answer"
        given[event["by"]] = event["role"]

    def task_escalated(self, event: Json) -> Iterator[str]:
        self.tasks[event["task"]] = {**self.tasks[event["task"]], "also": event["role"]}
        yield from ()

    def task_closed(self, event: Json) -> Iterator[str]:
        given = self.answers[event["task"]]
        if event["answers"] and set(event["answers"]) != set(given):
            yield "it has the answers of others"
        if event["outcome"] == "answered" and set(event["answers"].values()) != {event["answer"]}:
            yield "they did not agree"

    def goal_reached(self, event: Json) -> Iterator[str]:
        name, state = Address.split(event["goal"])
        if self.here.get(name) != state:
            yield "the run does not stand at the goal"

    def run_finished(self, event: Json) -> Iterator[str]:
        if event["operations"] != self.count:
            yield "it counts other operations"
        if self.began and event["configuration"] != self.here:
            yield "it ends elsewhere"
        if event["reason"] == "goal_reached" and not self.began:
            yield "it reaches its goal and has not begun"


def _fact(text: str) -> tuple[str, int]:
    found = split_fact(text)
    if found is None:
        raise ValueError(f"{text} is no fact")
    return found
