"""Files with the conflict markers of a merge by lines, merged by what they mean."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from smsl_studio.blueprint.merge import Merge, merge
from smsl_studio.blueprint.merge.sides import MergeSides
from smsl_studio.blueprint.merge.two_sided import merge_without_base
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError, StudioError
from smsl_studio.front.inputs import read_bytes
from smsl_studio.front.revisions import unmerged_bytes
from smsl_studio.smsl.document.conflict_markers import unmarked


class MarkedMerge(NamedTuple):
    """The merge of a marked text, and its versions."""

    merge: Merge
    sides: MergeSides


def merge_marked(text: str, file: str, path: Path | None = None) -> MarkedMerge:
    """Merge the versions of a text with conflict markers by what they mean.

    The base is that of the markers (style diff3), else that of git's index, if ``path`` is the file
    of a merge that has not ended. Without both every difference is a conflict. ReadError if markers
    do not belong together, or if a version is no blueprint; its sentence names the version.
    """
    marked = unmarked(text, file)
    ours = _read(marked.ours, file, "mine")
    theirs = _read(marked.theirs, file, "theirs")
    base = _base(marked.base, file, path)
    done = merge_without_base(ours, theirs) if base is None else merge(base, ours, theirs)
    return MarkedMerge(done, MergeSides(ours, theirs, base, by_lines=True))


def _read(text: str, file: str, side: str) -> Blueprint:
    try:
        return read_bytes(text.encode("utf-8", "surrogatepass"), file)
    except ReadError as error:
        # Lines are those of the version, and not those of the marked file.
        line = f", line {error.place.line} of it" if error.place else ""
        raise ReadError(
            f"{side} cannot be read{line}: {error.sentence}",
            advice="Repair that part between the markers in the source. " + error.advice,
        ) from None


def _base(marked: str | None, file: str, path: Path | None) -> Blueprint | None:
    if marked is not None:
        try:
            return read_bytes(marked.encode("utf-8", "surrogatepass"), file)
        except ReadError:
            pass  # The base between the markers may have been edited; git may still have it.
    if path is None:
        return None
    try:
        found = unmerged_bytes(path)[0]
        return read_bytes(found, file) if found is not None else None
    except StudioError:
        return None
