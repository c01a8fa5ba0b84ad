"""``store:DIGEST``: blueprints in the user's own store, looked up by their content.

Each has a folder there, named by its closure digest, with ``files/`` (the blueprint and what it
imports) and ``entry.json``, which says which of them is the blueprint. Nothing else outside a
project is ever imported.
"""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path, PurePath, PurePosixPath

from smsl_studio.blueprint.project import real_path
from smsl_studio.home import user_folder
from smsl_studio.smsl.forms import SUFFIXES
from smsl_studio.smsl.inputs import read_ordinary

PREFIX = "store:"
FILES, ENTRY = "files", "entry.json"
LARGEST = 1 << 24
_HEX = frozenset("0123456789abcdef")


@dataclass(frozen=True, slots=True)
class StoredPlace:
    """A place in the store: the digest of the blueprint, and a file below its folder."""

    digest: str
    below: str

    @property
    def name(self) -> str:
        """The name by which a record calls the file, the same on every computer."""
        return f"{PREFIX}{self.digest}/{self.below}"


def stored_folder() -> Path:
    """Return the folder of the stored blueprints. It exists only after one was added."""
    return user_folder() / "store" / "blueprints"


def digest_named(name: str) -> str:
    """Return the digest in ``store:DIGEST`` or ``store:sha256:DIGEST``, or an empty text."""
    if not name.startswith(PREFIX):
        return ""
    return plain_digest(name.removeprefix(PREFIX))


def plain_digest(text: str) -> str:
    """Return the 64 digits of a SHA-256 as it is written, or an empty text if it is none."""
    plain = text.removeprefix("record:").removeprefix("sha256:").lower()
    return plain if len(plain) == 64 and _HEX.issuperset(plain) else ""


def stored_file(digest: str) -> str:
    """Return the real path of the stored blueprint with this closure digest. Empty if there is
    none, or if its entry is not what Studio writes.
    """
    folder = stored_folder() / digest
    try:
        entry = json.loads(read_ordinary(folder / ENTRY, LARGEST).raw)
    except (OSError, ValueError, RecursionError):
        return ""
    root = entry.get("root") if isinstance(entry, dict) else None
    if not isinstance(root, str) or PurePath(root).suffix.lower() not in SUFFIXES:
        return ""
    pure = PurePosixPath(root)
    if pure.is_absolute() or ".." in pure.parts or "\\" in root or "\0" in root:
        return ""
    real = real_path(str(folder / FILES / root))
    return real if os.path.lexists(real) else ""


def stored_place(file: str) -> StoredPlace | None:
    """Return the place of a file in the store, or None if it stands elsewhere."""
    whole = PurePath(real_path(file))
    try:
        below = whole.relative_to(real_path(str(stored_folder())))
    except ValueError:
        return None
    digest, *rest = below.parts or ("",)
    if not plain_digest(digest) or rest[:1] != [FILES] or len(rest) < 2:
        return None
    return StoredPlace(digest, PurePosixPath(*rest[1:]).as_posix())


def project_in_store(file: str) -> str:
    """Return the folder that holds the imports of a stored file, or an empty text if the file
    stands elsewhere.
    """
    place = stored_place(file)
    return "" if place is None else real_path(str(stored_folder() / place.digest / FILES))
