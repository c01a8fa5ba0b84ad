"""What the store remembers: records, serials of registers, and the user's revocations."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.case import SeenRecord
from smsl_studio.inspection.approval.record_file import SignedRecord
from smsl_studio.inspection.approval.seen_index import (
    COPY,
    ENTRY,
    ENVELOPE,
    entries,
    newest_entry,
    records_folder,
)
from smsl_studio.inspection.approval.statement import PAYLOAD_TYPE
from smsl_studio.inspection.approval.store_files import read_stored, store_folder, write_stored
from smsl_studio.seal.envelope import read_envelope

Json = Any
NO_COPY: Mapping[str, str] = MappingProxyType({})


def keep_record(
    record: SignedRecord, person: str, file: str, copy: Mapping[str, str] = NO_COPY
) -> None:
    """Remember that a record was seen for a file. The caller must hold the lock of the store.

    ``person`` is the name of the signer for comparison (see ``name_of``). ``copy`` has what is
    known of a copy that was signed (see ``COPY``).
    """
    if has_seen(record.digest):
        return
    said = record.statement.predicate
    path = records_folder() / record.digest
    write_stored(path.with_suffix(ENVELOPE), record.envelope.as_json())
    write_stored(
        path.with_suffix(ENTRY),
        {
            "person": person,
            "key": record.envelope.keyid,
            "file": os.path.realpath(file),
            "follows": said.follows,
            "time": said.time,
            "closure": record.statement.digests.closure,
            **copy,
        },
    )


def seen_records() -> tuple[SeenRecord, ...]:
    """Return all records that were seen."""
    return tuple(
        SeenRecord(
            one["key"],
            digest,
            one["follows"],
            one["file"],
            *(one.get(key, "") for key in COPY),
        )
        for digest, one in entries()
    )


def has_seen(digest: str) -> bool:
    """Whether a record was seen before."""
    return (records_folder() / f"{digest}{ENTRY}").exists()


def newest_seen(file: str, closure: str = "", person: str | None = None) -> SignedRecord | None:
    """Return the newest record that was seen (see ``newest_entry``), or None.

    SealError if the stored record does not have the digest of its entry.
    """
    digest = newest_entry(file, closure, person)
    return seen_record(digest) if digest else None


def seen_record(digest: str) -> SignedRecord:
    """Return a record that was seen.

    SealError if the stored record does not have the digest of its entry.
    """
    path = records_folder() / f"{digest}{ENVELOPE}"
    found = SignedRecord.of(read_envelope(read_stored(path), PAYLOAD_TYPE))
    if found.digest != digest:
        raise SealError(f"{path} is not what Studio wrote", advice="Put back your copy of it.")
    return found


def seen_serial(key: str) -> int:
    """Return the highest serial that was seen of the registers of a key. -1 if none was seen."""
    found = _serials().get(key, -1)
    return found if isinstance(found, int) else -1


def keep_serial(key: str, serial: int) -> None:
    """Remember the serial of a register. The caller must hold the lock of the store."""
    serials = dict(_serials())
    if serials.get(key, -1) < serial:
        write_stored(_serials_file(), {**serials, key: serial})


def revoked_digests() -> Mapping[str, str]:
    """Return the digests that this user has revoked, with the reasons."""
    return {one["digest"]: one["why"] for one in _revocations()}


def revoke_digest(digest: str, why: str, key: str, time: str) -> None:
    """Revoke a digest. The caller must hold the lock of the store."""
    new = {"digest": digest, "why": why, "key": key, "time": time}
    write_stored(_revoked_file(), [*_revocations(), new])


def _revocations() -> list[Mapping[str, str]]:
    found = read_stored(_revoked_file())
    listed = [] if found is None else found
    if not isinstance(listed, list) or not all(_is_revocation(one) for one in listed):
        raise SealError(f"{_revoked_file()} is not what Studio wrote")
    return listed


def _is_revocation(one: Json) -> bool:
    return isinstance(one, dict) and {"digest", "why"} <= set(one)


def _serials() -> Mapping[str, Json]:
    found = read_stored(_serials_file())
    if found is not None and not isinstance(found, dict):
        raise SealError(f"{_serials_file()} is not what Studio wrote")
    return found or {}


def _serials_file() -> Path:
    return store_folder() / "registers.json"


def _revoked_file() -> Path:
    return store_folder() / "revoked.json"
