"""Floating parts hide the drawing below them, so that no text overlaps other text."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtGui import QColor, QImage, QRegion
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio import read
from smsl_studio.picture.picture import Picture
from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.overlays.key import Key
from smsl_studio.studio.base.overlays.legend import Legend, RunLegend
from smsl_studio.studio.base.theme import DARK, LIGHT, Tokens

BELOW = QColor("#ff00ff")
"""A colour that no theme has, for what is drawn below."""
FAR = 40
"""How far a colour behind a veil may be from the canvas's own, of 255."""


def _key(parent: QWidget, tokens: Tokens) -> QWidget:
    key = Key(parent, tokens)
    key.show_picture(Picture(read(samples_dir() / "hanoi.json"), "SB1"), compact=True)
    return key


def _legend(parent: QWidget, tokens: Tokens) -> QWidget:
    legend = Legend(parent, tokens)
    legend.show_branch(read(samples_dir() / "hfsm.json")["SB1"], {"rise", "guard"})
    return legend


@pytest.mark.parametrize("tokens", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("make", [_key, _legend, RunLegend])
def test_words_over_the_drawing_lie_on_a_veil(
    make: Callable[[QWidget, Tokens], QWidget], tokens: Tokens, qtbot: QtBot
) -> None:
    parent = QWidget()
    qtbot.addWidget(parent)
    overlay = make(parent, tokens)
    image = QImage(overlay.size(), QImage.Format.Format_RGB32)
    image.fill(BELOW)
    overlay.render(image, QPoint(), QRegion(), QWidget.RenderFlag.DrawChildren)
    canvas = tokens.canvas
    for x, y in ((0, 0), (image.width() - 1, 0), (0, image.height() - 1)):
        seen = image.pixelColor(x, y)
        apart = max(
            abs(seen.red() - canvas.red()),
            abs(seen.green() - canvas.green()),
            abs(seen.blue() - canvas.blue()),
        )
        assert apart < FAR, (x, y, seen.name())
