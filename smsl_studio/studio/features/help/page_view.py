"""The page view: one help page, its links, and the way back."""

from __future__ import annotations

import posixpath
from dataclasses import replace

from PySide6.QtCore import Qt, QUrl, Signal
from PySide6.QtGui import QImage, QResizeEvent, QTextCursor, QTextDocument
from PySide6.QtWidgets import QTextBrowser, QTextEdit

from smsl_studio.shipped import docs_dir
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.help.look import blocks, dress, fit_pictures
from smsl_studio.studio.features.help.pages import HelpPlace, file_of, names, page

MARGIN = 28
ABOVE = 12
"""Pixels of the page that stay visible above a section that was asked for."""


class PageView(QTextBrowser):
    """Shows a page at a place. Links to other pages lead there; all others are only told."""

    moved = Signal()
    """Another place is shown."""
    outside = Signal(str)
    """The address of a link that leads out of the help. Nothing was opened."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._sections: dict[str, int] = {}
        self._loaded: tuple[str, Tokens] | None = None
        self._ways: list[tuple[HelpPlace, int]] = []
        self._at = -1
        self._arrived = 0
        self.setObjectName("help_page")
        self.setAccessibleName("Help page")
        FocusLine(self)
        self.setFrameShape(QTextBrowser.Shape.NoFrame)
        self.setOpenLinks(False)
        # The bar does not come and go, because each time the text would be broken anew.
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
        self.anchorClicked.connect(self._follow)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme; the place stays."""
        self._tokens = tokens
        if self.place is not None:
            scroll = self.verticalScrollBar().value()
            self._load(self.place)
            self.verticalScrollBar().setValue(scroll)

    # Where one is.

    @property
    def place(self) -> HelpPlace | None:
        """The place that was asked for last; None at first."""
        return self._ways[self._at][0] if self._ways else None

    @property
    def has_before(self) -> bool:
        """Whether there is a way back."""
        return self._at > 0

    @property
    def has_next(self) -> bool:
        """Whether one has gone back and can go on again."""
        return self._at + 1 < len(self._ways)

    def show_place(self, place: HelpPlace, words: str = "") -> None:
        """Go to a place, and mark the words that were searched for."""
        if page(place.page) is None:
            self.outside.emit(str(file_of(place.page)))
            return
        self._leave()
        del self._ways[self._at + 1 :]
        self._ways.append((place, 0))
        self._at += 1
        self._load(place)
        self._scroll_to(place)
        self._mark(words)
        self.moved.emit()

    def backward(self) -> None:
        """Go back to the place before, as it was left."""
        if self.has_before:
            self._go(-1)

    def forward(self) -> None:
        """Go on to the place from which one went back."""
        if self.has_next:
            self._go(1)

    def _go(self, by: int) -> None:
        self._leave()
        self._at += by
        place, scroll = self._ways[self._at]
        self._load(place)
        self.verticalScrollBar().setValue(scroll)
        self.moved.emit()

    def _leave(self) -> None:
        """Remember how far the present page is scrolled."""
        if self.place is not None:
            self._ways[self._at] = (self.place, self.verticalScrollBar().value())

    # The page.

    def _load(self, place: HelpPlace) -> None:
        self.setExtraSelections([])
        if self._loaded == (place.page, self._tokens):
            return  # A long page takes a second to lay out, and only the place is another one.
        found = page(place.page)
        assert found is not None
        self.setMarkdown(found.markdown)
        self._sections = dress(self.document(), self._tokens)
        self.document().setDocumentMargin(MARGIN)
        self._fit()
        self.setAccessibleDescription(found.title)
        self._loaded = place.page, self._tokens

    def loadResource(self, kind: int, name: QUrl | str) -> object:
        """The pictures of the page, from the folder of the pages and from nowhere else."""
        url = QUrl(name)
        if self.place is None or kind != QTextDocument.ResourceType.ImageResource.value:
            return None
        path = file_of(self._beside(url.path())).resolve()
        inside = url.isRelative() and path.is_relative_to(docs_dir().resolve())
        return QImage(str(path)) if inside else None

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the pictures into the new width, and keep the place, or the line at the top."""
        top = self.cursorForPosition(self.viewport().rect().topLeft()).position()
        unread = self.verticalScrollBar().value() == self._arrived
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width() and self.place is not None:
            self._fit()
            if unread:
                self._scroll_to(self.place)
            else:
                self._scroll(top, 0)

    def _fit(self) -> None:
        fit_pictures(self.document(), max(120, self.viewport().width() - 2 * MARGIN))
        # Without this Qt leaves some paragraphs behind a table without their lines.
        self.document().markContentsDirty(0, self.document().characterCount())

    def _scroll_to(self, place: HelpPlace) -> None:
        begin = self._sections.get(place.anchor, 0)
        if place.word:
            begin = self._position_of(place.word, begin)
        cursor = self.textCursor()
        cursor.setPosition(begin)
        self.setTextCursor(cursor)
        self._scroll(begin, ABOVE if begin else MARGIN)
        self._arrived = self.verticalScrollBar().value()

    def _scroll(self, position: int, above: int) -> None:
        # Qt lays a long page out bit by bit, and asking for its size lays out the rest.
        self.document().size()
        block = self.document().findBlock(position)
        top = self.document().documentLayout().blockBoundingRect(block).top()
        self.verticalScrollBar().setValue(round(top) - above)

    def _position_of(self, word: str, begin: int) -> int:
        """The first paragraph or cell from ``begin`` on that begins with a word."""
        for block in blocks(self.document()):
            rest = block.text()[len(word) : len(word) + 1]
            if block.position() >= begin and block.text().startswith(word) and not rest.isalnum():
                return block.position()
        return begin

    def _mark(self, words: str) -> None:
        """Give a ground to each place of the words that were searched for."""
        marks = []
        for word in words.split():
            cursor = self.document().find(word, 0)
            while not cursor.isNull():
                mark = QTextEdit.ExtraSelection()
                mark.cursor = QTextCursor(cursor)
                mark.format.setBackground(self._tokens.accs)
                mark.format.setForeground(self._tokens.tx)
                marks.append(mark)
                cursor = self.document().find(word, cursor)
        self.setExtraSelections(marks)

    # Links.

    def _follow(self, url: QUrl) -> None:
        place = self.target(url)
        if place is None:
            self.outside.emit(self._address(url))
        else:
            self.show_place(place)

    def target(self, url: QUrl) -> HelpPlace | None:
        """The place in the help to which a link of this page leads; None if it leads out."""
        if self.place is None or not url.isRelative():
            return None
        if not url.path():
            return replace(self.place, anchor=url.fragment(), word="")
        name = self._beside(url.path())
        return HelpPlace(name, url.fragment()) if name in names() else None

    def _address(self, url: QUrl) -> str:
        """Where a link leads that leaves the help: a web address, or a file."""
        if not url.isRelative():
            return url.toString()
        return posixpath.normpath(str(file_of(self._beside(url.path()))))

    def _beside(self, path: str) -> str:
        """A path of the present page as one below the folder of the pages."""
        folder = posixpath.dirname(self.place.page) if self.place is not None else ""
        return posixpath.normpath(posixpath.join(folder, path))
