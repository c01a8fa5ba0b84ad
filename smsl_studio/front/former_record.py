"""Finds the newest record of a file, and what has changed since (R27). It checks no signatures."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place, ReadError, SealError
from smsl_studio.home import user_folder
from smsl_studio.inspection.rules.finding import Finding


def may_have_record(file: str) -> bool:
    """Whether a record of this file may exist. This is quick, because no record is read."""
    return has_record_beside(file) or os.path.lexists(user_folder() / "store" / "records")


def has_record_beside(file: str) -> bool:
    """Whether a record stands beside this file. Nothing is read."""
    return os.path.lexists(f"{file}.record.json")


def approval_stamps(file: str, policy: Path | None) -> tuple[object, ...]:
    """Return a value that changes with the record of a file, with a policy, and with the keys and
    revocations of the store. Nothing is read."""
    store = user_folder() / "store"
    others = () if policy is None else (policy,)
    return tuple(map(file_stamp, (Path(f"{file}.record.json"), store / "revoked.json",
                              store / "keys", *others)))  # fmt: skip


def file_stamp(file: Path) -> tuple[int, int, int] | None:
    """Return a value that changes when a file or a folder is written. None if there is none."""
    try:
        found = file.stat()
    except (OSError, ValueError):
        return None
    return found.st_ino, found.st_size, found.st_mtime_ns


def changes_since_record(
    blueprint: Blueprint, record: str | None = None
) -> tuple[str, tuple[Finding, ...]]:
    """Return the name of the newest record of a blueprint, and the changes since it was signed.

    The arguments are those of ``newest_content``. If there is no record, both results are empty.
    """
    from smsl_studio.inspection.against import inspect_against_content

    name, content = newest_content(blueprint, record)
    return name, () if content is None else inspect_against_content(blueprint, content, name)


def newest_content(
    blueprint: Blueprint, record: str | None = None
) -> tuple[str, Mapping[str, Any] | None]:
    """Return the name of the newest record of a blueprint, and the content that was signed.

    ``record`` is the file of a record. None means the record beside the blueprint, or one in the
    store. If there is no record, the name is empty and the content None. ReadError if a record
    cannot be read.
    """
    from smsl_studio.inspection.approval.seen_index import newest_entry

    beside = has_record_beside(blueprint.file)
    try:
        if record is None and not beside and not newest_entry(blueprint.file):
            return "", None
    except SealError as error:
        raise ReadError(error.sentence, error.place or Place(blueprint.file, 1, 1)) from None
    from smsl_studio.inspection.approval.record_file import (
        SignedRecord,
        read_record_file,
        record_path,
    )
    from smsl_studio.inspection.approval.seen_records import newest_seen
    from smsl_studio.seal.strict_json import LARGEST
    from smsl_studio.smsl.inputs import read_ordinary

    path = record_path(blueprint.file, record)
    found: Sequence[SignedRecord] = ()
    try:
        if record is not None or os.path.lexists(path):
            found = read_record_file(read_ordinary(path, LARGEST).raw)
        newest = found[-1] if found else None
        seen = newest_seen(blueprint.file) if record is None else None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ReadError(f"the record cannot be read: {reason}", Place(str(path), 1, 1)) from None
    except SealError as error:
        raise ReadError(error.sentence, error.place or Place(str(path), 1, 1)) from None
    if seen is not None and (newest is None or newest.statement.time < seen.statement.time):
        newest = seen
    if newest is None:
        return "", None
    said = newest.statement.predicate
    name = f"the record of {said.person} of {said.time[:19]}Z"
    return name, said.content[newest.statement.subject[0].name]
