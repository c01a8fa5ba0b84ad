"""The versions to compare with: another file, the saved text or a commit."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError
from smsl_studio.front.inputs import read, read_bytes
from smsl_studio.front.revisions import Revision, bytes_at


@dataclass(frozen=True)
class Version:
    """A version of the blueprint, and its name in words."""

    words: str
    blueprint: Blueprint


def in_file(path: Path) -> Version:
    """The blueprint in another file. ReadError if it cannot be read."""
    return Version(path.name, read(path))


def as_saved(text: str | None, file: str, name: str) -> Version:
    """The blueprint as it was last read or saved. UsageError if it was never saved."""
    if text is None:
        raise UsageError(f"{name} was never saved", advice="Save it, or compare with a file.")
    return Version(f"{name}, as saved", read_bytes(text.encode("utf-8", "replace"), file))


def at_revision(path: Path, revision: Revision) -> Version:
    """The blueprint at a commit. Its imports are read from the disk as it is now."""
    blueprint = read_bytes(bytes_at(path, revision), str(path.with_name(Path(revision.name).name)))
    return Version(f"{path.name} at {revision.short}", blueprint)
