"""Logs whose head somebody has signed: with the key of the computer that writes logs, with a key
of it that was revoked, with the key of a person, and with one that nobody knows.

``verify.py`` asks a register and a policy, as a bundle has them. ``replay`` asks a store with the
same keys.
"""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import MappingProxyType
from typing import Any
from unittest.mock import patch

from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.verifier import content_texts
from smsl_studio.inspection.approval.key_store import StoredKey
from smsl_studio.inspection.approval.log_seal import PAYLOAD_TYPE
from smsl_studio.seal.ed25519 import sealed
from smsl_studio.seal.strict_json import base64_text
from tests.approval import ADA, EVE, Member, entry, register_of
from tests.front.bundle_tampers import program
from tests.front.told_runs import ToldRun

Json = Any
ROOM = Member("Room 3", "recorder", bytes(range(4, 36)))
STOLEN = Member("Room 4", "recorder", bytes(range(5, 37)))
STRANGER = Member("Room 5", "recorder", bytes(range(6, 38)))
RIGHT = "the right key"
SIGNERS = MappingProxyType({RIGHT: ROOM, "a revoked key": STOLEN, "a person's key": ADA,
                            "an unknown key": STRANGER})  # fmt: skip
"""Who signs a head. The first one alone may."""
POLICY = f'register_key = "{base64_text(EVE.public)}"\nrevoked = ["{STOLEN.key}"]\n'


def headed(raw: bytes, signer: Member) -> bytes:
    """A log with a signature of its head. ``raw`` is the log without one."""
    *lines, head = raw.splitlines(keepends=True)
    said = head[len(b'{"head":') : -2]
    last = {
        "head": json.loads(said),
        "signed": sealed(signer.private, PAYLOAD_TYPE, said).as_json(),
    }
    return b"".join(lines) + json.dumps(last, separators=(",", ":")).encode() + b"\n"


@contextlib.contextmanager
def known_keys() -> Iterator[None]:
    """A folder with a register and a policy for ``verify.py``, and the same keys in the store."""
    store = {
        one.person: StoredKey(
            one.person, one.person, one.role, one.public, "2026-01-01T00:00:00Z",
            revoked="stolen" if one is STOLEN else "",
        )
        for one in (ROOM, STOLEN, ADA)
    }  # fmt: skip
    stored = patch("smsl_studio.inspection.approval.log_seal.stored_keys", lambda: store)
    with tempfile.TemporaryDirectory() as name, contextlib.chdir(name), stored:
        Path("register.json").write_bytes(register_of(entry(ROOM), entry(STOLEN), entry(ADA)))
        Path("policy.toml").write_text(POLICY, "utf-8")
        yield


def is_believed_here(run: ToldRun) -> bool:
    """Whether ``verify.py`` believes the story of a log and the signature of its head. It must be
    asked within ``known_keys``.
    """
    checks = program()
    try:
        parts = [run.blueprint, *procedures_of(run.blueprint).parts]
        read = [checks.content([texts[part] for part in checks.PARTS])
                for texts in map(content_texts, parts)]  # fmt: skip
        header = checks.tell({one.hexes[3]: one for one in read}, run.raw)
        return bool(header.signed and checks.recorder(header))
    except Exception:  # as ``verify.py`` does, which tells it in a line
        return False


def is_believed_by_replay(run: ToldRun) -> bool:
    """Whether ``replay --verify --blueprint`` does. It must be asked within ``known_keys``."""
    verdict = verify_stream(io.BytesIO(run.raw), "log", run.blueprint)
    return verdict.doubt is None
