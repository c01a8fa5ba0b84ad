"""A window comes into its screen with its frame, also where the desktop draws the frame late."""

from __future__ import annotations

from PySide6.QtCore import QByteArray, QPoint, QRect, QTimer
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.studio.shell.frame.screen_room import FRAME_MS, ScreenRoom


class Framed(QWidget):
    """A window whose frame comes some time after it."""

    framed = False

    def frameGeometry(self) -> QRect:
        """With a title of 24 pixels, as soon as there is one."""
        inner = self.geometry()
        return inner.adjusted(-4, -24, 4, 4) if self.framed else inner

    def move(self, *at: object) -> None:
        """Move the corner of this frame; Qt moves that of its own, which is 2 pixels wide."""
        (corner,) = at
        assert isinstance(corner, QPoint)
        super().move(corner + QPoint(2, 22) if self.framed else corner)


def test_the_title_of_a_window_is_on_the_screen_also_if_it_comes_late(qtbot: QtBot) -> None:
    window = Framed()
    qtbot.addWidget(window)
    room = ScreenRoom(window)
    room.restore(QByteArray())
    window.move(QPoint(0, 0))
    window.show()
    room.shown()
    QTimer.singleShot(2 * FRAME_MS, window, lambda: setattr(window, "framed", True))
    qtbot.waitUntil(lambda: window.framed)
    screen = window.screen().availableGeometry()
    qtbot.waitUntil(lambda: screen.contains(window.frameGeometry()))
