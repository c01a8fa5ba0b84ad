"""``generate code``: what it writes, keeps and refuses, and that it runs without Studio."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.shell import Shell, sample

RUN = "import runpy, sys; sys.path.insert(0, '.'); sys.argv = [sys.argv[1], *sys.argv[2:]]; "
RUN += "runpy.run_module(sys.argv[0], run_name='__main__', alter_sys=True)"
LONG = "x" * 10_000
NAMES = ("class", "1abc", "😀", "a b", "a-b", 'q"""uote', "back\\slash", "{{ x }}", "a/b", LONG,
         f"{LONG[1:]}y", "</yours>", "\u202eevil", "__init__")  # fmt: skip


def _text(folder: Path) -> dict[str, bytes]:
    return {one.name: one.read_bytes() for one in sorted(folder.rglob("*.*")) if one.is_file()}


def _run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a generated package with nothing of Studio in reach."""
    call = [sys.executable, "-I", "-S", "-c", RUN, *words]
    return subprocess.run(call, cwd=folder, capture_output=True, text=True, check=False)


def test_it_runs_without_anything_installed(shell: Shell, tmp_path: Path) -> None:
    answer = shell("generate", "code", sample("three-levels"), "-o", str(tmp_path / "made"))
    assert (answer.status, answer.err) == (0, "")
    goal = ["--goal", "REGISTRATION/State111"]
    done = _run(tmp_path / "made", "three_levels", "run", *goal, "--log", "run.jsonl")
    assert (done.returncode, done.stderr) == (0, "")
    log = str(tmp_path / "made" / "run.jsonl")
    checked = shell("replay", log, "--verify", "--blueprint", sample("three-levels"))
    assert checked.status == 0


@pytest.mark.parametrize(
    "words", [["--goal", "SB1/nowhere"], ["--script", "none"], ["--seed", "x"]]
)
def test_wrong_words_are_2(shell: Shell, tmp_path: Path, words: list[str]) -> None:
    shell("generate", "code", sample("hanoi-2"), "-o", str(tmp_path))
    done = _run(tmp_path, "hanoi_2", "run", *words)
    assert done.returncode == 2
    assert done.stderr
    assert "Traceback" not in done.stderr


def test_equal_inputs_give_equal_bytes_anywhere(shell: Shell, tmp_path: Path) -> None:
    for name in ("one", "two"):
        copy = tmp_path / name / "hanoi-2.json"
        copy.parent.mkdir()
        copy.write_bytes(Path(sample("hanoi-2")).read_bytes())
        shell("generate", "code", str(copy), "-o", str(tmp_path / name / "made"))
    assert _text(tmp_path / "one" / "made") == _text(tmp_path / "two" / "made")


def test_what_people_have_written_stays(shell: Shell, tmp_path: Path) -> None:
    shell("generate", "code", sample("hanoi-2"), "-o", str(tmp_path))
    file = tmp_path / "hanoi_2" / "operations.py"
    own = file.read_text().replace(
        "    return world.carry", "    print(edge)\n    return world.carry"
    )
    file.write_text(own)
    answer = shell("generate", "code", sample("hanoi-2"), "-o", str(tmp_path), "--format", "json")
    assert answer.status == 0
    assert answer.json["kept"]
    assert file.read_text() == own
    assert shell("generate", "code", sample("hanoi-2"), "-o", str(tmp_path), "--check").status == 0
    done = _run(tmp_path, "hanoi_2", "run")
    assert [line for line in done.stdout.splitlines() if line.startswith("SB1/State_aa/")]


def test_a_part_without_a_place_is_refused_with_its_line(shell: Shell, tmp_path: Path) -> None:
    shell("generate", "code", sample("hanoi-2"), "-o", str(tmp_path))
    file = tmp_path / "hanoi_2" / "operations.py"
    file.write_text(file.read_text() + "    # <yours: SB1/Gone>\n    pass\n    # </yours>\n")
    line = len(file.read_text().splitlines()) - 2
    answer = shell("generate", "code", sample("hanoi-2"), "-o", str(tmp_path))
    assert answer.status == 2
    assert f"{file}:{line}:1: the blueprint has no SB1/Gone any more" in answer.err


def test_check_says_that_code_and_blueprint_differ(shell: Shell, tmp_path: Path) -> None:
    values = json.loads(Path(sample("hanoi-2")).read_text())
    blueprint = tmp_path / "hanoi-2.json"
    blueprint.write_text(json.dumps(values))
    made = str(tmp_path / "made")
    assert shell("generate", "code", str(blueprint), "-o", made, "--check").status == 1
    assert not (tmp_path / "made").exists()
    shell("generate", "code", str(blueprint), "-o", made)
    values["SB1"]["_operations"] = {"Op_1b": {"cost": 2}}
    blueprint.write_text(json.dumps(values))
    answer = shell("generate", "code", str(blueprint), "-o", made, "--check", "--format", "json")
    assert answer.status == 1
    assert "hanoi_2/branches/sb1.py" in answer.json["changed"]


def test_a_file_of_somebody_else_is_not_replaced(shell: Shell, tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("my own words\n")
    answer = shell("generate", "code", sample("hanoi-2"), "-o", str(tmp_path))
    assert answer.status == 2
    assert "README.md:1:1: this file was not generated" in answer.err
    assert [one.name for one in tmp_path.iterdir()] == ["README.md"]


def test_hostile_names(shell: Shell, tmp_path: Path) -> None:
    states = [f"State_{number:02d}" for number in range(len(NAMES))]
    table = {
        state: {NAMES[at]: states[(at + 1) % len(states)], NAMES[at - 3]: state}
        for at, state in enumerate(states)
    }
    title = {"title": 'a "title" """ with \\ and {{ x }}'}
    branch = {"HEADER": {"NUM_FACTS": 1}, "_operations": {"a b": title}, **table}
    blueprint = tmp_path / "class.json"
    names = ("class", 'S"B', "😀", "dsfo", "branches", "json", "a~b", "1")
    blueprint.write_text(json.dumps(dict.fromkeys(names, branch)))
    made = tmp_path / "made"
    assert shell("generate", "code", str(blueprint), "-o", str(made)).status == 0
    done = _run(made, "class", "run", "--log", "run.jsonl")
    assert (done.returncode, done.stderr) == (0, "")
    log = str(made / "run.jsonl")
    assert shell("replay", log, "--verify", "--blueprint", str(blueprint)).status == 0


def test_what_is_not_generated_is_named(shell: Shell, tmp_path: Path) -> None:
    answer = shell("generate", "code", sample("hanoi-tower"), "-o", str(tmp_path))
    assert answer.status == 1
    assert "TOWER/State_aaa/TowerToB runs a blueprint of its own" in answer.err
    assert not list(tmp_path.iterdir())


def test_bindings_name_the_functions(shell: Shell, tmp_path: Path) -> None:
    bindings = tmp_path / "bindings.toml"
    bindings.write_text(
        '[world.table.operations]\n"Op_1b" = {function = "arm.move", disk = 1, peg = "b"}\n'
        '"Op_1c" = {function = "arm.move", disk = 1, peg = "c"}\n'
    )
    words = ("generate", "code", sample("hanoi-2"), "-o", str(tmp_path / "made"))
    assert shell(*words, "--bindings", str(bindings)).status == 0
    text = (tmp_path / "made" / "hanoi_2" / "operations.py").read_text()
    assert "def arm_move(world: Any, edge: Edge, *, disk: int, peg: str) -> Any:" in text
    assert _run(tmp_path / "made", "hanoi_2", "run").returncode == 0
    bindings.write_text('[world.table.operations]\n"Op_9z" = {function = "arm.move"}\n')
    answer = shell(*words, "--bindings", str(bindings))
    assert answer.status == 2
    assert "the blueprint has no operation 'Op_9z'" in answer.err


def test_the_licence_stands_at_the_top(shell: Shell, tmp_path: Path) -> None:
    licence = tmp_path / "licence.txt"
    licence.write_text("Copyright Ada\nAll rights reserved\n")
    made = tmp_path / "made"
    shell("generate", "code", sample("hanoi-2"), "-o", str(made), "--licence", str(licence),
          "--name", "tower")  # fmt: skip
    for file in made.rglob("*.py"):
        assert file.read_text().startswith("# Copyright Ada\n# All rights reserved\n")
    assert _run(made, "tower", "run").returncode == 0


def test_a_run_may_demand_a_record(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Studio and the generated code answer alike, and say the same code."""
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home"))
    monkeypatch.setenv("SMSL_PASSPHRASE", "a long enough secret")
    blueprint = tmp_path / "hanoi-2.json"
    blueprint.write_bytes(Path(sample("hanoi-2")).read_bytes())
    shell("keys", "make", "--person", "Dr. Sun", "--role", "surgeon", "--id", "sun")
    record = str(tmp_path / "record.json")
    assert shell("approve", str(blueprint), "--key", "sun", "-o", record).status == 0
    made = tmp_path / "made"
    shell("generate", "code", str(blueprint), "-o", str(made), "--record", record)
    for roles, status in (("surgeon = 1", 0), ("surgeon = 1, engineer = 1", 1)):
        policy = tmp_path / "policy.toml"
        policy.write_text(f"roles = {{ {roles} }}\n")
        words = ["run", "--record", record, "--policy", str(policy), "--format", "json"]
        call = [sys.executable, "-c", RUN, "hanoi_2", *words]
        done = subprocess.run(call, cwd=made, capture_output=True, text=True, check=False)
        studio = shell("run", str(blueprint), "--world", "table", *words[1:])
        assert done.returncode == studio.status == status
        last, theirs = json.loads(done.stdout.splitlines()[-1]), studio.lines[-1]
        assert last["reason"] == theirs["reason"]
        codes = [one["code"] for one in last.get("refusals", [])]
        assert codes == [one["code"] for one in theirs.get("refusals", [])]


def test_no_level_of_a_generated_run_takes_from_people_what_was_signed(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Studio and the generated code answer alike, also about a policy that wants a supervisor."""
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home"))
    monkeypatch.setenv("SMSL_PASSPHRASE", "a long enough secret")
    values = json.loads(Path(sample("hanoi-2")).read_bytes())
    values["_levels"] = {"SB1/0": "human", "supervision": "human"}
    values["SB1"]["_operations"] = {name: {"actor": "human"} for name in ("Op_1b", "Op_2c")}
    blueprint = tmp_path / "hanoi-2.json"
    blueprint.write_text(json.dumps(values), "utf-8")
    shell("keys", "make", "--person", "Dr. Sun", "--role", "surgeon", "--id", "sun")
    record = str(tmp_path / "record.json")
    assert shell("approve", str(blueprint), "--key", "sun", "-o", record).status == 0
    made = tmp_path / "made"
    shell("generate", "code", str(blueprint), "-o", str(made), "--record", record)
    script, policy = tmp_path / "script.jsonl", tmp_path / "policy.toml"
    policy.write_text("supervisor = true\n")
    for of, level, codes in (
        ("SB1/Op_1b", "shared", ["digest_differs"]),
        ("SB1/State_aa/Op_1b", "automatic", ["digest_differs"]),
        ("SB1/0", "automatic", ["digest_differs"]),
        ("supervision", "shared", ["digest_differs"]),
        ("SB1/1", "human", []),
    ):
        lines = {"do": "level", "of": of, "level": level}, {"at": 9, "do": "pause"}
        script.write_text("\n".join(map(json.dumps, lines)), "utf-8")
        words = ["run", "--record", record, "--script", str(script), "--format", "json"]
        words += [] if codes else ["--policy", str(policy)]
        call = [sys.executable, "-c", RUN, "hanoi_2", *words]
        done = subprocess.run(call, cwd=made, capture_output=True, text=True, check=False)
        studio = shell("run", str(blueprint), "--world", "table", *words[1:])
        assert done.returncode == studio.status == 1
        for last in (json.loads(done.stdout.splitlines()[-1]), studio.lines[-1]):
            told = [one["code"] for one in last["refusals"]]
            assert told == (codes or ["supervisor_missing"])


def test_a_driver_is_generated(shell: Shell, tmp_path: Path) -> None:
    folder = tmp_path / "arm"
    made = shell("generate", "driver", "-o", str(folder), "--target", "cpp", "--format", "json")
    names = ["driver.cpp", "lamp.json", "README.md"]
    assert (made.status, made.json) == (0, {"files": names, "changed": names})
    assert shell("generate", "driver", "-o", str(folder), "--target", "cpp").status == 0
    wrong = shell("generate", "driver", sample("hanoi-2"), "-o", str(folder))
    assert (wrong.status, "generate driver takes" in wrong.err) == (2, True)
    other = shell("generate", "driver", "-o", str(folder), "--name", "x")
    assert (other.status, "--name is for code alone" in other.err) == (2, True)
