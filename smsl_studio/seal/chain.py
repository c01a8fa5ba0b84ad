"""A chain over raw bytes: every line of a text carries the SHA-256 of all bytes before it.

A line is a JSON object whose last member is its link::

    {...,"chain":"<64 hexadecimal digits>"}\\n

The link is the SHA-256 of every byte of the text up to the link itself: the lines before it with
their links and line ends, and what its own line says. Any tool can work it out again, as in
``head -c OFFSET FILE | sha256sum``. A chain shows what was changed, not who wrote it: whoever may
write the text can also write a new chain.
"""

from __future__ import annotations

import hashlib
import re

_LINK, _END = b',"chain":"', b'"}\n'
_TAIL = re.compile(rb',"chain":"([0-9a-f]{64})"\}\n')
_LENGTH = len(_LINK) + 64 + len(_END)


class Chain:
    """The SHA-256 of the bytes so far, whichever way they came."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256()

    @property
    def digest(self) -> str:
        """Of all bytes so far, as 64 hexadecimal digits."""
        return self._hash.hexdigest()

    def add(self, raw: bytes) -> None:
        """Take bytes in that carry no link."""
        self._hash.update(raw)

    def linked(self, text: bytes) -> bytes:
        """The line of a JSON object that has a member, with its link; it is taken in."""
        before = text[:-1] + _LINK
        self._hash.update(before)
        after = self.digest.encode("ascii") + _END
        self._hash.update(after)
        return before + after

    def holds(self, line: bytes) -> bool:
        """Whether a line carries the link that it should; it is taken in, whatever it carries."""
        split = unlinked(line)
        cut = len(line) if split is None else len(line) - 64 - len(_END)
        self._hash.update(line[:cut])
        right = split is not None and split[1] == self.digest
        self._hash.update(line[cut:])
        return right


def unlinked(line: bytes) -> tuple[bytes, str] | None:
    """What a line says without its link, and the link; None where it carries none."""
    found = _TAIL.fullmatch(line, max(0, len(line) - _LENGTH))
    if found is None:
        return None
    return line[: found.start()] + b"}", found[1].decode("ascii")
