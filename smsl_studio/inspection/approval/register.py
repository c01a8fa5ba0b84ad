"""The register of persons: who may sign, with which keys, in which roles. One key signs it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.known_keys import KnownKey, KnownKeys, name_of
from smsl_studio.inspection.approval.times import begin_of, end_of
from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.seal.ed25519 import LENGTH, identity, is_signed
from smsl_studio.seal.envelope import read_envelope
from smsl_studio.seal.strict_json import from_base64, read_strictly

Json = Any
PAYLOAD_TYPE = "application/vnd.smsl-studio.register+json"


class RegisteredPerson(BaseModel):
    """A person in a register: roles, public keys (base64), and the time in which the entry is
    valid.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, populate_by_name=True)

    person: Annotated[str, Field(min_length=1, max_length=1000)]
    roles: list[Annotated[str, Field(min_length=1, max_length=1000)]]
    keys: list[str]
    since: str | None = Field(default=None, alias="from")
    until: str | None = None


class _Persons(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    version: Literal[1]
    serial: Annotated[int, Field(ge=0, le=2**53 - 1)]
    persons: list[RegisteredPerson]


@dataclass(frozen=True, slots=True)
class Register:
    """A register with a valid signature. ``digest`` is the SHA-256 of its file."""

    serial: int
    keys: KnownKeys
    digest: str


def register_payload(values: Json) -> bytes:
    """Return the bytes of a register that are signed. SealError if the values are no register."""
    _keys_of(_valid(values))
    return canonical(values)  # what is valid is not nested deeply


def read_register(raw: bytes, key: bytes) -> Register:
    """Return the register in the bytes of a file.

    SealError if it is not a register, or if ``key`` has not signed it.
    """
    envelope = read_envelope(read_strictly(raw, "the register"), PAYLOAD_TYPE)
    if not is_signed(envelope, key):
        raise SealError("the register is not signed with the key that the policy names")
    found = _valid(read_strictly(envelope.payload, "the register"))
    return Register(found.serial, _keys_of(found), sha256_hex(raw))


def _valid(values: Json) -> _Persons:
    try:
        return _Persons.model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in fault["loc"])
        raise SealError(f"the register: {where}: {fault['msg']}") from None


def _keys_of(found: _Persons) -> KnownKeys:
    known: dict[str, KnownKey] = {}
    names = [name_of(one.person) for one in found.persons]
    if len(set(names)) < len(names):
        raise SealError("the register names one person twice")
    for one in found.persons:
        since, until = _moments(one)
        for text in one.keys:
            public = from_base64(text, f"a key of {one.person}")
            if len(public) != LENGTH:
                raise SealError(f"a key of {one.person} has not {LENGTH} bytes")
            at = identity(public)
            if at in known:
                raise SealError(f"one key stands twice in the register, for {one.person} too")
            known[at] = KnownKey(public, one.person, tuple(one.roles), since, until)
    return known


def _moments(one: RegisteredPerson) -> tuple[datetime | None, datetime | None]:
    try:
        since = None if one.since is None else begin_of(one.since)
        return since, None if one.until is None else end_of(one.until)
    except ValueError as error:
        raise SealError(f"the register: {one.person}: {error}") from None
