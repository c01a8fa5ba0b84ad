"""An approved procedure as one operation, in physics: held in its middle, resumed, revoked."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

from smsl_studio.shipped import samples_dir
from tests.approval import written_policy
from tests.cli.people import Desk

# A run that waits has the next act at once, so the times after the hold only give the order.
ACTS = """\
{"at": 0.5, "do": "disturb", "target": "SB1/0", "kind": "dropout", "by": "Ada"}
{"at": 9, "do": "disturb", "target": "SB1/0", "kind": "none", "by": "Ada"}
{"at": 9, "do": "resume", "by": "Ada"}
{"at": 9.1, "do": "resume", "by": "Ada"}
"""


def told_below(lines: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The events of what the operations run."""
    return [json.loads(one["told"]) for one in lines if one["event"] == "within"]


def test_it_is_held_told_resumed_by_a_person_and_refused_when_its_part_is_revoked(
    desk: Desk, tmp_path: Path
) -> None:
    for name in ("hanoi-tower.json", "hanoi-2.json"):
        shutil.copy(samples_dir() / name, tmp_path)
    tower, part = str(tmp_path / "hanoi-tower.json"), str(tmp_path / "hanoi-2.json")
    policy, log = written_policy(tmp_path, "persons = 1\n"), str(tmp_path / "run.jsonl")
    (tmp_path / "acts").write_text(ACTS)
    words = ("run", tower, "--world", "hanoi", "--policy", policy, "--format", "json")
    assert desk("approve", tower, "--key", "ada", "--world", "hanoi").status == 0
    refused = desk(*words).lines[-1]
    assert [one["code"] for one in refused["refusals"]] == ["sub_not_covered"]
    assert desk("approve", part, "--key", "ada", "--world", "hanoi").status == 0
    done = desk(*words, "--script", str(tmp_path / "acts"), "--log", log)
    assert done.lines[-1]["reason"] == "goal_reached", done.err
    below = told_below(done.lines)
    held = next(at for at, one in enumerate(below) if one["event"] == "held")
    assert "SB1" in below[held]["reason"]
    assert below[held]["t"] < 9
    kinds = [one["event"] for one in below[held:]]
    assert kinds.index("resumed") < kinds.index("goal_reached")
    who = [one["by"] for one in done.lines if one["event"] == "commanded"]
    assert set(who) == {"Ada"}
    evidence = ("--record", f"{tower}.record.json", "--policy", policy, "-o", f"{tmp_path}/out.zip")
    assert desk("bundle", tower, "--log", log, *evidence).status == 0
    with zipfile.ZipFile(tmp_path / "out.zip") as archive:
        archive.extractall(tmp_path / "out")
    checks = subprocess.run(
        [sys.executable, "verify.py"], cwd=tmp_path / "out", capture_output=True, check=False
    )
    assert checks.returncode == 0, checks.stdout
    digest = desk("digest", part, "--format", "json").json["files"][0]["closure"]
    assert desk("store", "revoke", digest, "--key", "ada", "--why", "a weak grip").status == 0
    last = desk(*words).lines[-1]
    assert last["reason"] == "refused"
    assert [one["code"] for one in last["refusals"]] == ["sub_not_covered"]
    assert "a weak grip" in last["refusals"][0]["sentence"]
