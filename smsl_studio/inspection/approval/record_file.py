"""The record file: ``{"records": [envelope, ...]}``, one envelope a signer, in order of signing.

The bytes must be those that Studio writes for the same values: one line of JSON. The newline at
its end may be missing.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
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
    """One record: its envelope, and the statement in it. ``digest`` names the record."""

    envelope: Envelope
    statement: Statement
    digest: str

    @classmethod
    def of(cls, envelope: Envelope) -> SignedRecord:
        """Return the record in an envelope. SealError if it is not as Studio writes it."""
        statement = read_statement(envelope.payload)
        return cls(envelope, statement, payload_digest(envelope.payload))


def record_beside(file: str) -> str:
    """Return the usual name of the record of a blueprint's file."""
    return f"{file}{SUFFIX}"


def read_record_file(raw: bytes) -> tuple[SignedRecord, ...]:
    """Return the records in the bytes of a file. SealError if they are not as Studio writes them.

    Signatures are not checked here.
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
