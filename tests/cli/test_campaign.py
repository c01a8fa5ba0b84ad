"""``campaign``: what it writes and prints, and its exit status."""

from __future__ import annotations

import hashlib
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from pyarrow import parquet

from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell


def lines(file: Path) -> int:
    """The number of whole lines of a file, 0 if it is not there."""
    return file.read_bytes().count(b"\n") if file.exists() else 0


SMALL = str(samples_dir() / "hanoi-2.json")


def test_the_digest_is_of_the_bytes_that_each_run_prints(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "out.json"
    answer = shell("campaign", SMALL, "--world", "table", "--seeds", "3", "-o", str(out))
    assert answer.status == 0
    whole = hashlib.sha256()
    for seed in range(3):
        run = shell("run", SMALL, "--world", "table", "--seed", str(seed), "--format", "json")
        whole.update(f"{hashlib.sha256(run.out.encode()).hexdigest()}\n".encode())
    told = json.loads(out.read_text())
    assert told["digest"] == whole.hexdigest()
    assert set(told) == {"runs", "reached", "digest", "rows"}
    row = {"fault": None, "edge": None, "runs": 3, "reached": 3, "held": 0, "recovered": 0}
    assert told["rows"] == [{**row, "low": told["rows"][0]["low"], "high": 1.0}]
    assert not out.with_name("out.json.part").exists()


def test_faults_give_rows_and_a_page(shell: Shell, tmp_path: Path) -> None:
    out, page = tmp_path / "out.json", tmp_path / "out.html"
    words = ("campaign", SMALL, "--world", "table", "--seeds", "1", "--faults", "all")
    answer = shell(*words, "-o", str(out), "--report", str(page), "--format", "json")
    assert answer.status == 0
    assert answer.json == json.loads(out.read_text())
    assert {row["fault"] for row in answer.json["rows"]} >= {"fail", "hang"}
    assert "the fault set is left out" in answer.err
    assert "<table>" in page.read_text()


def test_a_run_that_misses_the_goal_is_a_no(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "stuck.json"
    header = {"INITIAL": "State_0", "ACTIVATING": "State_1"}
    file.write_text(json.dumps({"SB1": {"HEADER": header, "State_0": {}, "State_1": {}}}))
    out = str(tmp_path / "out.json")
    answer = shell("campaign", str(file), "--world", "table", "--seeds", "2", "-o", out)
    assert answer.status == 1
    assert "0 of 2 runs reached the goal" in answer.out


def test_runs_have_start_goal_and_supervisor_and_give_parquet(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, table = tmp_path / "out.json", tmp_path / "out.parquet"
    words = ("campaign", SMALL, "--world", "table", "--seeds", "2", "-o", str(out), "--parquet",
             str(table), "--start", "SB1/State_ba", "--goal", "SB1/State_bb")  # fmt: skip
    told = shell(*words, "--supervisor", "limit:risk=0.9", "--format", "json").json
    run = ("run", SMALL, "--world", "table", *words[-4:], "--supervisor", "limit:risk=0.9")
    lines = (shell(*run, "--seed", seed, "--format", "json").out for seed in "01")
    each = "".join(f"{hashlib.sha256(one.encode()).hexdigest()}\n" for one in lines)
    assert told["digest"] == hashlib.sha256(each.encode()).hexdigest()
    read = parquet.read_table(table)
    assert read.to_pylist() == told["rows"]
    assert read.schema.metadata[b"digest"].decode() == told["digest"]
    assert shell(*words, "--supervisor", "limt").status == 2
    assert shell(*words, "--parquet", str(out)).status == 2
    # Without the extra nothing is run.
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    out.unlink()
    answer = shell(*words)
    assert answer.status == 2
    assert "need the extra parquet" in answer.err
    assert not out.exists()


def test_wrong_words_are_refused(shell: Shell, tmp_path: Path) -> None:
    out = str(tmp_path / "out.json")
    for more in (("--faults", "fial"), ("--faults", ","), ("--until", "2"), ("--workers", "0")):
        answer = shell("campaign", SMALL, "--world", "table", "--seeds", "1", "-o", out, *more)
        assert answer.status == 2, more
    assert shell("campaign", SMALL, "--world", "nowhere", "--seeds", "1", "-o", out).status == 2
    assert not Path(out).exists()


@pytest.mark.parametrize("workers", ["1", "2"])
@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL])
def test_a_campaign_that_was_ended_goes_on(
    shell: Shell, tmp_path: Path, end: signal.Signals, workers: str
) -> None:
    out, part = tmp_path / "out.json", tmp_path / "out.json.part"
    words = ("campaign", SMALL, "--world", "table", "--seeds", "300", "-o", str(out))
    command = [sys.executable, "-m", "smsl_studio", *words, "--workers", workers]
    running = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
    )
    # The progress is read as soon as the file grows; a campaign that ends first fails below.
    while running.poll() is None and lines(part) < 5:
        os.sched_yield()
    # A terminal sends Ctrl-C to all processes of the group.
    os.killpg(running.pid, end)
    _, said = running.communicate(timeout=60)
    assert b"Traceback" not in said
    assert running.returncode == (-9 if end == signal.SIGKILL else 130)
    assert not out.exists()
    assert 5 <= lines(part) < 300
    answer = shell(*words, "--resume", "--workers", workers, "--format", "json")
    whole = shell(*words[:-1], str(tmp_path / "whole.json"), "--format", "json")
    assert answer.json == whole.json
    assert not part.exists()


def test_no_file_is_written_over_another(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "in.json"
    file.write_bytes(Path(SMALL).read_bytes())
    named = tmp_path / "q.json.part"
    named.write_bytes(file.read_bytes())
    link = tmp_path / "link.json"
    link.symlink_to(file)
    for words in (
        (str(file), "-o", str(file)),
        (str(file), "-o", str(link)),
        (str(named), "-o", str(tmp_path / "q.json")),
        (str(file), "-o", str(tmp_path / "s.json"), "--report", str(tmp_path / "s.json")),
        (str(file), "-o", str(tmp_path / "s.json"), "--report", str(file)),
        (str(file), "-o", "-"),
        (str(file), "-o", str(tmp_path)),
    ):
        answer = shell("campaign", *words, "--world", "table", "--seeds", "1")
        assert answer.status == 2, words
        assert "Traceback" not in answer.err
    assert file.read_bytes() == named.read_bytes() == Path(SMALL).read_bytes()
    assert {one.name for one in tmp_path.iterdir()} >= {"in.json", "q.json.part", "link.json"}
    assert not (tmp_path / "s.json").exists()
