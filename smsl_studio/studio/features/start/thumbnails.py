"""Thumbnails: what the files of the start page look like, found out in the background.

A recent file may be huge, broken, gone, or on a disk that does not answer. None of that may delay
the window, so files are only read in a second thread, and only small ones.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject

from smsl_studio.errors import StudioError
from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords, approval_words
from smsl_studio.front.former_record import has_record_beside
from smsl_studio.front.inputs import read
from smsl_studio.picture.miniature import Miniature
from smsl_studio.studio.base.beside import Beside

LARGEST = 200_000
"""A larger file has no thumbnail (bytes)."""


@dataclass(frozen=True)
class FileLook:
    """What was found at a path. ``miniature`` is None if no picture can be made of it."""

    exists: bool
    miniature: Miniature | None = None


UNKNOWN = FileLook(True)
NOT_VERIFIED = ApprovalWords("Not verified", ("The file is large. Open it to verify its record.",))


def found_at(path: Path) -> FileLook:
    """What stands at a path, without reading its imports."""
    try:
        size = path.stat().st_size
    except (FileNotFoundError, NotADirectoryError):
        return FileLook(False)
    except (OSError, ValueError):
        return UNKNOWN
    return FileLook(True, _miniature(path) if size <= LARGEST else None)


def trust_at(path: Path, policy: Path | None) -> ApprovalWords | None:
    """The words of the approval badge for a file; None if it cannot be read.

    ``policy`` is the trust policy of its project. A large file is not verified before it is opened.
    """
    unsigned = policy is None and not has_record_beside(str(path))
    try:
        if path.stat().st_size > LARGEST:
            return UNINSPECTED if unsigned else NOT_VERIFIED
        return approval_words(read(path), policy)
    except (OSError, ValueError, StudioError):
        return UNINSPECTED if unsigned else None


def _miniature(path: Path) -> Miniature | None:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.blueprint.reading import branches_of
    from smsl_studio.picture.miniature import miniature_of
    from smsl_studio.smsl.files import read_document

    try:
        document = read_document(os.fspath(path))
        return miniature_of(Blueprint(branches_of(document), document, document.fields))
    except StudioError:
        return None


class Thumbnails(QObject):
    """Looks at one file after the other and hands over what it found."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._beside: Beside | None = None

    def look(self, paths: Iterable[Path], then: Callable[[Path, FileLook], object]) -> None:
        """Look at each file. ``then`` gets the path and what was found."""
        if self._beside is None:
            self._beside = Beside(self)
        for path in paths:
            self._beside.do(partial(found_at, path), partial(then, path))

    def look_at_trust(
        self,
        files: Iterable[tuple[Path, Path | None]],
        then: Callable[[Path, ApprovalWords | None], object],
    ) -> None:
        """Verify the record of each file, with its policy. ``then`` gets the path and the words."""
        if self._beside is None:
            self._beside = Beside(self)
        for path, policy in files:
            self._beside.do(partial(trust_at, path, policy), partial(then, path))

    def stop(self) -> None:
        """Look at no further file."""
        if self._beside is not None:
            self._beside.stop()
            self._beside = None
