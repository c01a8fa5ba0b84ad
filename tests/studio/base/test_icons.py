"""Every icon can be painted, at any size and in both themes."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.base.icon_drawings import ICONS
from smsl_studio.studio.base.icons import draw, icon, pixmap
from smsl_studio.studio.base.theme import DARK, LIGHT


@pytest.mark.parametrize("name", sorted(ICONS))
def test_every_icon_leaves_ink(name: str, qapp: QApplication) -> None:
    picture = pixmap(name, QColor("black"), QColor("white"), 16, 2.0).toImage()
    assert picture.size() == QSize(32, 32)
    inked = sum(picture.pixelColor(x, y).alpha() > 60 for x in range(32) for y in range(32))
    assert 8 < inked < 32 * 32


def test_an_icon_that_there_is_not_is_refused_before_anything_is_painted(
    qapp: QApplication,
) -> None:
    for name in ("", "no such icon"):
        with pytest.raises(ValueError, match="there is no icon"):
            icon(name, LIGHT)
        picture = QPixmap(16, 16)
        picture.fill(QColor("white"))
        painter = QPainter(picture)
        with pytest.raises(ValueError, match="there is no icon"):
            draw(painter, name, QRectF(0, 0, 16, 16), QColor("black"), QColor("white"))
        # One ``restore`` too few would leave a state behind, of which Qt complains here.
        assert painter.end()


def test_a_disabled_icon_is_pale(qapp: QApplication) -> None:
    for tokens in (LIGHT, DARK):
        made = icon("plus", tokens)
        plain = made.pixmap(16, 16, QIcon.Mode.Normal).toImage()
        pale = made.pixmap(16, 16, QIcon.Mode.Disabled).toImage()
        assert plain != pale
