"""Digests: the SHA-256 of canonical bytes, in hexadecimal digits."""

from __future__ import annotations

import hashlib
from typing import Any

from smsl_studio.seal.canonical import canonical


def sha256_hex(data: bytes) -> str:
    """Return the SHA-256 of bytes as 64 hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


def digest_of(values: Any) -> str:
    """Return the digest of plain values. Equal values have equal digests, in any order of keys.

    UsageError for values without a canonical form (see ``canonical``).
    """
    return sha256_hex(canonical(values))
