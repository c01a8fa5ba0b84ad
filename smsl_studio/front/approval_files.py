"""Reads the files of an approval: blueprint, record, policy and register."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePath

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.stored import stored_place
from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.case import TrustGrounds
from smsl_studio.inspection.approval.policy import USUAL, TrustPolicy, read_policy
from smsl_studio.inspection.approval.record_file import SignedRecord, read_record_file
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.seen_records import (
    keep_serial,
    revoked_digests,
    seen_records,
    seen_serial,
)
from smsl_studio.inspection.approval.statement import SignedDigests, SignedFile
from smsl_studio.inspection.approval.store_files import store_alone
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.seal.strict_json import LARGEST
from smsl_studio.smsl.inputs import read_ordinary


@dataclass(frozen=True, slots=True)
class TrustFiles:
    """What the policy and the store say, with the SHA-256 of the files that were read.

    ``keys`` says in words whose keys count. ``serial`` is the serial number of the register.
    """

    grounds: TrustGrounds
    policy: str | None = None
    register: str | None = None
    serial: int | None = None

    @property
    def keys(self) -> str:
        """Whose keys count, in words."""
        if self.grounds.registered:
            return f"keys of a register with the serial {self.serial}"
        return "keys of this computer, not of a register"


@dataclass(frozen=True, slots=True)
class RecordFile:
    """The records in a file, and the SHA-256 of the file. A refusal if there are none."""

    records: tuple[SignedRecord, ...] | Refusal
    digest: str | None = None
    raw: bytes = field(default=b"", repr=False)


def name_in(blueprint: Blueprint, file: str) -> str:
    """Return the path of a file relative to the folder of the blueprint.

    A file of the store that is imported is called by its digest, which is the same everywhere.
    """
    place = stored_place(file) if file != blueprint.file else None
    if place is not None:
        return place.name
    folder = os.path.dirname(blueprint.file) or "."  # noqa: PTH120
    return PurePath(os.path.relpath(file, folder)).as_posix()


def parts_of(blueprint: Blueprint) -> Iterator[tuple[str, Blueprint]]:
    """Yield each file of the blueprint and its imports, as a blueprint with its name.

    The first one is the blueprint itself. Nothing is read from the disk.
    """
    yield name_in(blueprint, blueprint.file), blueprint
    for document in blueprint.documents[1:]:
        part = read_blueprint(document, opened=blueprint.documents)
        yield name_in(blueprint, document.file), part


def signed_file(name: str, blueprint: Blueprint) -> SignedFile:
    """Return the name and the digests of a file, in the form of a record."""
    return SignedFile(name=name, digest=SignedDigests(**digests(blueprint).as_json()))


def record_in(path: Path) -> RecordFile:
    """Return the records in a file."""
    try:
        raw = read_ordinary(path, LARGEST).raw
    except FileNotFoundError:
        return RecordFile(Refusal("no_record", f"there is no record {path}"))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        words = f"the record {path} cannot be read: {reason}"
        return RecordFile(Refusal("no_record", words))
    digest = sha256_hex(raw)
    try:
        return RecordFile(read_record_file(raw), digest, raw)
    except SealError as error:
        return RecordFile(Refusal("signature_invalid", f"{path}: {error.sentence}"), digest, raw)


def trust_files(policy: Path | None) -> TrustFiles | Refusal:
    """Return whose signatures count, according to the policy and the store.

    PluginError if the file of the policy cannot be read.
    """
    if policy is None:
        return TrustFiles(_stored(USUAL, given=False))
    raw = _bytes(policy)
    found = read_policy(policy, raw)
    if isinstance(found, Refusal):
        return found
    digest = sha256_hex(raw or b"")
    if found.register_file is None:
        return TrustFiles(_stored(found, given=True), digest)
    return _registered(found, policy, digest)


def _bytes(path: Path) -> bytes | None:
    """Return the bytes of a policy; None if the reader of policies tells why there are none."""
    try:
        return read_ordinary(path, LARGEST).raw
    except (OSError, ValueError):
        return None


def _stored(policy: TrustPolicy, given: bool) -> TrustGrounds:
    from smsl_studio.inspection.approval.key_store import stored_keys

    keys = {key.identity: key.known for key in stored_keys().values()}
    return TrustGrounds(policy, keys, False, given, seen_records(), revoked_digests())


def _registered(policy: TrustPolicy, file: Path, digest: str) -> TrustFiles | Refusal:
    from smsl_studio.inspection.approval.register import read_register

    assert policy.register_file is not None
    assert policy.register_key is not None
    path = file.parent / policy.register_file
    try:
        register = read_register(read_ordinary(path, LARGEST).raw, policy.key)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        return Refusal("register_invalid", f"the register {path} cannot be read: {reason}")
    except SealError as error:
        return Refusal("register_invalid", f"{path}: {error.sentence}")
    before = seen_serial(policy.register_key)
    if register.serial < before:
        words = f"the register has the serial {register.serial}, and {before} was seen before"
        return Refusal("register_invalid", words)
    if register.serial > before:
        with store_alone():
            keep_serial(policy.register_key, register.serial)
    grounds = TrustGrounds(policy, register.keys, True, True, seen_records())
    return TrustFiles(grounds, digest, register.digest, register.serial)
