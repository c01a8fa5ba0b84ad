"""DSSE envelopes: some bytes, their type, and one signature for both.

The signature is for PAE(type, bytes). PAE writes both with their lengths, so that no part of one
can be read as a part of the other. An envelope has exactly the members that are defined here.
``keyid`` is the identity of the key (see ``ed25519``).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from smsl_studio.errors import SealError
from smsl_studio.seal.strict_json import base64_text, from_base64

Json = Any


@dataclass(frozen=True, slots=True)
class Envelope:
    """Signed bytes with their type, the identity of the key, and the signature."""

    kind: str
    payload: bytes
    keyid: str
    signature: bytes

    @property
    def signed(self) -> bytes:
        """The bytes for which the signature is made."""
        return pae(self.kind, self.payload)

    def as_json(self) -> dict[str, Json]:
        """Return the envelope as plain values, in the order in which Studio writes them."""
        signature = {"keyid": self.keyid, "sig": base64_text(self.signature)}
        return {
            "payload": base64_text(self.payload),
            "payloadType": self.kind,
            "signatures": [signature],
        }


def pae(kind: str, payload: bytes) -> bytes:
    """Return the pre-authentication encoding (PAE) of DSSE version 1."""
    raw = kind.encode("utf-8")
    return b"DSSEv1 %d %b %d %b" % (len(raw), raw, len(payload), payload)


def read_envelope(values: Json, kind: str) -> Envelope:
    """Return the envelope in plain values.

    SealError if the type is not ``kind``, if there is not exactly one signature, if a member is
    unknown, or if base64 is not canonical.
    """
    _members(values, ("payload", "payloadType", "signatures"), "the envelope")
    if values["payloadType"] != kind:
        raise SealError(f"the envelope has another type than {kind}")
    payload = from_base64(values["payload"], "the payload")
    signatures = values["signatures"]
    if not isinstance(signatures, list) or len(signatures) != 1:
        raise SealError("the envelope has not exactly one signature")
    _members(signatures[0], ("keyid", "sig"), "the signature")
    keyid = signatures[0]["keyid"]
    if not isinstance(keyid, str):
        raise SealError("the identity of the key is no text")
    return Envelope(kind, payload, keyid, from_base64(signatures[0]["sig"], "the signature"))


def _members(values: Json, wanted: tuple[str, ...], what: str) -> None:
    if not isinstance(values, dict):
        raise SealError(f"{what} is no object")
    for name in wanted:
        if name not in values:
            raise SealError(f"{what} has no {name!r}")
    for name in values:
        if name not in wanted:
            raise SealError(f"{what} has the unknown member {name[:80]!r}")
