"""What ``verify.py`` makes of a folder whose files, links and signed words are unusual."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.digests import content_of, digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.bundles import bundled
from smsl_studio.front.verifier import content_texts, told_again, verifier_file
from smsl_studio.inspection.approval.record_file import SignedRecord, written_record_file
from smsl_studio.inspection.approval.statement import (
    PAYLOAD_TYPE,
    SignedDigests,
    SignedFile,
    statement_of,
)
from smsl_studio.seal.ed25519 import sealed
from smsl_studio.seal.strict_json import base64_text
from smsl_studio.shipped import samples_dir
from tests.approval import ADA, BEN, DOOR, EVE, Member, entry, register_of, said
from tests.front.bundle_tampers import is_believed, whole
from tests.runlog.impossible import Story

LOG = "logs/run.jsonl"


def _imported(folder: Path) -> tuple[Path, Path]:
    """A blueprint that imports a file of a folder whose name has a dot."""
    (folder / "parts.v2").mkdir()
    base, part = folder / "base.json", folder / "parts.v2" / "part.json"
    base.write_text(json.dumps({"_imports": ["parts.v2/part.json"], **DOOR}), "utf-8")
    part.write_text(json.dumps({"PART": DOOR["DOOR"]}), "utf-8")
    return base, part


def _files(raw: bytes, folder: Path) -> dict[str, bytes]:
    """The files of a bundle."""
    (folder / "out.zip").write_bytes(raw)
    with zipfile.ZipFile(folder / "out.zip") as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_a_folder_with_a_dot_in_its_name_is_no_file(tmp_path: Path) -> None:
    base, _ = _imported(tmp_path)
    blueprint = smsl.read(base)
    smsl.run(blueprint, log=tmp_path / "run.jsonl")
    files = _files(bundled(blueprint, "out.zip", [str(tmp_path / "run.jsonl")]), tmp_path)
    assert "blueprint/parts.v2/part.json" in files
    assert is_believed(files)
    assert not is_believed({**files, "blueprint/parts.v2/part.json": b"{}"})


def _no_file(header: dict[str, Any]) -> None:
    header["digests"]["file"] = None


def _empty(header: dict[str, Any]) -> None:
    header["digests"]["file"] = ""


@pytest.mark.parametrize("change", [_no_file, _empty])
def test_a_log_names_the_sum_of_its_file(change: Callable[[dict[str, Any]], None]) -> None:
    """Else the drawing that people see could be another than what was run."""
    story = Story.of(whole()[LOG])
    change(story.header)
    assert not is_believed({**whole(), LOG: story.raw()})


@pytest.mark.parametrize("time", [None, "", 0, [], "2026-03-01T12:00:00"])
def test_a_log_that_somebody_has_approved_names_its_time(time: object) -> None:
    """Else an approval that has expired would hold for ever."""
    story = Story.of(whole()[LOG])
    story.header["wall_time"] = time
    assert not is_believed({**whole(), LOG: story.raw()})


@pytest.mark.parametrize("module", ["json.py", "cryptography/__init__.py", "base64.py"])
def test_no_module_of_the_folder_is_loaded(module: str, tmp_path: Path) -> None:
    """One that ends the program with 0 would make everything consistent."""
    files = {**whole(), "verify.py": verifier_file().read_bytes(), LOG: b"", module: b"exit(0)\n"}
    for name, raw in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(raw)
    command = [sys.executable, "verify.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert (done.returncode, b"Not consistent." in done.stdout) == (1, True)


def test_nothing_is_read_through_a_link(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A link could lead out of the folder."""
    outside = tmp_path / "outside.json"
    outside.write_bytes(whole()["blueprint/door.json"])
    linked = tmp_path / "bundle" / "blueprint" / "door.json"
    write = Path.write_bytes

    def writing(path: Path, raw: bytes) -> int:
        if path.name != "door.json":
            return write(path, raw)
        path.symlink_to(outside)
        return len(raw)

    monkeypatch.setattr(Path, "write_bytes", writing)
    assert linked.parent.parent.name == "bundle"
    assert not is_believed(whole())


@pytest.mark.parametrize("persons", ["0", "-1"])
def test_somebody_must_have_signed(persons: str) -> None:
    """No policy lets nobody sign."""
    files = {name: raw for name, raw in whole().items() if not name.startswith("records/")}
    key = f'register_key = "{base64_text(EVE.public)}"\n'
    assert not is_believed({**files, "policy.toml": f"persons = {persons}\n{key}".encode()})


def _signed(blueprint: Blueprint, part: Blueprint, member: Member, minutes: int) -> SignedRecord:
    """A record about a file and what it imports."""
    named = {"base.json": blueprint, "part.json": part}
    subject = [
        SignedFile(name=name, digest=SignedDigests(**digests(one).as_json()))
        for name, one in named.items()
    ]
    content = {name: content_of(one) for name, one in named.items()}
    words = said(blueprint, member, minutes, content=content)
    payload = statement_of(subject, words).payload()
    return SignedRecord.of(sealed(member.private, PAYLOAD_TYPE, payload))


def test_a_record_about_a_revoked_part_is_void(tmp_path: Path) -> None:
    base, part = (smsl.read(file) for file in _imported(tmp_path))
    records = [_signed(base, part, ADA, 0), _signed(base, part, BEN, 1)]
    files = {
        "records/base.json.record.json": written_record_file(one.envelope for one in records),
        "register.json": register_of(entry(ADA), entry(BEN)),
        **{f"content/base.json/{name}.json": raw for name, raw in content_texts(base).items()},
    }
    key = f'register_key = "{base64_text(EVE.public)}"\n'
    assert is_believed({**files, "policy.toml": f"persons = 2\n{key}".encode()})
    for one in (base, part):
        revoked = f'revoked = ["sha256:{digests(one).closure}"]\n'
        assert not is_believed({**files, "policy.toml": f"persons = 2\n{key}{revoked}".encode()})


def test_a_procedure_may_have_a_title_with_characters_that_nobody_sees(tmp_path: Path) -> None:
    """Its line has escapes, and is what a run writes all the same."""
    tower = json.loads((samples_dir() / "hanoi-tower.json").read_text("utf-8"))
    below = json.loads((samples_dir() / "hanoi-2.json").read_text("utf-8"))
    branch = next(name for name in below if not name.startswith("_"))
    below.setdefault("_levels", {})
    operations = below[branch].setdefault("_operations", {})
    state = next(value for key, value in below[branch].items() if key.startswith("State"))
    operations[next(iter(state))] = {"title": "Move\u200b it", "confirm": ["surgeon"]}
    (tmp_path / "tower.json").write_text(json.dumps(tower), "utf-8")
    (tmp_path / "hanoi-2.json").write_text(json.dumps(below), "utf-8")
    blueprint = smsl.read(tmp_path / "tower.json")
    smsl.run(blueprint, log=tmp_path / "run.jsonl")
    raw = (tmp_path / "run.jsonl").read_bytes()
    assert b"u200b" in raw
    assert told_again(raw, blueprint) == ""
