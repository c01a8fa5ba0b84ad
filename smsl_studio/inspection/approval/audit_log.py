"""The audit log of the store: one line for each action with a key or a record.

Each line has a hash of the lines before it. So a changed or removed line is detected. To detect
that lines at the end were cut off, a second file has the number of lines and the last hash.
"""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path
from typing import Any

from smsl_studio.errors import Place, SaveError, SealError
from smsl_studio.inspection.approval.store_files import (
    LARGEST,
    read_stored,
    store_folder,
    write_stored,
)
from smsl_studio.inspection.approval.times import written_time
from smsl_studio.seal.chain import Chain
from smsl_studio.smsl.inputs import NOTHING, seen_at

Json = Any


def append_act(now: datetime, act: str, **said: Json) -> None:
    """Append a line to the audit log. The caller must hold the lock of the store (``store_alone``).

    SealError if somebody has changed the log, SaveError if it cannot be written.
    """
    path = audit_file()
    chain, count = _checked(path)
    line = json.dumps({"time": written_time(now), "act": act, **said}, separators=(",", ":"))
    linked = chain.linked(line.encode("ascii"))
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with path.open("ab", buffering=0) as stream:
            stream.write(linked)
        path.chmod(0o600)
    except OSError as error:
        raise SaveError(f"{path} cannot be written: {error.strerror or error}") from None
    write_stored(_head_file(), {"count": count + 1, "hash": chain.digest})


def audit_file() -> Path:
    """Return the path of the audit log. The file exists only after the first action."""
    return store_folder() / "audit.jsonl"


def _head_file() -> Path:
    return store_folder() / "audit-head.json"


def _checked(path: Path) -> tuple[Chain, int]:
    """Return the chain of hashes of the log, and the number of its lines.

    SealError if somebody has changed the log.
    """
    try:
        found = seen_at(path, LARGEST)
    except OSError as error:
        raise _changed(path, 1, f"it cannot be read: {error.strerror or error}") from None
    chain, count, before = Chain(), 0, ""
    for line in found.raw.splitlines(keepends=True):
        count, before = count + 1, chain.digest
        if not chain.holds(line):
            raise _changed(path, count, "this line was changed, or one before it")
    head = read_stored(_head_file())
    if head is None and found == NOTHING:
        return chain, 0
    # If the program was stopped after it wrote a line, the second file counts one line less.
    late = {"count": count - 1, "hash": before}
    if head not in ({"count": count, "hash": chain.digest}, late):
        raise _changed(path, max(count, 1), "lines at its end were taken away or put there")
    return chain, count


def _changed(path: Path, line: int, words: str) -> SealError:
    return SealError(
        f"the audit log of your store is not what was written: {words}",
        Place(str(path), line, 1),
        "Put back your copy of it, or move it away to begin a new one.",
    )
