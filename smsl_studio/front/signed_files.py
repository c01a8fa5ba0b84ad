"""Reads the signed files for a bundle: record, policy, register and public keys."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePath
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place, ReadError
from smsl_studio.inspection.approval.policy import read_policy
from smsl_studio.inspection.approval.record_file import record_beside
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
    blueprint: Blueprint, paths: SignedPaths, logs: Sequence[bytes] = ()
) -> Iterator[tuple[str, bytes]]:
    """Yield name and bytes of each file that is needed to verify the signatures.

    ``logs`` have the bytes of the logs, because their heads may be signed. ReadError if a file
    cannot be read.
    """
    heads = [raw.rstrip(b"\n").rpartition(b"\n")[2] for raw in logs]
    signed = [head for head in heads if b',"signed":' in head]
    record = paths.record
    if record is None and os.path.lexists(record_beside(blueprint.file)):
        record = record_beside(blueprint.file)
    if record is not None:
        raw = bytes_of(record, "record")
        yield f"records/{PurePath(record).name}", raw
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
