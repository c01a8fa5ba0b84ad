"""Checkers of models find in what is written what Studio proves: spin, and a small one of ours."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ConvertError, RunRefused
from smsl_studio.shipped import samples_dir
from tests.blueprint.values import read
from tests.counts import share_of
from tests.exchange.again import random_blueprint, text_of

SAMPLES = {path.stem: path for path in sorted(samples_dir().glob("*.json"))}
WITH_START = (2, 47)
CLAIMED = ("hazard", "never")
HOLDING = {"holds": True, "fails": False}


class Model(NamedTuple):
    """A text of PRISM as read here: the start, the commands and the labels, as Python's code."""

    start: tuple[int, ...]
    variables: list[str]
    commands: list[tuple[str, dict[str, int]]]
    labels: dict[str, str]

    def steps(self, here: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        now = dict(zip(self.variables, here, strict=True))
        for guard, after in self.commands:
            if eval(guard, {"__builtins__": {}}, now):
                yield tuple({**now, **after}.values())

    def has(self, label: str, here: tuple[int, ...]) -> bool:
        now = dict(zip(self.variables, here, strict=True))
        return bool(eval(self.labels[label], {"__builtins__": {}}, now))


def model_of(text: str) -> Model:
    """A model of PRISM, of which comments are left out."""
    lines = [line.partition("//")[0].strip() for line in text.splitlines()]
    variables = [re.match(r"(\w+) : \[0\.\.(\d+)\] init (\d+);$", line) for line in lines]
    found = [one for one in variables if one]
    commands = []
    for line in lines:
        one = re.match(r"\[\w+\] (.*) -> (.*);$", line)
        if one:
            ends = re.findall(r"\((\w+)'=(\d+)\)", one[2])
            commands.append((_python(one[1]), {name: int(end) for name, end in ends}))
    labels = dict(re.findall(r'^label "(\w+)" = (.*);$', text, re.MULTILINE))
    return Model(
        tuple(int(one[3]) for one in found),
        [one[1] for one in found],
        commands,
        {name: _python(condition) for name, condition in labels.items()},
    )


def _python(condition: str) -> str:
    assert re.fullmatch(r"[\w=&|() ]+", condition)
    code = condition.replace("=", "==").replace("&", " and ").replace("|", " or ")
    return code.replace("true", "True").replace("false", "False")


class Seen(NamedTuple):
    """What a search through all configurations finds."""

    configurations: int
    deadlocks: int
    traps: int
    met: dict[str, bool]


def seen(model: Model) -> Seen:
    """Look at every configuration that can be reached, one by one."""
    after: dict[tuple[int, ...], list[tuple[int, ...]]] = {}
    waiting = [model.start]
    while waiting:
        here = waiting.pop()
        if here not in after:
            after[here] = list(model.steps(here))
            waiting += after[here]
    before: dict[tuple[int, ...], list[tuple[int, ...]]] = {}
    for here, ends in after.items():
        for end in ends:
            before.setdefault(end, []).append(here)
    home = {here for here in after if model.has("goal", here)}
    deadlocks = sum(not ends and here not in home for here, ends in after.items())
    waiting = list(home)
    while waiting:
        for one in before.get(waiting.pop(), []):
            if one not in home:
                home.add(one)
                waiting.append(one)
    met = {name: any(model.has(name, here) for here in after) for name in model.labels}
    return Seen(len(after), deadlocks, len(after) - len(home), met)


def claimed(blueprint: Blueprint) -> list[bool]:
    """Whether hazards and ``never`` hold, as Studio proves."""
    found = smsl.prove(blueprint, limit=100_000).verdicts
    return [HOLDING[one.verdict] for one in found if one.kind in CLAIMED]


def agrees(blueprint: Blueprint) -> Seen:
    """Compare what is seen in PRISM's text with ``explore`` and ``check``."""
    found = seen(model_of(text_of(blueprint, ".prism")))
    ours = smsl.explore(blueprint).ours
    assert found.configurations == ours.configurations
    assert bool(found.traps) == bool(ours.traps)
    assert [not met for name, met in found.met.items() if name != "goal"] == claimed(blueprint)
    return found


@pytest.mark.parametrize("name", SAMPLES)
def test_prism_has_the_verdicts_of_check(name: str) -> None:
    agrees(smsl.read(SAMPLES[name]))


def test_prism_has_the_verdicts_of_check_for_random_blueprints() -> None:
    tried = dead = trapped = broken = 0
    count = share_of(60)
    for seed in range(count):
        blueprint = random_blueprint(seed)
        try:
            found = agrees(blueprint)
        except ConvertError:
            with pytest.raises(RunRefused):
                smsl.explore(blueprint)
            continue
        tried += 1
        dead += bool(found.deadlocks)
        trapped += bool(found.traps)
        broken += any(met for name, met in found.met.items() if name != "goal")
    assert tried > count * 2 // 3
    assert min(dead, trapped, broken) > 0


def spin(text: str, folder: Path, *arguments: str) -> tuple[bool, int]:
    """Whether spin finds an error in a model, and how many states it stores."""
    program = shutil.which("spin")
    assert program, "./dev setup installs spin"
    (folder / "model.pml").write_text(text, "utf-8")
    command = [program, *arguments, "-m1000000", "model.pml"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    said = done.stdout + done.stderr
    errors = re.search(r"errors: (\d+)", said)
    stored = re.search(r"(\d+) states, stored", said)
    assert errors, said
    assert stored, said
    return errors[1] != "0", int(stored[1])


PLANTED = {
    "deadlock": {"A": {"HEADER": {"ACTIVATING": "State1"}, "State0": {"a": "State1", "b": "State2"},
                       "State1": {"c": "State0"}, "State2": {}}},
    "livelock": {"A": {"HEADER": {"ACTIVATING": "State1"}, "State0": {"a": "State1", "b": "State2"},
                       "State1": {"c": "State0"}, "State2": {"d": "State2"}}},
}  # fmt: skip


@pytest.mark.parametrize("name", ["hanoi-hazard", "registration-drilling"])
def test_spin_has_the_verdicts_of_check(name: str, tmp_path: Path) -> None:
    spin_agrees(smsl.read(SAMPLES[name]), tmp_path)


@pytest.mark.parametrize("name", PLANTED)
def test_spin_finds_a_planted_deadlock(name: str, tmp_path: Path) -> None:
    blueprint = read(PLANTED[name])
    error, _ = spin(text_of(blueprint, ".pml"), tmp_path, "-run")
    assert error == (name == "deadlock")
    assert smsl.explore(blueprint).ours.traps


@pytest.mark.parametrize("seed", WITH_START)
def test_spin_has_the_verdicts_of_check_for_random_blueprints(seed: int, tmp_path: Path) -> None:
    spin_agrees(random_blueprint(seed), tmp_path)


def spin_agrees(blueprint: Blueprint, folder: Path) -> None:
    """Compare spin's verdicts with ours, and with what is seen in PRISM's text."""
    text = text_of(blueprint, ".pml")
    found = seen(model_of(text_of(blueprint, ".prism")))
    error, stored = spin(text, folder, "-run")
    assert error == bool(found.deadlocks)
    if not error:
        # Each goal has two states more: the process has left the loop, and it has ended.
        model = model_of(text_of(blueprint, ".prism"))
        assert stored >= found.configurations + 2 * found.met["goal"]
        assert model.start
    names = re.findall(r"^#ifdef (\w+)$", text, re.MULTILINE)
    answers = [not spin(text, folder, f"-D{one}", "-run", "-E")[0] for one in names]
    assert answers == claimed(blueprint)


def test_what_is_too_large_or_has_no_start_is_refused() -> None:
    many: dict[str, dict[str, str]] = {f"State{number:03}": {} for number in range(400)}
    for state in many:
        many[state] = {f"to{other}": other for other in list(many)[:300]}
    with pytest.raises(ConvertError, match="100,000 commands"):
        text_of(read({"A": many}), ".pml")
    sub = {"B": {"HEADER": {"ACTIVATING": "State0"}, "State0": {}}}
    base = {"A": {"HEADER": {"SUB_SBS": {"B": 0}}, "State0": {}, "State1": {}}}
    with pytest.raises(ConvertError, match="no configuration to start in"):
        text_of(read({**base, **sub}), ".prism")


def test_no_name_ends_a_comment() -> None:
    blueprint = read({"*/ init {": {"a*/b\n": {"// */": "a*/b\n"}, "\\": {}}})
    text = text_of(blueprint, ".pml")
    assert all(line.count("*/") == line.count("/*") for line in text.splitlines())
    assert seen(model_of(text_of(blueprint, ".prism"))).configurations == 1
