"""Logs of real runs: random blueprints and samples, with scripts, people, faults and chance."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from random import Random
from typing import Any

import smsl_studio as smsl
from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.agents import RiskLimit
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import RunRefused
from smsl_studio.front.recorder import Recorder, start_log
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import open_request
from smsl_studio.front.script.lines import script_of
from smsl_studio.shipped import samples_dir
from tests.dispatch.arguments import drawn_arguments
from tests.front.any_run import any_run
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

Json = Any
SAMPLES = ("hfsm", "registration", "three-levels", "three-roots", "hanoi-failures",
           "registration-digitization", "registration-failures", "registration-people")  # fmt: skip
SCRIPTED = ("hanoi-chosen", "hanoi-faults", "hanoi-pruned", "hanoi-taken-over")
SILENT = LAMP_PLUGIN.replace('print("built")', "pass").replace('print("switching")', "pass")
LEVELS: tuple[Mapping[str, str], ...] = (
    {}, {}, {"supervision": "human"}, {"inspection": "human"}, {"supervision": "automatic"},
)  # fmt: skip
DYING = """
import os


def register(library):
    @library.world("dying", engine="table")
    def build(world, blueprint, seed):
        world.set_facts({("LAMP", 0): "0"})

    @library.sensor("bulb_{n}", fact="{n}", period=0.1)
    def bulb(world, n: int):
        return world.fact("LAMP", n - 1)

    @library.operation("Op_{to}")
    def switch(world, to: str):
        yield
        os._exit(3)
"""


def true_log(number: int, folder: Path) -> Path:
    """The log of the run of this number; equal numbers give equal events."""
    path = folder / f"{number}.jsonl"
    kinds = (_random, _commanded, _sample, _commanded, _sample, _random, _lamp, _refused)
    kinds[number % len(kinds)](number, path)
    return path


def log_of_a_dying_world(folder: Path) -> Path:
    """A world whose process ends in the middle of an operation."""
    write_plugin(folder / "plugins", "dying", DYING)
    path = folder / "dying.jsonl"
    lamp = blueprint_of(LAMP)
    smsl.run(lamp, "dying", host="process", plugin_paths=[folder / "plugins"], log=path)
    return path


def log_of_physics(number: int, folder: Path) -> Path:
    """Hanoi in PyBullet; every other one by a script of faults."""
    path = folder / f"physics-{number}.jsonl"
    blueprint = smsl.read(samples_dir() / "hanoi-2.json")
    line = {"during": "SB1/State_aa/Op_1b", "after": 0.5, "do": "inject", "fault": "gripper_opens"}
    script = script_of(json.dumps(line).encode(), "script", blueprint) if number % 2 else None
    smsl.run(blueprint, "hanoi", seed=number, script=script, log=path)
    return path


def _random(number: int, path: Path) -> None:
    """A random blueprint under a random script; in every third people let it begin."""
    run = any_run(number)
    levels = {"supervision": "human"} if number % 3 == 0 else None
    smsl.run(run.blueprint, script=run.script, log=path, levels=levels, **run.asked)


def _sample(number: int, path: Path) -> None:
    """A sample, with its script where it has one, else from anywhere to anywhere."""
    random = Random(number)
    if random.random() < 0.3:
        blueprint = smsl.read(samples_dir() / "hanoi-corrected.json")
        acts = samples_dir() / "scripts" / f"{random.choice(SCRIPTED)}.jsonl"
        smsl.run(blueprint, script=smsl.read_script(acts, blueprint), seed=number, log=path)
        return
    name = random.choice(SAMPLES)
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    script = None
    if name == "registration-people":
        file = samples_dir() / "scripts" / "registration-answered.jsonl"
        script = smsl.read_script(file, blueprint)
    root = next(iter(blueprint))
    goal = str(Address(root.name, random.choice(list(root.table))))
    edges = [str(edge.address) for branch in blueprint for edge in branch.edges()]
    avoid = random.sample(edges, random.randrange(3))
    smsl.run(
        blueprint,
        goal=goal if random.random() < 0.6 else None,
        avoid=avoid,
        script=script,
        seed=number,
        supervisor=RiskLimit("low") if random.random() < 0.2 else None,
        log=path,
    )


def _lamp(number: int, path: Path) -> None:
    """A world of a plugin, whose functions fail, raise an error or take too long."""
    folder = path.with_suffix("")
    write_plugin(folder, "lamp", SILENT)
    shut = Random(number).sample(["Op_on", "Op_break", "Op_spin"], number % 3)
    avoid = [f"LAMP/State_0/{name}" for name in shut if name != "Op_spin"]
    smsl.run(blueprint_of(LAMP), "lamp", avoid=[*avoid, "LAMP/State_0/Op_spin"], seed=number,
             plugin_paths=[folder], log=path)  # fmt: skip


def _refused(number: int, path: Path) -> None:
    """A run that is refused at its start, or by nobody who answers."""
    run = any_run(number)
    if number % 3 == 0:
        smsl.run(run.blueprint, log=path, levels={"BASE/1": "human"})
        return
    base = {"HEADER": {"INITIAL": "State_0", "NUM_FACTS": 1, "SUB_SBS": {"SUB": 0}},
            "State_0": {"Op": "State_1"}, "State_1": {}}  # fmt: skip
    sub = {"HEADER": {"INITIAL": "State_1", "ACTIVATING": "State_1"}, "State_1": {"Op": "State_1"}}
    goals = ["BASE/State_0", "SUB/State_1"] if number % 3 == 1 else None
    smsl.run(blueprint_of({"BASE": base, "SUB": sub}), goal=goals, log=path)


def _commanded(number: int, path: Path) -> None:
    """Somebody says anything at any tick, and answers anything; at last it is stopped, left or let
    go of."""
    random = Random(number)
    name = random.choice(SAMPLES)
    own = random.random() < 0.4
    blueprint = any_run(number).blueprint if own else smsl.read(samples_dir() / f"{name}.json")
    chance = Random(f"hazards {number}") if number % 8 == 3 else None
    if chance is not None:
        blueprint = _guarded(blueprint, chance)
    by_hand, levels = random.random() < 0.4, random.choice(LEVELS)
    request = RunRequest(
        blueprint, seed=number, host="local", by_hand=by_hand, levels=levels or {}, log=path,
        on_mismatch=random.choice(["hold", "adopt"]), attended=True,
    )  # fmt: skip
    recording = Recorder(lambda event: None, start_log(request, None))
    try:
        dispatcher = open_request(request)
    except RunRefused as refused:
        recording.end("refused", refused.sentence, None)
        return
    recording.tell(dispatcher.open())
    for _ in range(random.randrange(10, 60)):
        if chance is not None and chance.random() < 0.3:
            _endanger(dispatcher, blueprint, chance)
        while random.random() < 0.4:
            _say(dispatcher, blueprint, random)
        for task in dispatcher.status.tasks:
            if random.random() < 0.4:
                said = "SB" if random.random() < 0.1 else random.choice(task.options).value
                dispatcher.answer(task.name, said, random.choice(["nurse", "surgeon", ""]),
                                  by=random.choice(["Ada", "Bo"]))  # fmt: skip
        recording.tell(dispatcher.tick())
    _end(dispatcher, recording, random)
    dispatcher.close()


def _guarded(blueprint: Blueprint, chance: Random) -> Blueprint:
    """The same with a hazard of two facts, and one that nobody can read."""
    facts = [(branch, d) for branch in blueprint for d in range(branch.num_facts)]
    some = chance.sample(facts, min(2, len(facts)))
    named = {f"{one.name}/{d}": _other_value(one, d, chance) for one, d in some}
    odd = {"name": "Odd", "facts": {"nowhere": "1"}}
    return edit.set_hazards(blueprint, [{"name": "Both", "facts": named}, odd])


def _other_value(branch: StateBranch, digit: int, chance: Random) -> str:
    """A value that the fact does not have at the start, if there is one."""
    start = branch.facts(branch.initial)[digit]
    others = [value for value in branch.alphabet[digit] if value != start]
    return chance.choice(others or list(branch.alphabet[digit]))


def _endanger(run: Dispatcher, blueprint: Blueprint, chance: Random) -> None:
    """Let a fact of the hazard have its value behind the run's back."""
    fact, value = chance.choice(list(blueprint.hazards[0].facts.items()))
    run.inject("set", fact=fact, value=value, by="Ada")


def _end(dispatcher: Dispatcher, recording: Recorder, random: Random) -> None:
    if random.random() < 0.2 and not dispatcher.finished:
        recording.end("stopped", "The window let go of the run while it went on.", dispatcher)
    elif random.random() < 0.5:
        dispatcher.stop(by="Ada")
        recording.tell(dispatcher.tick())
        dispatcher.end(by="Ada")
    else:
        dispatcher.leave()
    while not dispatcher.finished and recording.log is not None:
        if recording.last is not None and recording.last.event == "run_finished":
            return
        recording.tell(dispatcher.tick())


def _edge(blueprint: Blueprint, random: Random) -> Address:
    branch = random.choice(list(blueprint))
    return random.choice([edge.address for edge in branch.edges()])


_OFTEN = {"ask": 4, "resume": 3, "reset": 3, "restore": 4, "veto": 2, "take_over": 2,
          "give_back": 3, "accept": 3}  # fmt: skip
_WORDS = [word for word in COMMANDS if word not in ("answer", "end")
          for _ in range(_OFTEN.get(word, 1))]  # fmt: skip
"""The commands; those without which an event would be rare come more often. Open tasks are
answered, and a run is ended, apart."""


def _say(run: Dispatcher, blueprint: Blueprint, random: Random) -> None:
    """Say any command, with arguments that fit the blueprint."""
    word, by = random.choice(_WORDS), random.choice(["Ada", "Bo"])
    arguments = COMMANDS[word].arguments
    chosen = {name: one for name, one in arguments.items() if one.needed or random.random() < 0.5}
    edge, fact = _edge(blueprint, random), _fact(blueprint, random)
    said = drawn_arguments(chosen, random, [edge], [fact])
    shut = [one.address for one in run.status.possible if one.pruned or one.risky]
    if word == "restore" and shut:
        said = {"address": random.choice(shut)}
    elif word == "inject":
        said = {"fault": random.choice(["fail", "raise", "nothing"])}
    getattr(run, word)(**said, by=by)


def _fact(blueprint: Blueprint, random: Random) -> str:
    branch = random.choice(list(blueprint))
    return f"{branch.name}/{random.randrange(branch.num_facts)}"
