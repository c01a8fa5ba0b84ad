"""What ``verify.py`` makes of records of parts and of the code that has run, and of pipes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.digests import content_of, digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.bundles import bundled
from smsl_studio.front.signed_files import SignedPaths
from smsl_studio.front.verifier import content_texts, verifier_file
from smsl_studio.inspection.approval.policy import read_policy
from smsl_studio.inspection.approval.record_file import SignedRecord, written_record_file
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.rule_code import common_code
from smsl_studio.inspection.approval.statement import (
    PAYLOAD_TYPE,
    SignedDigests,
    SignedFile,
    SignedFunction,
    WorldCode,
    statement_of,
)
from smsl_studio.seal.digest import digest_of
from smsl_studio.seal.ed25519 import sealed
from smsl_studio.seal.strict_json import base64_text, from_base64
from tests.approval import ADA, BEN, DOOR, EVE, Member, entry, make_keys_cheap, register_of, said
from tests.front.bundle_tampers import LOG, RECORD, is_believed, whole
from tests.runlog.impossible import Story

Json = Any
POLICY = f'persons = 2\nregister_key = "{base64_text(EVE.public)}"\n'
CODE = WorldCode(
    hardware=False,
    functions=[SignedFunction(function="world table", plugin="p", version="1", code="a" * 64)],
    bindings="b" * 64,
)


def record(blueprint: Blueprint, member: Member, minutes: int, **other: Any) -> SignedRecord:
    """A record about one file alone."""
    name = Path(blueprint.file).name
    digest = SignedDigests(**digests(blueprint).as_json())
    words = said(blueprint, member, minutes, content={name: content_of(blueprint)}, **other)
    payload = statement_of([SignedFile(name=name, digest=digest)], words).payload()
    return SignedRecord.of(sealed(member.private, PAYLOAD_TYPE, payload))


def record_files(blueprint: Blueprint, **other: Any) -> dict[str, bytes]:
    """The content of a file, and its record of two people."""
    return record_files_of(blueprint, (ADA, BEN), **other)


def record_files_of(
    blueprint: Blueprint, members: Sequence[Member], **other: Any
) -> dict[str, bytes]:
    """The content of a file, and its record of some people."""
    name = Path(blueprint.file).name
    records = [record(blueprint, member, n, **other) for n, member in enumerate(members)]
    return {
        f"records/{name}.record.json": written_record_file(one.envelope for one in records),
        **{f"content/{name}/{part}.json": raw for part, raw in content_texts(blueprint).items()},
    }


def test_a_file_on_which_signers_rely_has_a_record_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "part.json").write_text(json.dumps({"PART": DOOR["DOOR"]}), "utf-8")
    (tmp_path / "base.json").write_text(json.dumps({"_imports": ["part.json"], **DOOR}), "utf-8")
    base, part = (smsl.read(tmp_path / name) for name in ("base.json", "part.json"))
    relied = SignedFile(name="part.json", digest=SignedDigests(**digests(part).as_json()))
    common = {"policy.toml": POLICY.encode(), "register.json": register_of(entry(ADA), entry(BEN))}
    own, others = record_files(base, relies_on=[relied]), record_files(part)
    assert is_believed({**common, **own, **others})
    name = "records/part.json.record.json"
    alone = {key: raw for key, raw in others.items() if key != name}
    assert not is_believed({**common, **own, **alone}), "the part has none"
    one = {**others, name: written_record_file([record(part, ADA, 0).envelope])}
    assert not is_believed({**common, **own, **one}), "the same policy asks for two people"


def test_a_bundle_holds_the_records_of_parts_that_need_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_keys_cheap(monkeypatch)
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home"))
    smsl.make_key("Ada", "engineer", b"correct horse", "ada")
    (tmp_path / "part.json").write_text(json.dumps({"PART": DOOR["DOOR"]}), "utf-8")
    (tmp_path / "free.json").write_text(json.dumps({"FREE": DOOR["DOOR"]}), "utf-8")
    imports = {"_imports": ["part.json", "free.json"], **DOOR}
    (tmp_path / "base.json").write_text(json.dumps(imports), "utf-8")
    base = smsl.read(tmp_path / "base.json")
    for name, more in (("part.json", ()), ("free.json", ()), ("base.json", ("part.json",))):
        asked = smsl.ApprovalRequest(
            smsl.read(tmp_path / name), "ada", b"correct horse",
            relies_on=tuple(str(tmp_path / one) for one in more),
        )  # fmt: skip
        smsl.approve(asked)
    (tmp_path / "base.json.record.json").rename(tmp_path / "signed.json")
    named = SignedPaths(str(tmp_path / "signed.json"))
    (tmp_path / "out.zip").write_bytes(bundled(base, "out.zip", [], named))
    with zipfile.ZipFile(tmp_path / "out.zip") as archive:
        found = [name for name in archive.namelist() if name.startswith("records/")]
        archive.extractall(tmp_path / "out")
    assert found == ["records/base.json.record.json", "records/part.json.record.json"]
    command = [sys.executable, "verify.py"]
    assert subprocess.run(command, cwd=tmp_path / "out", check=False).returncode == 0


def bundle_of(policy: Mapping[str, Json]) -> dict[str, bytes]:
    """A bundle with these words about the approval in the header of its log."""
    story = Story.of(whole()[LOG])
    story.header["policy"] = policy
    return {**whole(), LOG: story.raw(), "policy.toml": POLICY.encode()}


def door_records(folder: Path, **other: Any) -> bytes:
    """The record of the door, of two people."""
    (folder / "door.json").write_text(json.dumps(DOOR, indent=1), "utf-8")
    blueprint = smsl.read(folder / "door.json")
    return written_record_file(
        record(blueprint, member, n, **other).envelope for n, member in enumerate((ADA, BEN))
    )


def test_the_code_that_ran_is_the_code_that_was_signed(tmp_path: Path) -> None:
    ran = {"code": digest_of(CODE.model_dump())}
    signed = {RECORD: door_records(tmp_path, worlds={"table": CODE})}
    assert is_believed({**bundle_of(ran), **signed})
    other = {"code": digest_of({**CODE.model_dump(), "bindings": "c" * 64})}
    assert not is_believed({**bundle_of(other), **signed})
    assert not is_believed({**bundle_of(ran), RECORD: door_records(tmp_path)}), "none was signed"


def test_the_rules_that_judged_are_the_rules_that_were_signed(tmp_path: Path) -> None:
    signed = {RECORD: door_records(tmp_path)}
    assert is_believed({**bundle_of({"rules": common_code()}), **signed})
    assert not is_believed({**bundle_of({"rules": "c" * 64}), **signed})


@pytest.mark.parametrize("place", ["content/door.json/behaviour.json", LOG, RECORD])
def test_a_pipe_in_the_folder_does_not_stop_it(place: str, tmp_path: Path) -> None:
    """Nobody writes into it, so that reading it would never end."""
    for name, raw in {**whole(), "verify.py": verifier_file().read_bytes()}.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(raw)
    (tmp_path / place).unlink()
    os.mkfifo(tmp_path / place)
    command = [sys.executable, "verify.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=60)
    assert (done.returncode, done.stderr) == (0 if place == LOG else 1, b"")


NUMBERS = ("-5", "0", "1.5", "true", "'two'", "1001", "9" * 30, "inf", "[2]")
"""Numbers of persons that no policy has."""
DAYS = ("true", "'year'", "-1", "0", "inf", "nan", "[1]")


@pytest.mark.parametrize(
    "line",
    [
        *(f"persons = {one}" for one in NUMBERS),
        *(f"roles = {{ engineer = {one} }}" for one in NUMBERS),
        *(f"valid_days = {one}" for one in DAYS),
    ],
)
def test_a_policy_with_a_number_that_is_none_is_refused_by_both(line: str) -> None:
    wrong = f'{line}\nregister_key = "{base64_text(EVE.public)}"\n'
    assert not is_believed({**whole(), "policy.toml": wrong.encode()})
    told = read_policy(Path("policy.toml"), f'{wrong}register = "register.json"\n'.encode())
    assert isinstance(told, Refusal)
    assert told.code == "policy_invalid"


def test_a_policy_with_numbers_is_believed() -> None:
    for line in ("persons = 2", "roles = { engineer = 1, surgeon = 1 }", "valid_days = 9999.5"):
        fair = f'{line}\nregister_key = "{base64_text(EVE.public)}"\n'
        assert is_believed({**whole(), "policy.toml": fair.encode()}), line


@pytest.mark.parametrize("digest", [0, False, None, "", [], {}, "0" * 64])
def test_a_log_that_names_no_sum_of_its_file_is_refused(digest: Json) -> None:
    story = Story.of(whole()[LOG])
    story.header["digests"]["file"] = digest
    assert not is_believed({**whole(), LOG: story.raw()})


@pytest.mark.parametrize(
    ("condition", "asked"),
    [
        ("world = table", True),
        ("world = hanoi", False),
        ("world = table or so", False),
        ("supervisor present", True),
        ("sensor DOOR/0 at 10 Hz", True),
        ("until 2099-01-01", True),
        ("the drill is calibrated", False),
    ],
)
def test_a_run_can_only_have_asked_what_a_program_can_ask(
    condition: str, asked: bool, tmp_path: Path
) -> None:
    signed = {RECORD: door_records(tmp_path, conditions=[condition])}
    story = Story.of(whole()[LOG])
    assert not is_believed({**whole(), LOG: story.raw(), **signed}), "it is open"
    story.events[0]["met"] = [condition]
    assert is_believed({**whole(), LOG: story.raw(), **signed}) == asked


def test_a_bundle_with_records_and_without_content_is_refused() -> None:
    left = {name: raw for name, raw in whole().items() if not name.startswith("content/")}
    assert not is_believed({name: raw for name, raw in left.items() if name != LOG})


@pytest.mark.parametrize("verdict", ["Rejected", "x", 5, True, ["approved"]])
def test_a_verdict_that_is_none_approves_nothing(verdict: Json) -> None:
    envelope = json.loads(whole()[RECORD])["records"][1]
    said = json.loads(from_base64(envelope["payload"], "payload"))
    said["predicate"]["verdict"] = verdict
    records = json.loads(whole()[RECORD])
    records["records"][1] = sealed(BEN.private, PAYLOAD_TYPE, json.dumps(said).encode()).as_json()
    assert not is_believed({**whole(), RECORD: json.dumps(records).encode()})
