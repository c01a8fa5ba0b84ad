"""Says whether this computer signs its logs. ``cryptography`` is loaded only if it does."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any

from smsl_studio.inspection.approval.store_files import store_folder

Seal = Callable[[bytes], Mapping[str, Any]]
VARIABLE = "SMSL_PASSPHRASE"


def has_recorder() -> bool:
    """Return whether a key of the store may be that of a recorder. Files are looked at quickly."""
    try:
        files = [one for one in (store_folder() / "keys").iterdir() if one.suffix == ".json"]
        return any(b"recorder" in one.read_bytes().lower() for one in files)
    except OSError:
        return False


def recorder_name() -> str:
    """Return the local name of the key with which this computer signs logs; empty without one.

    SealError if the store is not believed.
    """
    if not has_recorder():
        return ""
    from smsl_studio.inspection.approval.log_seal import recorder_key

    key = recorder_key()
    return "" if key is None else key.id


def seal_of_logs(passphrase: bytes = b"") -> Seal | None:
    """Return what signs the head of a log. None if no recorder's key is configured, or if there is
    no passphrase for it.

    Without a ``passphrase`` that of ``SMSL_PASSPHRASE`` counts. SealError if it is wrong.
    """
    words = passphrase or os.environ.get(VARIABLE, "").encode("utf-8", "surrogateescape")
    if not words or not has_recorder():
        return None
    from smsl_studio.inspection.approval.log_seal import log_seal, recorder_key

    key = recorder_key()
    return None if key is None else log_seal(key, words)
