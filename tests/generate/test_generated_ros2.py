"""Generated ROS 2 packages build against stand-ins of its headers, and their node runs there."""

from __future__ import annotations

import ast
import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import yaml

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.errors import RunRefused
from smsl_studio.front.generated_code import generate_code
from smsl_studio.shipped import samples_dir
from tests.generate.compiler import COMPILER, FLAGS, needs_compiler
from tests.plugin_folder import blueprint_of

Json = Any
Drive = Callable[..., tuple[list[Json], str]]
HERE = Path(__file__).parent / "ros2"
SAMPLE = samples_dir() / "hanoi-2.json"


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory, engine: list[Path]) -> Drive:
    """Run the node of a small blueprint on a robot of which something is wrong (see drive.cpp)."""
    folder = tmp_path_factory.mktemp("package")
    generate_code(smsl.read(SAMPLE), folder, target="ros2", name="Made")
    for kind, name in (("action", "carry_out"), ("msg", "fact_value")):
        header = folder / "include" / "made" / kind / f"{name}.hpp"
        header.parent.mkdir(parents=True)
        header.write_text((HERE / f"{name}.hpp").read_text().replace("PACKAGE", "made"))
    own = [*(folder / "Made").glob("*.cpp"), *(folder / "Made" / "branches").glob("*.cpp")]
    sources = [one for one in own if one.name != "main.cpp"]
    node = [folder / "ros" / "run_node.cpp", folder / "ros" / "robot_world.cpp"]
    places = [HERE / "stand_ins", folder / "include", folder / "Made", folder / "ros"]
    words = [str(COMPILER), *FLAGS, *(f"-I{place}" for place in places)]
    program = folder / "drive"
    every = map(str, [HERE / "drive.cpp", *sources, *node, *engine])
    subprocess.run([*words, *every, "-o", str(program)], check=True)
    main = [str(folder / "ros" / "main.cpp"), "-fsyntax-only"]
    subprocess.run([*words, *main], check=True)

    def driven(wrong: str = "nothing", *more: str) -> tuple[list[Json], str]:
        done = subprocess.run(
            [str(program), wrong, *more], capture_output=True, text=True, check=True, timeout=60
        )
        return list(map(json.loads, done.stdout.splitlines())), done.stderr

    return driven


@needs_compiler
def test_the_node_reaches_the_goal_and_its_log_is_believed(drive: Drive, tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    events, _ = drive("nothing", str(log))
    assert events[-1]["reason"] == "goal_reached"
    ours = [one["operations"] for one in events if one["event"] == "committed"]
    theirs = [list(e.operations) for e in smsl.run(smsl.read(SAMPLE)).events
              if isinstance(e, smsl.runlog.events.Committed)]  # fmt: skip
    assert ours == theirs
    assert smsl.verify(log, smsl.read(SAMPLE)).doubt is None


@needs_compiler
@pytest.mark.parametrize("wrong", ["fails", "rejected", "unserved", "silent"])
def test_what_fails_holds_and_commits_nothing(wrong: str, drive: Drive) -> None:
    events, said = drive(wrong)
    assert events[-1]["reason"] == "held"
    assert not [one for one in events if one["event"] == "committed"]
    assert ("nobody serves operations/op_1b" in said) == (wrong == "unserved")
    assert ("cancelled 1" in said) == (wrong == "silent")


@needs_compiler
def test_old_facts_are_unknown_and_nothing_begins(drive: Drive) -> None:
    events, _ = drive("stale")
    assert events[-1]["reason"] == "refused"
    assert not [one for one in events if one["event"] == "operation_started"]


@needs_compiler
def test_a_node_that_is_deactivated_stops_the_robot(drive: Drive) -> None:
    events, said = drive("stopped")
    assert [one["event"] for one in events[-2:]] == ["stopped", "run_finished"]
    assert "cancelled 1" in said


def test_its_core_is_that_of_the_cpp_package(tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "three-levels.json")
    generate_code(blueprint, tmp_path / "cpp", target="cpp")
    made = generate_code(blueprint, tmp_path / "ros2", target="ros2")
    core = [one for one in made.files if one.startswith("three_levels/")]
    assert len(core) > 30
    for one in core:
        assert (tmp_path / "ros2" / one).read_bytes() == (tmp_path / "cpp" / one).read_bytes()
    assert generate_code(blueprint, tmp_path / "ros2", target="ros2", check=True).agrees


def test_names_from_outside_end_no_file(tmp_path: Path) -> None:
    """In YAML, XML, Python, and the table of the README."""
    odd = 'S"]: {} <!-- */ | é'
    header = {"INITIAL": odd, "ACTIVATING": odd, "NUM_FACTS": 0}
    blueprint = blueprint_of({odd: {"HEADER": header, odd: {odd: odd}}}, 'a"<b> & \\.json')
    licence = tmp_path / "licence.txt"
    licence.write_text("Mine <all> & --> only\n")
    generate_code(blueprint, tmp_path / "made", target="ros2", name="odd", licence=licence)
    package = ElementTree.parse(tmp_path / "made" / "package.xml").getroot()
    assert package.findtext("license") == "Mine <all> & --> only"
    told = yaml.safe_load((tmp_path / "made" / "config" / "run.yaml").read_text())
    assert told["odd"]["ros__parameters"]["goals"] == [str(Address(odd, odd))]
    yaml.safe_load((tmp_path / "made" / "config" / "dvrk.yaml").read_text())
    ast.parse((tmp_path / "made" / "launch" / "run.launch.py").read_text())


def test_what_asks_people_is_refused_with_its_address(tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "registration-people.json")
    with pytest.raises(RunRefused, match="REGISTRATION/0 shared, and the ROS 2 node asks nobody"):
        generate_code(blueprint, tmp_path, target="ros2")
