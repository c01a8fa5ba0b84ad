"""Digests: the SHA-256 of canonical bytes, in hex."""

from __future__ import annotations

import hashlib
from typing import Any

from smsl_studio.seal.canonical import canonical


def sha256_hex(data: bytes) -> str:
    """The SHA-256 of bytes as 64 hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


def digest_of(values: Any) -> str:
    """The digest of plain values: equal for values that are equal, whatever their key order."""
    return sha256_hex(canonical(values))
