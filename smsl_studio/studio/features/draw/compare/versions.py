"""What the blueprint can be compared with: another file, what was last saved, a commit."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError
from smsl_studio.front.inputs import read, read_bytes
from smsl_studio.front.revisions import Revision, bytes_at


@dataclass(frozen=True)
class Version:
    """Another version of the blueprint, and what people call it."""

    words: str
    blueprint: Blueprint


def in_file(path: Path) -> Version:
    """What another file means; ReadError where it cannot be read."""
    return Version(path.name, read(path))


def as_saved(text: str | None, file: str, name: str) -> Version:
    """What stood in the file when it was last read or saved."""
    if text is None:
        raise UsageError(f"{name} was never saved", advice="Save it, or compare with a file.")
    return Version(f"{name}, as saved", read_bytes(text.encode("utf-8", "replace"), file))


def at_revision(path: Path, revision: Revision) -> Version:
    """What stood in the file at a commit. Its imports are those of the disk."""
    blueprint = read_bytes(bytes_at(path, revision), str(path.with_name(Path(revision.name).name)))
    return Version(f"{path.name} at {revision.short}", blueprint)
