"""The recent files of the start page."""

from __future__ import annotations

from datetime import datetime, timedelta
from pathlib import Path

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPen
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.front.approval_badge import LOOKING, ApprovalWords
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.badge import BadgeLook, badge_width
from smsl_studio.studio.base.paint.miniature_paint import paint_miniature
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens, text_font
from smsl_studio.studio.features.start.thumbnails import UNKNOWN, FileLook
from smsl_studio.studio.features.start.tile import Tile

HIGH, PITCH = 79, 87
FIRST = 4
"""So many rows are shown until "Show all"."""


def opened_words(then: datetime | None, now: datetime) -> str:
    """When a file was opened, such as ``Opened today, 08:12``; empty if that is not known."""
    if then is None:
        return ""
    day = {now.date(): "today", now.date() - timedelta(days=1): "yesterday"}.get(then.date())
    if day:
        return f"Opened {day}, {then:%H:%M}"
    return f"Opened {then.day} {then:%b %Y}"


def folder_words(path: Path) -> str:
    """The folder of a file, with ``~`` for the home folder."""
    folder = path.parent
    if folder.is_relative_to(Path.home()):
        return str(Path("~") / folder.relative_to(Path.home()))
    return str(folder)


class RecentRow(Tile):
    """One recent file: thumbnail, name, folder, and when it was opened."""

    def __init__(self, path: Path, opened: str, tokens: Tokens, parent: QWidget) -> None:
        self.path, self.found, self.opened = path, UNKNOWN, opened
        self.trust: ApprovalWords | None = LOOKING
        super().__init__(path.name, f"{folder_words(path)}. {opened}", tokens, parent)
        self.tip(str(path))
        self.remove = QPushButton("Remove", self)
        self.remove.setProperty("role", "link")
        self.remove.setAccessibleName(plain_text(f"Remove {path.name} from the recent files"))
        self.remove.hide()

    def show_found(self, found: FileLook) -> None:
        """Show the thumbnail, or that the file is gone."""
        self.found = found
        self.remove.setVisible(not found.exists)
        self._describe()

    def show_trust(self, said: ApprovalWords | None) -> None:
        """Show whether people have signed the file; None if it cannot be read."""
        self.trust = said
        self._describe()

    def _describe(self) -> None:
        words = [folder_words(self.path), self.last_line, self.badge_words]
        self.setAccessibleDescription(plain_text(". ".join(filter(None, words))))
        self.update()

    @property
    def badge_words(self) -> str:
        """What the badge of trust says; empty if the file cannot be read."""
        return self.trust.words if self.trust is not None and self.found.exists else ""

    @property
    def last_line(self) -> str:
        """What the last line says."""
        return self.opened if self.found.exists else "Not found"

    def paint_ground(self, painter: QPainter) -> None:
        """Paint nothing, or a pale ground under the pointer: the list is one card."""
        if self.underMouse():
            painter.fillRect(self.rect(), self.tokens.sunk)

    def paint_content(self, painter: QPainter) -> None:
        """Paint the thumbnail and three lines."""
        tokens = self.tokens
        frame = QRectF(8.5, 15.5, 71, 47)
        painter.setPen(QPen(tokens.line, 1))
        painter.setBrush(tokens.canvas)
        painter.drawRoundedRect(frame, RADIUS_CONTROL, RADIUS_CONTROL)
        paint_miniature(painter, frame, self.found.miniature, tokens)
        room = self.width() - 96 - 12
        badge = self._paint_badge(painter)
        painter.setPen(tokens.tx if self.found.exists else tokens.tx3)
        self.say(painter, QRectF(96, 9, room - badge, 20), self.path.name, 13, 600)
        painter.setPen(tokens.tx2)
        self.say(painter, QRectF(96, 31, room, 18), folder_words(self.path), 12)
        self.say(painter, QRectF(96, 49, room - 70, 18), self.last_line, 12)
        self.remove.adjustSize()
        self.remove.move(self.width() - self.remove.width() - 10, 46)

    def _paint_badge(self, painter: QPainter) -> float:
        """Paint the badge of trust at the right of the name; returns the width that it takes."""
        if not self.badge_words or self.trust is None:
            return 0.0
        tokens, good, font = self.tokens, self.trust.is_good, text_font(11, 500)
        wide = badge_width(self.badge_words, font)
        ink, ground = (tokens.ok, tokens.oks) if good else (tokens.risk, tokens.risks)
        box = QRectF(self.width() - wide - 11.5, 9.5, wide, 20)
        BadgeLook("shield", ink, ground, not good).paint(painter, box, self.badge_words, font)
        return wide + 8.0
