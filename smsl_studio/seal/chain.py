"""A chain over raw bytes: every line of a text carries the SHA-256 of all bytes before it.

A line is a JSON object whose last member is its link::

    {...,"chain":"<64 hexadecimal digits>"}\\n

The link is the SHA-256 of every byte of the text before the link: the earlier lines with their
links and line ends, and the beginning of its own line. Every tool can compute it again, as in
``head -c OFFSET FILE | sha256sum``. A chain shows a change of the text, but not its author: a
person who may write the text can also write a new chain.
"""

from __future__ import annotations

import hashlib
import re

_LINK, _END = b',"chain":"', b'"}\n'
_TAIL = re.compile(rb',"chain":"([0-9a-f]{64})"\}\n')
_LENGTH = len(_LINK) + 64 + len(_END)


class Chain:
    """The SHA-256 of all bytes so far."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256()

    @property
    def digest(self) -> str:
        """The SHA-256 of all bytes so far, as 64 hexadecimal digits."""
        return self._hash.hexdigest()

    def add(self, raw: bytes) -> None:
        """Add bytes without a link."""
        self._hash.update(raw)

    def linked(self, text: bytes) -> bytes:
        """Return the line of a JSON object with its link, and add it. The object must have a
        member."""
        before = text[:-1] + _LINK
        self._hash.update(before)
        after = self.digest.encode("ascii") + _END
        self._hash.update(after)
        return before + after

    def holds(self, line: bytes) -> bool:
        """Add a line. Return whether it has the right link."""
        split = unlinked(line)
        cut = len(line) if split is None else len(line) - 64 - len(_END)
        self._hash.update(line[:cut])
        right = split is not None and split[1] == self.digest
        self._hash.update(line[cut:])
        return right


def unlinked(line: bytes) -> tuple[bytes, str] | None:
    """Return a line without its link, and the link. None if the line has no link."""
    found = _TAIL.fullmatch(line, max(0, len(line) - _LENGTH))
    if found is None:
        return None
    return line[: found.start()] + b"}", found[1].decode("ascii")
