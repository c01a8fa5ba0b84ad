"""Pans a canvas in odd steps, and prints the largest difference to a canvas that is painted anew.

It is run as a process of its own, because the scale of a screen is chosen once.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.shell.application import make_application


def seen(canvas: Canvas) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    """The pixels that stand on the screen."""
    QApplication.processEvents()
    image = QApplication.primaryScreen().grabWindow(canvas.winId()).toImage()
    return np.frombuffer(bytes(image.constBits()), np.uint8).astype(np.int64)


def worst_difference(path: Path) -> int:
    """The largest difference of a colour after any of the pans."""
    blueprint, canvas = read_blueprint(read_document(path)), Canvas(LIGHT)
    canvas.resize(601, 403)
    canvas.show_branch(blueprint, next(iter(blueprint.branches)))
    canvas.show()
    canvas.zoom_to(1.0)
    worst = 0
    for across, down in ((7, 0), (0, 7), (-13, 5), (101, -33), (-3, -91), (1, 1)):
        canvas.camera.pan(across, down)
        found = seen(canvas)
        canvas.resetCachedContent()
        canvas.viewport().update()
        worst = max(worst, int(np.abs(found - seen(canvas)).max()))
    return worst


if __name__ == "__main__":
    application = make_application([])
    print(worst_difference(Path(sys.argv[1])))
