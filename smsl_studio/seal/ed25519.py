"""Ed25519 keys and signatures.

This module loads ``cryptography``, which takes time. So only commands that sign or verify import
it. A key is the 32 raw bytes of RFC 8032. The identity of a key is ``sha256:`` and the SHA-256 of
its public half, in hexadecimal digits.
"""

from __future__ import annotations

from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey

from smsl_studio.seal.digest import sha256_hex
from smsl_studio.seal.envelope import Envelope, pae

LENGTH = 32
"""The length of the private half and of the public half of a key, in bytes."""
_WEAK = frozenset(
    map(
        bytes.fromhex,
        (
            "00" * 32,
            "01" + "00" * 31,
            "26e8958fc2b227b045c3f489f2ef98f0d5dfac05d3c63339b13802886d53fc05",
            "c7176a703d4dd84fba3c0b760d10670f2a2053fa2c39ccc64ec7fd7792ac037a",
            "ec" + "ff" * 30 + "7f",
            "ed" + "ff" * 30 + "7f",
            "ee" + "ff" * 30 + "7f",
        ),
    )
)
"""The public keys of small order, without the sign bit (RFC 8032, section 5.1.3). Nobody needs a
private half to sign for them, so who has such a key could deny each signature."""


def new_private() -> bytes:
    """Return a new private key."""
    return Ed25519PrivateKey.generate().private_bytes_raw()


def public_of(private: bytes) -> bytes:
    """Return the public half of a private key."""
    return Ed25519PrivateKey.from_private_bytes(private).public_key().public_bytes_raw()


def identity(public: bytes) -> str:
    """Return the identity of a key: ``sha256:`` and the SHA-256 of its public half."""
    return f"sha256:{sha256_hex(public)}"


def sealed(private: bytes, kind: str, payload: bytes) -> Envelope:
    """Sign some bytes with a private key. Return the envelope with the bytes and the signature."""
    signature = Ed25519PrivateKey.from_private_bytes(private).sign(pae(kind, payload))
    return Envelope(kind, payload, identity(public_of(private)), signature)


def is_signed(envelope: Envelope, public: bytes) -> bool:
    """Whether the envelope names this key, and its signature is valid for this key.

    A key for which anybody can sign (``is_weak``) has no valid signatures.
    """
    if envelope.keyid != identity(public) or is_weak(public):
        return False
    try:
        Ed25519PublicKey.from_public_bytes(public).verify(envelope.signature, envelope.signed)
    except (InvalidSignature, ValueError):
        return False
    return True


def is_weak(public: bytes) -> bool:
    """Whether anybody can sign for a public key, because it has a small order."""
    return bytes((*public[:-1], *(byte & 0x7F for byte in public[-1:]))) in _WEAK
