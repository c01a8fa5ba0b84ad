"""``check --world``: what a world has for a blueprint, and no look at plugins without it."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.front import equipment
from tests.cli.shell import Shell, sample
from tests.plugin_folder import LAMP, blueprint_of, write_allowed

RULES = ("--rule", "R24", "--rule", "R25", "--rule", "R26")


def test_a_world_that_has_everything_adds_nothing(shell: Shell) -> None:
    answer = shell("check", sample("hanoi-corrected"), "--world", "hanoi", *RULES)
    assert answer.status == 0
    assert answer.out.splitlines()[-1].endswith("0 errors, 0 warnings, 0 notes")


def test_operations_without_a_function_make_the_answer_no(shell: Shell) -> None:
    answer = shell("check", sample("hfsm"), "--world", "hanoi", *RULES, "--format", "json")
    found = answer.json["files"][0]["findings"]
    assert answer.status == 1
    assert ("R24", "E", "SB1/State000/Operation000") in {
        (one["rule"], one["severity"], one["address"]) for one in found
    }
    assert {one["rule"] for one in found} == {"R24", "R25"}
    assert [one["line"] for one in found] == sorted(one["line"] for one in found)


def test_without_a_world_no_plugin_is_looked_at(
    shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    def describe() -> None:
        raise AssertionError("plugins were looked at")

    monkeypatch.setattr(equipment, "describe", describe)
    assert shell("check", sample("hfsm"), *RULES).status == 0
    assert shell("check", sample("hfsm"), "--world", "table", *RULES).status == 0


BENCH = """
from dataclasses import replace
from smsl_studio.world.arms.panda import ARM
from smsl_studio.world.stations import Station

PLACES = {"Op_on": [Station("the switch", (0.5, 0.0, 0.1))],
          "Op_{other}": [Station("the lamp", (0.5, 0.1, 0.3))]}

def register(library):
    library.robot(replace(ARM, name="far", base=(-0.9, 0.0, 0.0)))

    @library.world("bench", robots=("panda", "far"))
    def build(world, blueprint, seed, robot):
        world.add(robot)

    @library.stations("bench")
    def stations(robot):
        return PLACES

    @library.sensor("lamp_{n}", fact="{n}")
    def lamp(world, n: int):
        return "0"

    @library.operation("Op_{name}")
    def act(world, name: str):
        yield
"""


def test_operations_beyond_the_reach_of_a_robot_are_errors(
    shell: Shell, home: Path, tmp_path: Path
) -> None:
    write_allowed(home, "bench", BENCH)
    file = tmp_path / "lamp.json"
    file.write_text(blueprint_of(LAMP).document.text, "utf-8")
    asked = ("check", str(file), "--world", "bench", "--rule", "R24")
    assert shell(*asked).status == shell(*asked, "--robot", "panda").status == 0
    answer = shell(*asked, "--robot", "far", "--format", "json")
    assert answer.status == 1
    words = "the robot far does not reach {} in the world bench"
    assert [(one["address"], one["message"]) for one in answer.json["files"][0]["findings"]] == [
        ("LAMP/State_0/Op_on", words.format("the switch (0.500, 0.000, 0.100 m)")),
        ("LAMP/State_0/Op_break", words.format("the lamp (0.500, 0.100, 0.300 m)")),
        ("LAMP/State_0/Op_spin", words.format("the lamp (0.500, 0.100, 0.300 m)")),
        ("LAMP/State_1/Op_off", words.format("the lamp (0.500, 0.100, 0.300 m)")),
    ]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('stations("bench")', 'stations("bank")', "there is no world 'bank' for these stations"),
        ("return PLACES", 'return {"Op_{on": []}', "Op_{on"),
        ("return PLACES", 'return {"Op_on": [1]}', "have a 'int'"),
        ("0.5, 0.0, 0.1", "float('nan'), 0.0, 0.1", "cannot be described"),
        ("0.5, 0.0, 0.1", "1e300, 0.0, 0.1", "cannot be described"),
        ("return PLACES", 'return {"Op_on": PLACES["Op_on"] * 201}', "cannot be described"),
        ("return PLACES", "return 1", "cannot be described"),
    ],
)
def test_stations_that_do_not_fit_are_a_fault_of_the_plugin(
    shell: Shell, home: Path, old: str, new: str, words: str
) -> None:
    assert old in BENCH
    write_allowed(home, "bench", BENCH.replace(old, new))
    (fault,) = shell("plugins", "--format", "json").json["faults"]
    assert words in fault["message"]


def test_a_robot_without_a_world_or_an_unknown_one_is_refused(shell: Shell) -> None:
    asked = ("check", sample("hanoi-2"), "--robot", "kuka")
    assert "--robot needs a world" in shell(*asked).err
    answer = shell(*asked, "--world", "hanoi")
    assert answer.status == 2
    assert "the world 'hanoi' has no robot 'kuka'" in answer.err
