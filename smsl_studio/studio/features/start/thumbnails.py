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

import numpy as np
from PySide6.QtCore import QObject, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from smsl_studio.errors import StudioError
from smsl_studio.picture.miniature import Miniature
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens

LARGEST = 200_000
"""A larger file has no thumbnail (bytes)."""
MARGIN = 9.0
FEW = 12
"""Up to so many states are drawn as boxes, more as dots."""


@dataclass(frozen=True)
class FileLook:
    """What was found at a path. ``miniature`` is None if no picture can be made of it."""

    exists: bool
    miniature: Miniature | None = None


UNKNOWN = FileLook(True)


def found_at(path: Path) -> FileLook:
    """What stands at a path, without reading its imports."""
    try:
        size = path.stat().st_size
    except (FileNotFoundError, NotADirectoryError):
        return FileLook(False)
    except (OSError, ValueError):
        return UNKNOWN
    return FileLook(True, _miniature(path) if size <= LARGEST else None)


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

    def stop(self) -> None:
        """Look at no further file."""
        if self._beside is not None:
            self._beside.stop()
            self._beside = None


def paint_miniature(
    painter: QPainter, box: QRectF, drawn: Miniature | None, tokens: Tokens
) -> None:
    """Paint a small drawing into a box; a file's icon if there is none."""
    if drawn is None:
        side = min(20.0, box.height() / 2)
        middle = box.center()
        spot = QRectF(middle.x() - side / 2, middle.y() - side / 2, side, side)
        draw(painter, "file", spot, tokens.nl, tokens.canvas)
        return
    few = len(drawn.places) <= FEW and box.height() > 60
    size = np.array([26.0, 15.0] if few else [4.0, 4.0] if len(drawn.places) <= 100 else [2.0, 2.0])
    wide, tall = box.width() - 2 * MARGIN - size[0], box.height() - 2 * MARGIN - size[1]
    at = drawn.within(wide, tall) + (box.left() + MARGIN, box.top() + MARGIN) + size / 2
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(tokens.edge, 1.0))
    batch.draw_lines(painter, np.hstack([at[drawn.lines[:, 0]], at[drawn.lines[:, 1]]]))
    painter.setPen(QPen(tokens.nl, 1.2) if few else Qt.PenStyle.NoPen)
    for number, (x, y) in enumerate(at.tolist()):
        last = number == drawn.activating
        if few:
            painter.setPen(QPen(tokens.acc if last else tokens.nl, 1.2))
            painter.setBrush(tokens.accs if last else tokens.surf)
        else:
            painter.setBrush(tokens.acc if last else tokens.slate)
        spot = QRectF(x - size[0] / 2, y - size[1] / 2, float(size[0]), float(size[1]))
        painter.drawRoundedRect(spot, RADIUS_CONTROL - 2 if few else 1, RADIUS_CONTROL - 2)
    painter.restore()
