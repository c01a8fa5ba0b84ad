"""PINs: stored as salted scrypt hashes, never as they are typed.

A PIN prevents that somebody else at this window answers in your name. It is no signature, and
anybody who can write the settings of this account can remove it.
"""

from __future__ import annotations

import hashlib
import hmac
import secrets

SHORTEST = 4
_COST, _BLOCK, _LANES, _SALT = 2**14, 8, 1, 16


def hashed(pin: str) -> str:
    """The stored form of a PIN: ``scrypt$salt$hash`` in hex."""
    salt = secrets.token_bytes(_SALT)
    return f"scrypt${salt.hex()}${_derived(pin, salt).hex()}"


def matches(pin: str, kept: str) -> bool:
    """Whether a PIN fits the stored form; a damaged form fits no PIN."""
    kind, _, rest = kept.partition("$")
    salt, _, wanted = rest.partition("$")
    try:
        key, salted = bytes.fromhex(wanted), bytes.fromhex(salt)
    except ValueError:
        return False
    if kind != "scrypt" or not key:
        return False
    return hmac.compare_digest(_derived(pin, salted), key)


def _derived(pin: str, salt: bytes) -> bytes:
    return hashlib.scrypt(pin.encode(), salt=salt, n=_COST, r=_BLOCK, p=_LANES, dklen=32)
