"""Signs the heads of logs with the key of this computer, and checks who has signed one.

The key is one of the store with the role ``recorder``. The signature is a DSSE envelope whose bytes
are the head of the log. It says that this computer has written the log. It approves nothing.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.key_store import Signer, StoredKey, stored_keys
from smsl_studio.inspection.approval.known_keys import name_of
from smsl_studio.inspection.approval.statement import RECORDER
from smsl_studio.seal.ed25519 import is_signed
from smsl_studio.seal.envelope import read_envelope
from smsl_studio.seal.strict_json import read_strictly

Json = Any
PAYLOAD_TYPE = "application/vnd.smsl-studio.log-head+json"


@dataclass(frozen=True, slots=True)
class LogSeal:
    """The opened key of this computer. Calling it signs the bytes of a head."""

    key: StoredKey
    _sign: Signer = field(repr=False)

    def __call__(self, head: bytes) -> Mapping[str, Json]:
        """Return the envelope of a head, as plain values."""
        return self._sign(PAYLOAD_TYPE, head).as_json()


def recorder_key() -> StoredKey | None:
    """Return the key with which this computer signs logs: the newest that is not revoked.

    None if the store has none with its private half. SealError if the store is not believed.
    """
    found = [one for one in _recorders() if one.box is not None and not one.revoked]
    return max(found, key=lambda one: (one.made, one.id), default=None)


def log_seal(key: StoredKey, passphrase: bytes) -> LogSeal:
    """Open the key of this computer. SealError if the passphrase, or PIN, is wrong."""
    if key.token is not None:
        # The head is signed at the end of a run. A wrong PIN must be found before it begins.
        key.prove(passphrase)
    return LogSeal(key, key.signer(passphrase))


def signer_of(head: bytes, signed: bytes) -> StoredKey:
    """Return the key that has signed a head. ``signed`` is the envelope as the log has it.

    SealError if the signature is wrong, or if its key is unknown here, revoked, or no recorder's.
    """
    envelope = read_envelope(read_strictly(signed, "the signature of the head"), PAYLOAD_TYPE)
    written = json.dumps(envelope.as_json(), separators=(",", ":")).encode("ascii")
    if written != signed or envelope.payload != head:
        raise SealError("the signature of its head is of another head, or not as Studio writes it")
    key = next((one for one in stored_keys().values() if one.identity == envelope.keyid), None)
    if key is None:
        raise SealError(
            f"its head is signed with {envelope.keyid[:80]}, a key that is unknown here",
            advice="keys import takes the public half of the computer that wrote the log.",
        )
    if not is_signed(envelope, key.public):
        raise SealError(f"the signature of its head is not one of the key {key.id}")
    if key.revoked:
        raise SealError(f"its head is signed with {key.id}, which is revoked: {key.revoked}")
    if name_of(key.role) != RECORDER:
        raise SealError(f"its head is signed with {key.id}, which is no recorder's key")
    return key


def _recorders() -> Iterator[StoredKey]:
    return (one for one in stored_keys().values() if name_of(one.role) == RECORDER)
