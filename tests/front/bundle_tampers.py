"""Tampers with a bundle of evidence and with its log, drawn from numbers, for ``verify.py``."""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from random import Random
from typing import Any

import smsl_studio as smsl
from smsl_studio.front.verifier import content_texts, verifier_file
from smsl_studio.inspection.approval.record_file import written_record_file
from smsl_studio.seal.strict_json import base64_text
from tests.approval import ADA, BEN, DOOR, EVE, entry, register_of, signed

Json = Any
Files = dict[str, bytes]
"""The files of a bundle by their names."""
LOG, BLUEPRINT, RECORD = "logs/run.jsonl", "blueprint/door.json", "records/door.json.record.json"
ABSENT = ("README.txt", "verify.py", "policy.toml", LOG)
"""What a bundle may lack: that a log or a policy is absent is said, and is no failure."""


@cache
def whole() -> Mapping[str, bytes]:
    """A bundle that two people have signed, with a log and a register."""
    with tempfile.TemporaryDirectory() as name:
        file, log = Path(name) / "door.json", Path(name) / "run.jsonl"
        file.write_text(json.dumps(DOOR, indent=1), "utf-8")
        blueprint = smsl.read(file)
        smsl.run(blueprint, log=log)
        records = [signed(blueprint, ADA, 0).envelope, signed(blueprint, BEN, 1).envelope]
        policy = f'register_key = "{base64_text(EVE.public)}"\n[roles]\nengineer = 1\nsurgeon = 1\n'
        return {
            LOG: log.read_bytes(),
            BLUEPRINT: file.read_bytes(),
            RECORD: written_record_file(records),
            "register.json": register_of(entry(ADA), entry(BEN)),
            "policy.toml": policy.encode(),
            **{f"content/door.json/{part}.json": raw
               for part, raw in content_texts(blueprint).items()},
        }  # fmt: skip


def is_believed(files: Mapping[str, bytes]) -> bool:
    """Whether ``verify.py`` finds a bundle consistent. It may print, and raises nothing."""
    with tempfile.TemporaryDirectory() as name:
        for place, raw in files.items():
            path = Path(name) / place
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(raw)
        with contextlib.chdir(name), contextlib.redirect_stdout(io.StringIO()):
            return not program().main()


@cache
def program() -> Json:
    """``verify.py`` as a module."""
    spec = spec_from_file_location("verify_in_a_bundle", verifier_file())
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def in_log(draw: Random, files: Files) -> None:
    """Bytes of the log are flipped, or its lines are cut, doubled or moved."""
    lines = files[LOG].splitlines(keepends=True)
    at, there = draw.sample(range(len(lines)), 2)
    match draw.randrange(5):
        case 0:
            lines.pop(at)
        case 1:
            lines.insert(there, lines[at])
        case 2:
            lines[at], lines[there] = lines[there], lines[at]
        case 3:
            lines[at] = lines[at][: draw.randrange(len(lines[at]))]
        case _:
            lines = [_flipped(draw, files[LOG])]
    files[LOG] = b"".join(lines)


def in_bundle(draw: Random, files: Files) -> None:
    """A file of the bundle is changed, left out, or has the content of another one."""
    place, other = draw.sample([name for name in sorted(files) if name not in ABSENT], 2)
    match draw.randrange(4):
        case 0:
            del files[place]
        case 1:
            files[place] = files[other]
        case _:
            files[place] = _flipped(draw, files[place])


def _flipped(draw: Random, raw: bytes) -> bytes:
    """One to three bytes are other ones, or such that stand elsewhere in the file."""
    found = bytearray(raw)
    for _ in range(draw.randint(1, 3)):
        at = draw.randrange(len(found))
        found[at] = draw.choice([found[at] ^ draw.randint(1, 255), draw.choice(raw)])
    return bytes(found)


BUNDLE_KINDS: Mapping[str, Callable[[Random, Files], None]] = {"log": in_log, "bundle": in_bundle}


def is_let_through(kind: str, number: int) -> bool | None:
    """Whether ``verify.py`` believes a tamper. None if it changes nothing."""
    files = dict(whole())
    BUNDLE_KINDS[kind](Random(f"{kind} {number}"), files)
    if {name: _meant(raw) for name, raw in files.items()} == _meant_by_whole():
        return None
    return is_believed(files)


@cache
def _meant_by_whole() -> Mapping[str, Json]:
    return {name: _meant(raw) for name, raw in whole().items()}


def _meant(raw: bytes) -> Json:
    """What a file says: equal values of JSON are the same."""
    try:
        return json.loads(raw)
    except ValueError:
        return raw
