"""Encrypts a private key with a passphrase. The result is called a box.

scrypt computes a key from the passphrase. ChaCha20-Poly1305 encrypts with this key. It also
protects the other values in the key's file, person and role. So nobody can change these without the
passphrase.
"""

from __future__ import annotations

import hashlib
import os
from typing import Any

from cryptography.exceptions import InvalidTag
from cryptography.hazmat.primitives.ciphers.aead import ChaCha20Poly1305

from smsl_studio.errors import SealError
from smsl_studio.seal.strict_json import base64_text, from_base64

Json = Any
_N, _R, _P = 1 << 15, 8, 1
"""The cost of scrypt. A call needs 32 MB of memory and about 0.1 s."""

_LEAST_N, _MOST_N = 1 << 14, 1 << 18
_MEMBERS = {"kdf", "n", "r", "p", "salt", "cipher", "nonce", "box"}
WRONG = "the passphrase does not open this key"


def boxed(private: bytes, passphrase: bytes, beside: bytes) -> dict[str, Json]:
    """Encrypt a private key. Return the box as plain values.

    A later change of ``beside`` makes the box invalid.
    """
    if not passphrase:
        raise SealError("the passphrase is empty", advice="Choose one that nobody guesses.")
    salt, nonce = os.urandom(16), os.urandom(12)
    box = ChaCha20Poly1305(_key(passphrase, salt, _N)).encrypt(nonce, private, beside)
    return {
        "kdf": "scrypt",
        "n": _N,
        "r": _R,
        "p": _P,
        "salt": base64_text(salt),
        "cipher": "chacha20-poly1305",
        "nonce": base64_text(nonce),
        "box": base64_text(box),
    }


def unboxed(values: Json, passphrase: bytes, beside: bytes) -> bytes:
    """Decrypt the private key in a box.

    SealError if the passphrase is wrong, if the values are no box, or if ``beside`` has changed.
    """
    salt, nonce, box, cost = read_box(values)
    try:
        return ChaCha20Poly1305(_key(passphrase, salt, cost)).decrypt(nonce, box, beside)
    except InvalidTag:
        raise SealError(
            WRONG, advice="Type it again. If it is lost, make a new key and revoke this one."
        ) from None


def read_box(values: Json) -> tuple[bytes, bytes, bytes, int]:
    """Return salt, nonce, encrypted key, and the cost N of scrypt. SealError if there is no box."""
    if not isinstance(values, dict) or set(values) != _MEMBERS:
        raise SealError("the private half of the key has not the form that Studio writes")
    cost = values["n"]
    known = (values["kdf"], values["r"], values["p"], values["cipher"])
    if known != ("scrypt", _R, _P, "chacha20-poly1305") or type(cost) is not int:
        raise SealError("the private half of the key is encrypted in an unknown way")
    if not _LEAST_N <= cost <= _MOST_N or cost & (cost - 1):
        raise SealError("the private half of the key asks for an odd amount of work")
    salt, nonce, box = (from_base64(values[key], key) for key in ("salt", "nonce", "box"))
    if len(nonce) != 12:
        raise SealError("the private half of the key has an odd nonce")
    return salt, nonce, box, cost


def _key(passphrase: bytes, salt: bytes, cost: int) -> bytes:
    most = 256 * _R * cost
    return hashlib.scrypt(passphrase, salt=salt, n=cost, r=_R, p=_P, maxmem=most, dklen=32)
