"""DSSE envelopes and Ed25519: known vectors, strict reading, and what others sign and verify."""

from __future__ import annotations

from typing import Any

import pytest
from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey
from securesystemslib.dsse import Envelope as OtherEnvelope
from securesystemslib.signer._crypto_signer import CryptoSigner
from securesystemslib.signer._key import SSlibKey

from smsl_studio.errors import SealError
from smsl_studio.seal.ed25519 import (
    identity,
    is_signed,
    is_weak,
    new_private,
    public_of,
    sealed,
)
from smsl_studio.seal.envelope import Envelope, pae, read_envelope
from smsl_studio.seal.strict_json import from_base64, read_strictly

KIND = "application/example"
PRIVATE = bytes.fromhex("9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60")
PUBLIC = bytes.fromhex("d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a")
SIGNATURE = bytes.fromhex(
    "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9"
    "b46bd25bf5f0595bbe24655141438e7a100b"
)
"""The first test of RFC 8032: a signature of no bytes."""


def test_the_vectors_of_the_standards() -> None:
    assert pae("http://example.com/HelloWorld", b"hello world") == (
        b"DSSEv1 29 http://example.com/HelloWorld 11 hello world"
    )
    assert public_of(PRIVATE) == PUBLIC
    assert Ed25519PrivateKey.from_private_bytes(PRIVATE).sign(b"") == SIGNATURE


def test_what_is_signed_is_read_again() -> None:
    made = sealed(PRIVATE, KIND, b'{"a":1}')
    assert read_envelope(made.as_json(), KIND) == made
    assert is_signed(made, PUBLIC)
    assert made.keyid == identity(PUBLIC)
    Ed25519PublicKey.from_public_bytes(PUBLIC).verify(made.signature, made.signed)


@pytest.mark.parametrize("at", range(0, 64, 7))
def test_a_changed_signature_does_not_count(at: int) -> None:
    made = sealed(PRIVATE, KIND, b"{}")
    raw = bytearray(made.signature)
    raw[at] ^= 1
    assert not is_signed(Envelope(KIND, made.payload, made.keyid, bytes(raw)), PUBLIC)


def test_a_signature_of_another_type_payload_or_key_does_not_count() -> None:
    made = sealed(PRIVATE, KIND, b"{}")
    assert not is_signed(Envelope("x", made.payload, made.keyid, made.signature), PUBLIC)
    assert not is_signed(Envelope(KIND, b"[]", made.keyid, made.signature), PUBLIC)
    other = public_of(new_private())
    assert not is_signed(made, other)
    assert not is_signed(Envelope(KIND, made.payload, identity(other), made.signature), other)
    assert not is_signed(Envelope(KIND, made.payload, made.keyid, b""), PUBLIC)


def edited(**changes: Any) -> dict[str, Any]:
    return {**sealed(PRIVATE, KIND, b"{}").as_json(), **changes}


@pytest.mark.parametrize(
    "values",
    [
        edited(more=1),
        edited(payloadType="application/other"),
        edited(payload="e30"),
        edited(payload="e31="),
        edited(payload="e30=\n"),
        edited(payload=1),
        edited(signatures=[]),
        edited(signatures=2 * edited()["signatures"]),
        edited(signatures=[{"keyid": "k", "sig": "AA==", "cert": "x"}]),
        edited(signatures=[{"sig": "AA=="}]),
        edited(signatures=[{"keyid": 1, "sig": "AA=="}]),
        [],
        None,
        {key: value for key, value in edited().items() if key != "payload"},
    ],
)
def test_an_envelope_is_read_strictly(values: Any) -> None:
    with pytest.raises(SealError):
        read_envelope(values, KIND)


@pytest.mark.parametrize(
    "raw",
    [b'{"a":1,"a":1}', b"[NaN]", b"\xff", b"", b"[" * 100_000, b'{"a":1}x', b"\xef\xbb\xbf{}"],
)
def test_json_is_read_strictly(raw: bytes) -> None:
    with pytest.raises(SealError):
        read_strictly(raw, "it")


def test_base64_has_one_spelling() -> None:
    assert from_base64("AAE=", "it") == b"\0\1"
    for text in ("AAE", "AAF=", "AA E=", "AAE=\n", "AAE==", "_-8=", "é"):
        with pytest.raises(SealError):
            from_base64(text, "it")


def test_others_verify_what_we_sign_and_we_what_they_sign() -> None:
    made = sealed(PRIVATE, KIND, b'{"a":1}')
    public = Ed25519PublicKey.from_public_bytes(PUBLIC)
    key = SSlibKey.from_crypto(public, keyid=identity(PUBLIC))
    theirs = OtherEnvelope.from_dict(made.as_json())
    assert theirs.verify([key], 1)
    signer = CryptoSigner(Ed25519PrivateKey.from_private_bytes(PRIVATE), key)
    again = OtherEnvelope(made.payload, KIND, {})
    again.sign(signer)
    read = read_envelope(again.to_dict(), KIND)
    assert read == made
    assert is_signed(read, PUBLIC)
    wrong = SSlibKey.from_crypto(public, keyid="another name")
    other = OtherEnvelope(made.payload, KIND, {})
    other.sign(CryptoSigner(Ed25519PrivateKey.from_private_bytes(PRIVATE), wrong))
    assert not is_signed(read_envelope(other.to_dict(), KIND), PUBLIC)


WEAK = [
    bytes(32),
    b"\1" + bytes(31),
    b"\1" + bytes(30) + b"\x80",
    b"\xec" + b"\xff" * 30 + b"\x7f",
    bytes.fromhex("26e8958fc2b227b045c3f489f2ef98f0d5dfac05d3c63339b13802886d53fc05"),
    bytes.fromhex("c7176a703d4dd84fba3c0b760d10670f2a2053fa2c39ccc64ec7fd7792ac037a"),
]


@pytest.mark.parametrize("public", WEAK, ids=lambda one: one.hex()[:4])
def test_a_key_for_which_anybody_can_sign_signs_nothing(public: bytes) -> None:
    """The library believes such a signature: nobody knows a private half, and it is valid."""
    believed = []
    for number in range(64):
        payload = b"%d" % number
        forged = Envelope(KIND, payload, identity(public), b"\1" + bytes(63))
        try:
            Ed25519PublicKey.from_public_bytes(public).verify(forged.signature, forged.signed)
        except InvalidSignature:
            continue
        believed.append(forged)
    assert believed, "the attack works without a look at the key"
    assert not any(is_signed(one, public) for one in believed)


def test_no_usual_key_is_weak() -> None:
    assert not any(is_weak(public_of(new_private())) for _ in range(50))
    assert not is_weak(b"")
