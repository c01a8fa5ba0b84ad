"""``generate rules``: what it writes and prints, and its exit status."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.front.approval_badge import approval_words
from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell
from tests.front.test_physics import BOARD, SWITCHES
from tests.plugin_folder import write_plugin

RIVER = str(samples_dir() / "rules" / "river.toml")


@pytest.mark.parametrize("suffix", ["json", "smsl", "yaml"])
def test_each_form_says_the_same(shell: Shell, tmp_path: Path, suffix: str) -> None:
    out = tmp_path / f"river.{suffix}"
    answer = shell("generate", "rules", RIVER, "-o", str(out))
    assert (answer.status, answer.err) == (0, "")
    assert "40 states, 92 operations" in answer.out
    assert (
        smsl.digest(smsl.read(out)).meaning
        == smsl.digest(smsl.generate_rules(RIVER).blueprint).meaning
    )
    assert shell("check", str(out)).status == 0


def test_a_goal_out_of_reach_is_a_no(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "stuck.toml"
    file.write_text(
        'facts = [{name = "a", values = ["0", "1"]}]\nstart = ["0"]\ngoal = ["1"]\n'
        '[[rule]]\noperation = "stay"\ncases = [{set = {}}]\n'
    )
    out = tmp_path / "stuck.json"
    answer = shell("generate", "rules", str(file), "-o", str(out), "--format", "json")
    assert answer.status == 1
    assert answer.json == {"states": 1, "operations": 1, "goal": False}
    assert "the goal cannot be reached" in answer.err
    assert out.exists()


def test_a_bound_keeps_what_was_reached(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "river.json"
    words = ("generate", "rules", RIVER, "-o", str(out), "--limit")
    answer = shell(*words, "7", "--format", "json")
    assert answer.status == 1
    assert answer.json["states"] == 7
    assert "the rules reach more than these 7 states" in answer.err
    kept = smsl.read(out)
    assert kept.fields["_origin"]["whole"] is False
    assert kept.operation_count == answer.json["operations"] > 0
    assert shell(*words, "40").status == 0
    assert "whole" not in smsl.read(out).fields["_origin"]
    assert shell("generate", "pddl", "a", "b", "-o", str(out), "--limit", "3").status == 2


def test_wrong_rules_have_a_place(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "wrong.toml"
    file.write_text("facts = 3\n")
    answer = shell("generate", "rules", str(file), "-o", str(tmp_path / "x.json"))
    assert answer.status == 2
    assert answer.err.startswith(f"{file}:1:1: ")
    assert not (tmp_path / "x.json").exists()


def test_a_planning_problem_becomes_a_blueprint(shell: Shell, tmp_path: Path) -> None:
    pddl, out = samples_dir() / "pddl", tmp_path / "ward.json"
    files = str(pddl / "ward.pddl"), str(pddl / "ward-4.pddl")
    answer = shell("generate", "pddl", *files, "-o", str(out), "--format", "json")
    assert answer.status == 0
    assert answer.json == {"states": 38, "operations": 77, "goal": True}
    first = out.read_bytes()
    assert shell("check", str(out)).status == 0
    assert shell("generate", "pddl", *files, "-o", str(out)).status == 0
    assert out.read_bytes() == first
    route = shell("route", str(out), "--from", "State_0", "--to", "State_30", "--format", "json")
    assert route.json["cost"] == 28


def test_a_problem_without_a_way_and_one_that_does_not_fit(shell: Shell, tmp_path: Path) -> None:
    pddl, problem = samples_dir() / "pddl", tmp_path / "p.pddl"
    text = (pddl / "trays-3.pddl").read_text().replace("(on scalpels clamps)", "(on clamps clamps)")
    problem.write_text(text)
    out = str(tmp_path / "x.json")
    stuck = shell("generate", "pddl", str(pddl / "trays.pddl"), str(problem), "-o", out)
    assert stuck.status == 1
    assert "the goal cannot be reached in this problem" in stuck.err
    other = shell("generate", "pddl", str(pddl / "lamps.pddl"), str(problem), "-o", out)
    assert other.status == 2
    assert other.err.startswith(f"{problem}:2:3: the problem is of another domain")
    assert shell("generate", "pddl", str(problem), "-o", out).status == 2
    assert shell("generate", "rules", "-o", out).status == 2


def test_what_is_generated_is_marked_until_a_record_covers_it(shell: Shell, tmp_path: Path) -> None:
    out, plain = tmp_path / "made.json", tmp_path / "plain.json"
    assert shell("generate", "rules", RIVER, "-o", str(out)).status == 0
    told = shell("run", str(out), "--world", "table")
    assert told.status == 0
    assert "GENERATED, NOT INSPECTED" in told.err
    assert approval_words(smsl.read(out)).words == "Generated, not inspected"
    values = json.loads(out.read_text())
    origin = values.pop("_origin")
    assert origin["from"] == "river.toml"
    plain.write_text(json.dumps(values))
    assert approval_words(smsl.read(plain)).words == "Uninspected"
    assert smsl.digest(smsl.read(out)).behaviour == smsl.digest(smsl.read(plain)).behaviour
    assert "UNINSPECTED" in shell("run", str(plain), "--world", "table").err


def test_physics_is_asked_with_a_world_and_a_start(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_plugin(tmp_path / "plugins", "switches", SWITCHES)
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(tmp_path / "plugins"))
    board, out = tmp_path / "board.json", tmp_path / "out.json"
    board.write_text(json.dumps(BOARD))
    words = ("generate", "explore", "--world", "switches", "--start", str(board), "-o", str(out))
    answer = shell(*words, "--against", str(board), "--format", "json")
    assert answer.status == 1, answer.err
    assert answer.json == {
        "edges": 6, "missing": ["BOARD/State_00/Op_21"], "false": ["BOARD/State_01/Op_11"],
    }  # fmt: skip
    again = shell(*words, "--format", "json")
    assert (again.status, again.json) == (0, {"states": 4, "operations": 6, "goal": True})
    assert shell(*words, "--against", str(out)).status == 2
    same = tmp_path / "same.json"
    same.write_bytes(out.read_bytes())
    assert shell(*words, "--against", str(same)).out == "6 edges\n"
    assert shell(*words, "--limit", "2").status == 1
    assert shell(*words, "--repeats", "0").status == 2
    assert "--rates needs several attempts" in shell(*words, "--rates").err
    assert shell(*words, "--rates", "--repeats", "2").status == 0
    assert shell("generate", "explore", "--world", "switches", "-o", str(out)).status == 2
    assert shell("generate", "rules", RIVER, "--world", "table", "-o", str(out)).status == 2
