"""The commands on a native file."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell, sample

EXAMPLE = str(samples_dir() / "example.smsl")


def test_the_example_is_checked_and_routed(shell: Shell) -> None:
    answer = shell("check", EXAMPLE, "--format", "json")
    (report,) = answer.json["files"]
    assert (answer.status, report["states"], report["operations"]) == (1, 5, 5)
    errors = [one for one in report["findings"] if one["severity"] == "E"]
    assert [(one["rule"], one["line"], one["column"]) for one in errors] == [("R02", 10, 9)]
    route = shell("route", EXAMPLE, "--from", "State000", "--to", "State111", "--format", "json")
    assert route.json["operations"] == [
        "SB1/State000/Operation000",
        "SB1/State100/Operation100B",
    ]


def test_a_target_that_is_no_state_refuses_the_run(shell: Shell) -> None:
    answer = shell("run", EXAMPLE, "--world", "table", "--format", "json")
    assert (answer.status, answer.lines[-1]["reason"]) == (1, "refused")


def test_a_native_file_runs_as_the_json_file_does(shell: Shell, tmp_path: Path) -> None:
    for name in ("hfsm", "three-levels", "registration-digitization"):
        native = tmp_path / f"{name}.smsl"
        assert shell("convert", sample(name), "-o", str(native)).status == 0
        runs = [
            shell("run", file, "--world", "table", "--format", "json")
            for file in (sample(name), str(native))
        ]
        assert runs[0].out == runs[1].out
        assert runs[0].lines[-1]["reason"] == "goal_reached"


def test_all_faults_of_a_native_file_are_told(shell: Shell, tmp_path: Path) -> None:
    broken = tmp_path / "broken.smsl"
    broken.write_text("{ # NAME: A\nS [a -> S]\nT: [b => S]\n")
    answer = shell("check", str(broken))
    assert answer.status == 2
    assert answer.err.splitlines()[::2] == [
        f"{broken}:2:3: 'S' is a state, and : is missing behind its name",
        f"{broken}:3:7: -> is expected, not =>",
        f"{broken}:3:12: the State Branch 'A' is not closed: }} is missing",
    ]
