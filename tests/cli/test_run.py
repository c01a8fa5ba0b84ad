"""``run`` and ``sweep`` on the table: reasons, exit statuses, streams, logs and guards."""

from __future__ import annotations

import hashlib
import io
import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.grammar.log_reader import read_log
from tests.cli.shell import Answer, Shell, sample
from tests.plugin_folder import LAMP, LAMP_PLUGIN, write_allowed

TABLE = ("--world", "table", "--format", "json")


def _write(tmp_path: Path, values: dict[str, Any]) -> str:
    path = tmp_path / "blueprint.json"
    path.write_text(json.dumps(values, indent=4), "utf-8")
    return str(path)


def _carried_out(answer: Answer) -> list[str]:
    return [e["address"] for e in answer.lines if e["event"] == "operation_started"]


def _end(answer: Answer) -> tuple[int, str]:
    assert answer.lines[-1]["event"] == "run_finished"
    return answer.status, answer.lines[-1]["reason"]


def test_hfsm_reaches_its_goal_with_its_sub_sb(shell: Shell) -> None:
    answer = shell("run", sample("hfsm"), *TABLE)
    assert _end(answer) == (0, "goal_reached")
    assert answer.lines[-1]["configuration"] == {"SB1": "State111", "SB2": "State1"}


def test_hfsm_goes_through_the_rise(shell: Shell) -> None:
    answer = shell("run", sample("hfsm"), *TABLE, "--avoid", "SB1/State100/Operation100B")
    assert _end(answer) == (0, "goal_reached")
    assert "SB1/State100/Operation100A" in _carried_out(answer)
    assert "SB2/State0/Operation0" in _carried_out(answer)


def test_hfsm_goes_through_the_fall(shell: Shell) -> None:
    ends = ("--goal", "SB1/State100", "--start", "SB1/State110")
    answer = shell("run", sample("hfsm"), *TABLE, *ends)
    assert _end(answer) == (0, "goal_reached")
    assert _carried_out(answer) == ["SB1/State110/Operation110A", "SB2/State1/Operation1"]
    assert answer.lines[-1]["configuration"] == {"SB1": "State100", "SB2": "State0"}


def test_registration_reaches_its_goal(shell: Shell) -> None:
    answer = shell("run", sample("registration"), *TABLE)
    assert _end(answer) == (0, "goal_reached")
    assert answer.lines[-1]["configuration"] == {"REGISTRATION": "State_1111"}


def _every_edge(name: str) -> list[str]:
    table = json.loads(Path(sample("registration")).read_text("utf-8"))["REGISTRATION"]
    edges = [f"{state}/{name}" for state in table if name in table[state]]
    return [part for edge in edges for part in ("--avoid", edge)]


@pytest.mark.parametrize("avoid", [_every_edge("Op_UsePrevReg"), ["--avoid", "Op_UsePrevReg"]])
def test_without_a_previous_registration_it_plans_digitises_registers(
    shell: Shell, avoid: list[str]
) -> None:
    answer = shell("run", sample("registration"), *TABLE, *avoid)
    assert _end(answer) == (0, "goal_reached")
    names = [address.rpartition("/")[2] for address in _carried_out(answer)]
    steps = [n for n in names if n in ("Op_PlanLandmarks", "Op_DigitizeLandmarks", "Op_Register")]
    assert steps == ["Op_PlanLandmarks", "Op_DigitizeLandmarks", "Op_Register"]


def test_three_levels_reach_their_goal(shell: Shell) -> None:
    answer = shell("run", sample("three-levels"), *TABLE)
    assert _end(answer) == (0, "goal_reached")
    states = {"SURGERY": "State111", "REGISTRATION": "State111", "DIGITIZATION": "State11"}
    assert answer.lines[-1]["configuration"] == states


def test_three_roots_reach_their_goals_in_order(shell: Shell) -> None:
    answer = shell("run", sample("three-roots"), *TABLE)
    assert _end(answer) == (0, "goal_reached")
    reached = [e["goal"] for e in answer.lines if e["event"] == "goal_reached"]
    assert reached == ["REGISTRATION/State111", "TOOLPLAN/State11", "ROBOT/State11"]


def test_with_goals_only_the_roots_named_move(shell: Shell) -> None:
    goals = ("--goal", "TOOLPLAN/State11", "--goal", "DIGITIZATION/State0")
    answer = shell("run", sample("three-roots"), *TABLE, *goals)
    assert _end(answer) == (0, "goal_reached")
    assert {address.partition("/")[0] for address in _carried_out(answer)} == {"TOOLPLAN"}


def test_equal_runs_print_equal_bytes_in_both_hosts(shell: Shell) -> None:
    first = shell("run", sample("hfsm"), *TABLE)
    assert shell("run", sample("hfsm"), *TABLE).out == first.out
    assert shell("run", sample("hfsm"), *TABLE, "--host", "process").out == first.out


def test_the_log_has_a_header_and_what_was_printed(shell: Shell, tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    answer = shell("run", sample("hfsm"), *TABLE, "--seed", "3", "--log", str(log))
    found = read_log(log, COMMANDS)
    assert [one.text for one in found.records] == answer.out.splitlines()
    assert found.doubt is None
    assert (found.header["world"], found.header["seed"]) == ("table", 3)
    digests = shell("digest", sample("hfsm"), "--format", "json").json["files"][0]
    file = hashlib.sha256(Path(digests.pop("file")).read_bytes()).hexdigest()
    assert found.header["digests"] == {"file": file, **digests}
    assert (found.header["start"], found.header["policy"]) == ([], None)


def test_the_log_says_what_was_asked_for(shell: Shell, tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    asked = ("--start", "State110", "--goal", "SB1/State100", "--avoid", "SB1/State100")
    shell("run", sample("hfsm"), *TABLE, *asked, "--on-mismatch", "adopt", "--log", str(log))
    header = read_log(log, COMMANDS).header
    assert (header["start"], header["goals"]) == (["SB1/State110"], ["SB1/State100"])
    assert header["avoid"][0] == "SB1/State100/Operation100A"
    assert (header["on_mismatch"], header["host"]) == ("adopt", "local")


def test_the_log_says_what_people_call_what_it_tells_of(shell: Shell, tmp_path: Path) -> None:
    """So that its account needs no blueprint."""
    log, page = tmp_path / "run.jsonl", tmp_path / "run.html"
    shell("run", sample("registration-failures"), *TABLE, "--log", str(log))
    names = read_log(log, COMMANDS).header["names"]
    assert "Registered" in names["facts"].values()
    assert names["operations"]
    assert shell("replay", str(log), "-o", str(page)).status == 0
    assert "Landmarks planned of REGISTRATION reads 1" in page.read_text("utf-8")
    many = tmp_path / "many.json"
    facts = {str(number): {"name": "x" * 300} for number in range(1500)}
    state: dict[str, object] = {f"State_{'0' * 1500}": {}}
    many.write_text(json.dumps({"SB": {"_facts": facts, "HEADER": {"NUM_FACTS": 1500}, **state}}))
    shell("run", str(many), *TABLE, "--log", str(tmp_path / "many.jsonl"))
    kept = read_log(tmp_path / "many.jsonl", COMMANDS).header["names"]["facts"]
    assert len(kept) == 1000
    assert set(kept.values()) == {"x" * 200}


@pytest.mark.parametrize("file", ["wrong", "hfsm"])
def test_a_refused_run_is_in_the_log_too(shell: Shell, tmp_path: Path, file: str) -> None:
    """Refused by a finding, and by a world that it does not suit."""
    path = tmp_path / "wrong.json"
    path.write_text('{"SB1": {"State_0": {"Op_go": "State_9"}}}')
    log = tmp_path / "run.jsonl"
    given = str(path) if file == "wrong" else sample(file)
    answer = shell("run", given, "--world", "hanoi", "--format", "json", "--log", str(log))
    assert _end(answer) == (1, "refused")
    found = read_log(log, COMMANDS)
    assert [one.text for one in found.records] == answer.out.splitlines()
    assert found.doubt is None


def test_a_log_that_cannot_be_written_refuses_the_run(shell: Shell, tmp_path: Path) -> None:
    answer = shell("run", sample("hfsm"), *TABLE, "--log", str(tmp_path / "no" / "log"))
    assert _end(answer) == (1, "refused")
    assert "cannot be written" in answer.lines[-1]["sentence"]
    assert len(answer.lines) == 1


def test_a_record_is_never_written_over(shell: Shell, tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    log.touch()
    assert shell("run", sample("hfsm"), *TABLE, "--log", str(log)).status == 0
    first = log.read_bytes()
    answer = shell("run", sample("hfsm"), *TABLE, "--log", str(log))
    assert (answer.status, answer.out) == (2, "")
    assert "Name a new file" in answer.err
    assert log.read_bytes() == first


def test_a_script_supervises_the_run(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = [
        {"when": "SB1/State100", "do": "prune", "address": "State100/Operation100B", "reason": "x"},
        {"at": 99, "do": "stop"},
    ]
    script = tmp_path / "script.jsonl"
    script.write_text("\n".join(json.dumps(line) for line in lines))
    answer = shell("run", sample("hfsm"), *TABLE, "--script", str(script))
    assert _end(answer) == (0, "goal_reached")
    assert "SB1/State100/Operation100A" in _carried_out(answer)
    assert answer.err.splitlines()[1:] == [f"{script}:2:1: its moment never came: stop"]
    monkeypatch.setattr("sys.stdin", io.StringIO(script.read_text()))
    assert shell("run", sample("hfsm"), *TABLE, "--script", "-").out == answer.out


def test_what_was_refused_and_what_stood_in_the_way_is_said(shell: Shell, tmp_path: Path) -> None:
    cut = [
        {"do": "prune", "address": f"State_aaa/{name}", "reason": "broken"}
        for name in ("Op_1b", "Op_1c")
    ]
    script = tmp_path / "script.jsonl"
    script.write_text("\n".join(json.dumps(line) for line in [{"do": "reset"}, *cut]))
    for form in ("text", "json"):
        more = ("--script", str(script), "--format", form)
        answer = shell("run", sample("hanoi-corrected"), "--world", "table", *more)
        assert answer.status == 1
        said = answer.err.splitlines()
        assert any(line.startswith(f"{script}: refused at 0.000 s: reset: ") for line in said)
        assert "    SB1/State_aaa/Op_1b is pruned: broken" in said
        assert "    SB1/State_aaa/Op_1c is pruned: broken" in said


def test_a_wrong_script_is_refused_before_anything_runs(shell: Shell, tmp_path: Path) -> None:
    script = tmp_path / "script.jsonl"
    script.write_text('{"do": "pause"}\n{"do": "paus"}\n{"do": "ask", "address": "State9/Op"}\n')
    log = tmp_path / "log"
    more = ("--script", str(script), "--log", str(log))
    answer = shell("run", sample("hfsm"), *TABLE, *more)
    assert (answer.status, answer.out) == (2, "")
    assert f"{script}:2:8: 'paus' is no command\nDid you mean pause?\n" in answer.err
    assert f"{script}:3:26: " in answer.err
    assert not log.exists()
    assert shell("run", "-", *TABLE, "--script", "-").status == 2
    assert shell("run", sample("hfsm"), *TABLE, "--script", "none").status == 2


def test_the_text_tells_the_same_story(shell: Shell) -> None:
    answer = shell("run", sample("hfsm"), "--world", "table")
    assert answer.status == 0
    lines = answer.out.splitlines()
    assert lines[0].endswith("goals SB1/State111, behaviour " + lines[0].rpartition(" ")[2])
    assert lines[-1] == (
        "    0.200 s  run finished: goal_reached, 3 operations. SB1/State111 holds."
    )
    assert answer.err == (
        "UNINSPECTED: no inspection record stands behind this blueprint; simulation only\n"
    )


def test_annotations_that_do_not_count_are_said(shell: Shell, tmp_path: Path) -> None:
    note = {"_operations": {"Op": {"confirm": "nurse"}}}
    file = _write(tmp_path, {"SB1": {**note, "State_0": {"Op": "State_1"}, "State_1": {}}})
    answer = shell("run", file, *TABLE)
    assert answer.status == 0
    assert f"{file}:" in answer.err.splitlines()[0]
    assert "Op in _operations is not understood: confirm" in answer.err.splitlines()[0]


def test_the_text_says_what_belongs_to_a_fault_and_where_states_are(
    shell: Shell, tmp_path: Path
) -> None:
    script = tmp_path / "script.jsonl"
    script.write_text('{"do": "inject", "fault": "set", "fact": "SB1/1", "value": "b"}\n')
    out = shell("run", sample("hanoi-corrected"), "--world", "table", "--script", str(script)).out
    assert "start SB1/State_aaa, goals" in out
    assert "fault injected: fault set, parameters fact SB1/1, value b\n" in out


@pytest.mark.parametrize(
    ("branch", "rule"),
    [
        ({"HEADER": {}, "State_0": {"Op": "State_9"}, "State_1": {}}, "R02"),
        ({"HEADER": {"INITIAL": "State_9"}, "State_0": {"Op": "State_0"}}, "R03"),
        ({"HEADER": {"SUB_SBS": {"NOBODY": 0}}, "State_0": {}, "State_1": {}}, "R07"),
        ({"HEADER": {"SUB_SBS": {"SB1": 0}}, "State_0": {}, "State_1": {}}, "R08"),
    ],
)
def test_findings_that_leave_nothing_to_run_refuse_it(
    shell: Shell, tmp_path: Path, branch: dict[str, Any], rule: str
) -> None:
    answer = shell("run", _write(tmp_path, {"SB1": branch}), *TABLE)
    assert _end(answer) == (1, "refused")
    assert answer.lines[-1]["sentence"].startswith(f"{rule} SB1")


def test_a_key_written_twice_refuses_a_run(shell: Shell, tmp_path: Path) -> None:
    path = tmp_path / "b.json"
    path.write_text('{"SB1": {"State_0": {"Op": "State_1", "Op": "State_0"}, "State_1": {}}}')
    answer = shell("run", str(path), *TABLE)
    assert _end(answer) == (1, "refused")
    assert "R01" in answer.lines[-1]["sentence"]


def test_a_sub_sb_that_cannot_change_refuses_a_run(shell: Shell, tmp_path: Path) -> None:
    values = {
        "SB1": {"HEADER": {"SUB_SBS": {"SB2": 0}}, "State_0": {"Op": "State_1"}, "State_1": {}},
        "SB2": {"HEADER": {"INITIAL": "State_1", "ACTIVATING": "State_1"}, "State_1": {}},
    }
    answer = shell("run", _write(tmp_path, values), *TABLE)
    assert _end(answer) == (1, "refused")
    assert "R13" in answer.lines[-1]["sentence"]
    assert "SB2" in answer.lines[-1]["sentence"]


def test_other_findings_refuse_nothing(shell: Shell) -> None:
    assert _end(shell("run", sample("hanoi"), *TABLE)) == (0, "goal_reached")


def test_no_route_is_no(shell: Shell) -> None:
    answer = shell("run", sample("hfsm"), *TABLE, "--start", "State111", "--goal", "State000")
    assert _end(answer) == (1, "no_route")


@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["--world", "tabel"], "Did you mean table?"),
        (["--world", "table", "--goal", "State112"], "Did you mean State11"),
        (["--world", "table", "--goal", "SB1"], "SB1 is no state"),
        (["--world", "table", "--goal", "SB1/State111/Op"], "there is no operation 'Op'"),
        (["--world", "table", "--start", "State000", "--start", "State100"], "two starts"),
        (["--world", "table", "--avoid", "SB1/State100/Operation100C"], "Operation100"),
        (["--world", "table", "--avoid", "SB1"], "no operation"),
        (["--world", "table", "--speed", "fast"], "the speed is 'fast'"),
        (["--world", "table", "--speed", "0"], "the speed is '0'"),
        (["--world", "table", "--seed", "x"], "invalid int"),
        (["--world", "table", "--host", "far"], "invalid choice"),
        ([], "--world"),
    ],
)
def test_wrong_usage_is_told_and_runs_nothing(shell: Shell, argv: list[str], words: str) -> None:
    answer = shell("run", sample("hfsm"), *argv)
    assert (answer.status, answer.out) == (2, "")
    assert words in answer.err


@pytest.fixture
def lamp(tmp_path: Path, home: Path) -> str:
    write_allowed(home, "lamp", LAMP_PLUGIN)
    return _write(tmp_path, LAMP)


def test_a_plugins_world_runs_and_its_prints_are_no_data(shell: Shell, lamp: str) -> None:
    others = [f"--avoid=State_0/{name}" for name in ("Op_break", "Op_spin")]
    answer = shell("run", lamp, "--world", "lamp", "--format", "json", *others)
    assert _end(answer) == (0, "goal_reached"), "what a child prints is not in its answers"
    answer = shell("run", lamp, "--world", "lamp", "--format", "json", "--host", "local", *others)
    assert _end(answer) == (0, "goal_reached")
    assert "switching" in answer.err


def test_library_code_that_crashes_its_process_ends_the_run_and_not_the_program(
    shell: Shell, tmp_path: Path, home: Path
) -> None:
    crash = LAMP_PLUGIN.replace('print("switching")', "import ctypes; ctypes.string_at(0)")
    assert crash != LAMP_PLUGIN
    write_allowed(home, "lamp", crash)
    others = [f"--avoid=State_0/{name}" for name in ("Op_break", "Op_spin")]
    run = (_write(tmp_path, LAMP), "--world", "lamp", "--format", "json", *others)
    answer = shell("run", *run)
    assert _end(answer) == (1, "failed")
    assert "SIGSEGV" in answer.err


def test_a_binding_that_does_not_fit_is_said_with_its_place(shell: Shell, lamp: str) -> None:
    beside = Path(lamp).with_suffix(".toml")
    beside.write_text('[world.lamp.operations]\n"Op_on" = {function = "lamp.swich"}\n')
    answer = shell("run", lamp, "--world", "lamp", "--avoid=Op_break", "--avoid=Op_spin")
    assert answer.status == 1
    assert f"{beside}:2:2: LAMP/State_0/Op_on is not bound: " in answer.err
    assert "Did you mean lamp.switch?" in answer.err


def test_an_operation_that_raises_is_held_with_its_line(shell: Shell, lamp: str) -> None:
    others = [f"--avoid=State_0/{name}" for name in ("Op_on", "Op_spin")]
    answer = shell("run", lamp, "--world", "lamp", "--format", "json", *others)
    assert _end(answer) == (1, "held")
    ended = next(e for e in answer.lines if e["event"] == "operation_ended")
    assert ended["outcome"] == "raised"
    assert "(lamp/plugin.py:" in ended["message"]


def test_a_sweep_has_a_line_an_edge_and_a_summary(shell: Shell) -> None:
    answer = shell("sweep", sample("hfsm"), *TABLE)
    *edges, last = answer.lines
    assert answer.status == 0
    assert last == {"event": "sweep_finished", "t": 0.4, "edges": 7, "passed": 7, "failed": []}
    assert all(e["passed"] and e["source"] == e["target"] == "true" for e in edges)
    assert [e["address"] for e in edges][-2:] == ["SB2/State0/Operation0", "SB2/State1/Operation1"]


def test_a_sweep_names_what_fails_and_why(shell: Shell, lamp: str) -> None:
    values = json.loads(Path(lamp).read_text())
    del values["LAMP"]["State_0"]["Op_spin"]
    values["LAMP"]["State_1"] |= {"Op_nowhere": "State_7", "Op_on": "State_0"}
    Path(lamp).write_text(json.dumps(values))
    answer = shell("sweep", lamp, "--world", "lamp", "--format", "json")
    assert answer.status == 1
    swept = {e["address"]: e for e in answer.lines if e["event"] == "edge_swept"}
    assert [e["passed"] for e in swept.values()] == [True, False, True, False, False]
    assert "the bulb broke (lamp/plugin.py" in swept["LAMP/State_0/Op_break"]["sentence"]
    assert "its target State_7 is no state" in swept["LAMP/State_1/Op_nowhere"]["sentence"]
    wrong = swept["LAMP/State_1/Op_on"]
    assert (wrong["source"], wrong["target"]) == ("true", "false")
    assert "reads 1, not 0" in wrong["sentence"]
    assert answer.lines[-1]["failed"] == [
        address for address, event in swept.items() if not event["passed"]
    ]
    text = shell("sweep", lamp, "--world", "lamp")
    assert text.out.splitlines()[-1] == "2 of 5 edges passed"


@pytest.mark.parametrize("name", ["three-levels", "three-roots", "registration-digitization"])
def test_a_sweep_finds_a_start_for_every_edge(shell: Shell, name: str) -> None:
    answer = shell("sweep", sample(name), *TABLE)
    assert answer.lines[-1]["failed"] == []
    assert answer.status == 0
