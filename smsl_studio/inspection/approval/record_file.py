"""The record file: ``{"records": [envelope, ...]}``. Each signer adds one envelope at the end.

The file is one line of JSON. Its bytes must be exactly those that Studio writes for the same
values. Only the newline at its end may be missing.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.statement import (
    PAYLOAD_TYPE,
    Statement,
    payload_digest,
    read_statement,
)
from smsl_studio.seal.envelope import Envelope, read_envelope
from smsl_studio.seal.strict_json import read_strictly

Json = Any
MOST = 1000
"""The largest number of records in a file."""

SUFFIX = ".record.json"


@dataclass(frozen=True, slots=True)
class SignedRecord:
    """One record: its envelope and its statement. ``digest`` is the SHA-256 that names it."""

    envelope: Envelope
    statement: Statement
    digest: str

    @classmethod
    def of(cls, envelope: Envelope) -> SignedRecord:
        """Return the record in an envelope. SealError if Studio would write it differently."""
        statement = read_statement(envelope.payload)
        return cls(envelope, statement, payload_digest(envelope.payload))


def record_beside(file: str) -> str:
    """Return the path of the record that stands beside a blueprint's file."""
    return f"{file}{SUFFIX}"


def record_path(file: str, named: str | Path | None) -> Path:
    """Return where the record of a blueprint's file stands: as named, else beside the file."""
    return Path(record_beside(file) if named is None else named)


def read_record_file(raw: bytes) -> tuple[SignedRecord, ...]:
    """Return the records in the bytes of a file, without a check of their signatures.

    SealError if Studio would write the file differently.
    """
    values = read_strictly(raw, "the record")
    if not isinstance(values, dict) or set(values) != {"records"}:
        raise SealError('the record is not of the form {"records": [...]}')
    listed = values["records"]
    if not isinstance(listed, list) or len(listed) > MOST:
        raise SealError("the record has no list of signed records")
    envelopes = [read_envelope(one, PAYLOAD_TYPE) for one in listed]
    if raw.removesuffix(b"\n") != _written(envelopes):
        raise SealError("the record is not written as Studio writes it")
    return tuple(map(SignedRecord.of, envelopes))


def written_record_file(records: Iterable[Envelope]) -> bytes:
    """Return the bytes of a record file."""
    return _written(records) + b"\n"


def _written(records: Iterable[Envelope]) -> bytes:
    return json.dumps({"records": [one.as_json() for one in records]}).encode("ascii")
