"""The recorded runs that belong into the evidence of a blueprint."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.recordings import recordings_in
from smsl_studio.front.signed_files import bytes_of
from smsl_studio.front.verifier import told_again
from smsl_studio.seal.digest import sha256_hex


def runs_of(blueprint: Blueprint, folder: Path, most: int = 30) -> tuple[Path, ...]:
    """Return which of the newest ``most`` recordings of a folder are runs of this blueprint.

    The file must have been as it is now, byte for byte, and the story must follow from it: only
    such a log is accepted by the ``verify.py`` of a bundle.
    """
    return tuple(path for path in recordings_in(folder, most) if _is_of(blueprint, path))


def _is_of(blueprint: Blueprint, path: Path) -> bool:
    with suppress(StudioError):
        raw = bytes_of(str(path), "run log")
        if not told_again(raw, blueprint):
            header = json.loads(raw[: raw.index(b"\n")])
            return bool(header["digests"]["file"] == sha256_hex(blueprint.document.encoded()))
    return False
