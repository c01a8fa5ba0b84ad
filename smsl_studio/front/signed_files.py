"""Reads the signed files for a bundle: record, policy, register and public keys."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.errors import Place, ReadError, SealError
from smsl_studio.front.approval_files import parts_of
from smsl_studio.inspection.approval.policy import read_policy
from smsl_studio.inspection.approval.record_file import SUFFIX, read_record_file, record_beside
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.seal.canonical import canonical
from smsl_studio.smsl.inputs import read_ordinary

MOST = 1 << 30
"""The largest file that is read, in bytes."""


class SignedPaths(NamedTuple):
    """The record and the policy that the user has named.

    None means: the record beside the blueprint, and no policy.
    """

    record: str | None = None
    policy: str | None = None

    @property
    def given(self) -> tuple[str, ...]:
        """The files that the user has named. No output may replace them."""
        return tuple(one for one in self if one is not None)


UNSIGNED = SignedPaths()


def signed_files(
    blueprint: Blueprint,
    paths: SignedPaths,
    names: Mapping[str, str],
    logs: Sequence[bytes] = (),
) -> Iterator[tuple[str, bytes]]:
    """Yield name and bytes of each file that is needed to verify the signatures.

    ``names`` has the name in the bundle of each file of the blueprint. A record has the name of
    its file. ``logs`` have the bytes of the logs, because their heads may be signed. ReadError if
    a file cannot be read.
    """
    heads = [raw.rstrip(b"\n").rpartition(b"\n")[2] for raw in logs]
    signed = [head for head in heads if b',"signed":' in head]
    for file, raw in _records(blueprint, paths.record).items():
        yield f"records/{names[file]}{SUFFIX}", raw
        signed.append(raw)
    if signed:
        yield "keys.json", _keys(b"\n".join(signed))
    if paths.policy is not None:
        yield "policy.toml", bytes_of(paths.policy, "policy")
        policy = read_policy(Path(paths.policy))
        if isinstance(policy, Refusal):
            raise ReadError(policy.sentence, Place(paths.policy, 1, 1), "Mend the policy first.")
        if policy.register_file is not None:
            register = Path(paths.policy).parent / policy.register_file
            yield "register.json", bytes_of(str(register), "register")


def _records(blueprint: Blueprint, named: str | None = None) -> dict[str, bytes]:
    """Return the record of a blueprint by its file, and those of the parts that need one.

    These are the imported files on which a signer relies, and what operations run.
    """
    record = record_beside(blueprint.file) if named is None else named
    found: dict[str, bytes] = {}
    relied: set[str] = set()
    if named is not None or os.path.lexists(record):
        raw = found[blueprint.file] = bytes_of(record, "record")
        relied = _relied_on(raw)
    parts = [part for name, part in parts_of(blueprint) if name in relied] if relied else []
    for part in (*parts, *procedures_of(blueprint).parts):
        if part.file != blueprint.file:
            found = {**_records(part), **found}
    return found


def _relied_on(raw: bytes) -> set[str]:
    """Return the names of the files on which the signers of a record rely."""
    try:
        said = [one.statement.predicate for one in read_record_file(raw)]
    except SealError:
        return set()
    return {file.name for one in said for file in one.relies_on}


def bytes_of(file: str, what: str) -> bytes:
    """Return the bytes of a file. ReadError if it cannot be read or is too large."""
    try:
        raw = read_ordinary(Path(file), MOST).raw
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ReadError(
            f"the {what} cannot be read: {reason}",
            Place(file, 1, 1),
            "Check the path and the right to read it.",
        ) from None
    if len(raw) > MOST:
        raise ReadError(f"the {what} is larger than {MOST >> 20} MB", Place(file, 1, 1))
    return raw


def _keys(signed: bytes) -> bytes:
    """Return the public keys in the user's store that have signed a record, or the head of a log.

    The form is that of a register.
    """
    from smsl_studio.inspection.approval.key_store import stored_keys
    from smsl_studio.seal.strict_json import base64_text

    persons = []
    for key in sorted(stored_keys().values(), key=lambda one: one.identity):
        if key.identity.encode() in signed:
            said = {"person": key.person, "roles": [key.role], "keys": [base64_text(key.public)]}
            persons.append({**said, "revoked": key.revoked} if key.revoked else said)
    return canonical({"persons": persons})
