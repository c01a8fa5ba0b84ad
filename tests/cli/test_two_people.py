"""One story: two people with two computers approve, change, approve again, run and hand it on."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.seal.canonical import canonical
from tests.approval import DOOR, make_keys_cheap
from tests.cli.shell import Answer, Shell

TESTED = "the door was tried ten times"
SLAM = {"DOOR": {**DOOR["DOOR"], "State_1": {"close": "State_0", "slam": "State_0"}}}


@dataclass(frozen=True)
class Computer:
    """A person's computer: a user's folder with a store of keys, and a folder with the files."""

    shell: Shell
    home: Path
    folder: Path
    key: str
    patch: pytest.MonkeyPatch

    def __call__(self, *words: str) -> Answer:
        """Call the command line on this computer, with the passphrase of its person."""
        self.patch.setenv("SMSL_STUDIO_HOME", str(self.home))
        self.patch.setenv("SMSL_PASSPHRASE", f"passphrase of {self.key}")
        return self.shell(*words)

    @property
    def file(self) -> str:
        return str(self.folder / "door.json")

    def approve(self, *more: str) -> Answer:
        return self("approve", self.file, "--key", self.key, *more)

    def verdict(self) -> tuple[str, list[str]]:
        """What ``verify`` says under the policy."""
        policy = str(self.folder / "policy.toml")
        answer = self("verify", self.file, "--policy", policy, "--format", "json")
        found = answer.json
        assert answer.status == (0 if found["verdict"] == "approved" else 1)
        return found["verdict"], [one["code"] for one in found["refusals"]]

    def run(self) -> dict[str, Any]:
        """The last event of a run under the policy."""
        files = *("--policy", str(self.folder / "policy.toml")), *("--log", self.log)
        Path(self.log).unlink(missing_ok=True)
        answer = self("run", self.file, "--world", "table", *files, "--format", "json")
        return dict(answer.lines[-1])

    @property
    def log(self) -> str:
        return str(self.folder / "run.jsonl")

    def send(self, other: Computer) -> None:
        """Send the files to another computer, as by mail. The stores stay where they are."""
        shutil.copytree(self.folder, other.folder, dirs_exist_ok=True)


@dataclass(frozen=True)
class Pair:
    """Ada, who is an engineer, and Ben, who is a surgeon, each at a computer."""

    ada: Computer
    ben: Computer

    def approve_both(self) -> None:
        """Ada approves. That is not enough, on neither computer. Then Ben approves, too."""
        ada, ben, missing = self.ada, self.ben, ["too_few_persons", "role_missing"]
        assert ada.approve().status == 0
        assert ada.verdict() == ("refused", missing)
        assert ada.run()["reason"] == "refused"
        ada.send(ben)
        assert ben.verdict() == ("refused", missing)
        assert ben.approve().status == 0
        assert ben.verdict() == ("approved", [])
        ben.send(ada)
        assert ada.verdict() == ("approved", [])
        assert ada.run()["reason"] == "goal_reached"

    def change(self) -> list[str]:
        """Ada changes the drawing. Both approvals are void. Return what must be said of it now."""
        ada = self.ada
        Path(ada.file).write_text(json.dumps(SLAM, indent=1))
        verdict, codes = ada.verdict()
        assert (verdict, codes[0]) == ("refused", "digest_differs")
        assert [one["code"] for one in ada.run()["refusals"]] == codes
        check = ada("check", ada.file, "--format", "json").json["files"][0]["findings"]
        changed = [one for one in check if one["rule"] == "R27"]
        assert ["slam" in one["message"] for one in changed] == [True]
        return _dispositions(check)

    def approve_again(self, known: list[str]) -> None:
        """Both approve again. Ben sets a condition, and he alone can say that it is met."""
        ada, ben = self.ada, self.ben
        open_condition = ("conditions", ["condition_unmet"])
        assert ada.approve(*known).status == 0
        ada.send(ben)
        asks = "--verdict", "conditions", "--condition", TESTED
        assert ben.approve(*known, *asks).status == 0
        assert ben.verdict() == open_condition
        ben.send(ada)
        assert ada.verdict() == open_condition
        assert ada.run()["reason"] == "refused"
        assert ada.approve(*known, "--met", TESTED).status == 0
        assert ada.verdict() == open_condition
        ada.send(ben)
        assert ben.approve(*known, "--met", TESTED).status == 0
        assert ben.verdict() == ("approved", [])
        ben.send(ada)

    def bundle(self, folder: Path) -> None:
        """Ada runs it, and hands the evidence to somebody who has only Python."""
        ada = self.ada
        end = ada.run()
        assert (end["reason"], end["operations"]) == ("goal_reached", 1)
        policy, out = str(ada.folder / "policy.toml"), f"{folder}.zip"
        made = ada("bundle", ada.file, "--log", ada.log, "--policy", policy, "-o", out)
        assert made.status == 0, made.err
        with zipfile.ZipFile(out) as archive:
            archive.extractall(folder)


def test_two_people_with_two_computers(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_keys_cheap(monkeypatch)
    ada, ben = (
        Computer(shell, tmp_path / f"home of {key}", tmp_path / key, key, monkeypatch)
        for key in ("ada", "ben")
    )
    for one, person, role in ((ada, "Ada Lovelace", "engineer"), (ben, "Ben Carson", "surgeon")):
        one.folder.mkdir()
        made = one("keys", "make", "--person", person, "--role", role, "--id", one.key)
        assert made.status == 0, made.err
    _exchange_keys(ada, ben)
    (ada.folder / "policy.toml").write_text("roles = { surgeon = 1, engineer = 1 }\n")
    Path(ada.file).write_text(json.dumps(DOOR, indent=1))
    pair, evidence = Pair(ada, ben), tmp_path / "evidence"
    pair.approve_both()
    pair.approve_again(pair.change())
    pair.bundle(evidence)
    status, said = _checked(evidence)
    assert (status, said.splitlines()[-1]) == (0, "Consistent."), said
    assert "No record" not in said
    assert "No log" not in said
    # Without the later records it is refused there, and on the computer of who has signed them.
    record = evidence / "records" / "door.json.record.json"
    values = json.loads(record.read_text())
    assert len(values["records"]) == 6
    record.write_bytes(_first_of(values))
    assert _checked(evidence)[0] == 1
    Path(f"{ben.file}.record.json").write_bytes(_first_of(values))
    assert ben.verdict()[0] == "refused"


def _first_of(values: dict[str, Any]) -> bytes:
    return canonical({"records": values["records"][:1]}) + b"\n"


def _exchange_keys(*computers: Computer) -> None:
    """Let each person take in the public key of the other one."""
    for one in computers:
        for other in computers:
            if other is not one:
                file = str(one.folder / f"{other.key}.key.json")
                assert other("keys", "export", other.key, "-o", file).status == 0
                assert one("keys", "import", file).status == 0
                assert one.approve("--key", other.key).status == 2, "only the public half is here"


def _dispositions(findings: list[dict[str, Any]]) -> list[str]:
    warned = [one for one in findings if one["severity"] == "W"]
    said = [f"{one['rule']}@{one['address']}=it is wanted" for one in warned]
    return [word for text in said for word in ("--disposition", text)]


def _checked(folder: Path) -> tuple[int, str]:
    """What ``verify.py`` says in a Python that sees neither this package nor its folder."""
    command = [sys.executable, "-I", "verify.py"]
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, check=False, env={"PATH": ""}
    )
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout
