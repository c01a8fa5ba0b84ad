"""The versions of a file that git is merging: what its index keeps until the merge ends."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.blueprint.merge.sides import MergeSides
from smsl_studio.errors import StudioError
from smsl_studio.front.inputs import read_bytes
from smsl_studio.front.revisions import merging_commits, unmerged_bytes


def versions_in_git(file: Path) -> MergeSides | None:
    """Return base, ours and theirs of a file whose merge has not ended in git. None if there are
    none, or if one of them is no blueprint. ``base`` is None if both sides added the file."""
    try:
        base, ours, theirs = unmerged_bytes(file)
        if ours is None or theirs is None:
            return None
        return MergeSides(
            read_bytes(ours, str(file)),
            read_bytes(theirs, str(file)),
            read_bytes(base, str(file)) if base is not None else None,
            who=merging_commits(file),
        )
    except StudioError:
        return None
