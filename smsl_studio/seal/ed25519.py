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
    """Whether the envelope names this key, and its signature is valid for this key."""
    if envelope.keyid != identity(public):
        return False
    try:
        Ed25519PublicKey.from_public_bytes(public).verify(envelope.signature, envelope.signed)
    except (InvalidSignature, ValueError):
        return False
    return True
