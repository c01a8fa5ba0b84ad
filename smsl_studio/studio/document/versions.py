"""The versions to compare with: another file, the saved text or a commit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.comparison import Difference, compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.recorded import blueprint_of_content
from smsl_studio.errors import UsageError
from smsl_studio.front.former_record import newest_content
from smsl_studio.front.inputs import read, read_bytes
from smsl_studio.front.revisions import Revision, bytes_at
from smsl_studio.inspection.against import since_content
from smsl_studio.picture.aligned import as_drawn


@dataclass(frozen=True)
class Version:
    """A version of the blueprint, and its name in words."""

    words: str
    blueprint: Blueprint

    def until(self, after: Blueprint) -> Difference:
        """Return the difference from this version to a later one."""
        return as_drawn(compare(self.blueprint, after))


@dataclass(frozen=True)
class SignedVersion(Version):
    """The content of a record. It has no layout, so it is drawn where the later version stands."""

    content: Mapping[str, Any]

    def until(self, after: Blueprint) -> Difference:
        """Return what has changed of the meaning since it was signed, removals first."""
        found = since_content(after, self.content, self.words)
        # A content has no lines that anybody could look up.
        changes = tuple(replace(one, path_before=()) for one in found.changes)
        return replace(found, changes=changes)


def in_file(path: Path) -> Version:
    """The blueprint in another file. ReadError if it cannot be read."""
    return Version(path.name, read(path))


def as_saved(text: str | None, file: str, name: str) -> Version:
    """The blueprint as it was last read or saved. UsageError if it was never saved."""
    if text is None:
        raise UsageError(f"{name} was never saved", advice="Save it, or compare with a file.")
    return Version(f"{name}, as saved", read_bytes(text.encode("utf-8", "replace"), file))


def as_signed(blueprint: Blueprint) -> Version:
    """The blueprint as it was last signed. UsageError if nobody has signed it."""
    name, content = newest_content(blueprint)
    if content is None:
        raise UsageError(
            f"nobody has signed {Path(blueprint.file).name}", advice="Approve it first."
        )
    return SignedVersion(f"as in {name}", blueprint_of_content(content, name), content)


def at_revision(path: Path, revision: Revision) -> Version:
    """The blueprint at a commit. Its imports are read from the disk as it is now."""
    blueprint = read_bytes(bytes_at(path, revision), str(path.with_name(Path(revision.name).name)))
    return Version(f"{path.name} at {revision.short}", blueprint)
