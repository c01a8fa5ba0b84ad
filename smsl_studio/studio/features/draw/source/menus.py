"""The menus of the text: quick fixes (also from the bulb) and the context menu."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPoint
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QApplication, QMenu, QToolButton

from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.features.draw.source.editor import Editor
from smsl_studio.studio.features.draw.source.repairs import TextRepair
from smsl_studio.studio.features.draw.source.source_text import SourceText

SIDE = 18


class Bulb(QToolButton):
    """The button after the caret's line, shown while something in that line can be fixed."""

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor.viewport())
        self._editor = editor
        self.setProperty("role", "small")
        self.setFixedSize(SIDE + 2, SIDE)
        self.setAccessibleName("Quick fixes")
        editor.reshaped.connect(self._follow)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.setIcon(icon("bulb", tokens, colour=tokens.risk))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a background first, because a long line continues below the button."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), self.palette().base())
        painter.end()
        super().paintEvent(event)

    def show_for(self, repairs: Sequence[TextRepair]) -> None:
        """Show the bulb if there are fixes, with their words as tip."""
        self.setVisible(bool(repairs))
        if repairs:
            self.setToolTip(tip_text("\n".join((*(one.words for one in repairs), "(Ctrl+.)"))))
            self._place()

    def _follow(self) -> None:
        if self.isVisible():
            self._place()

    def _place(self) -> None:
        """Place it after the line.

        If there is no room, at the right edge, one row above or below.
        """
        editor, cursor = self._editor, self._editor.textCursor()
        row = editor.cursorRect(cursor)
        cursor.movePosition(cursor.MoveOperation.EndOfBlock)
        left, edge = editor.cursorRect(cursor).right() + 8, editor.viewport().width() - self.width()
        top = row.center().y() - SIDE // 2
        if left > edge - 2:
            left, top = edge - 2, top + (row.height() if top < row.height() else -row.height())
        self.move(left, top)


def repair_menu(text: SourceText, repairs: Sequence[TextRepair]) -> QMenu:
    """A menu of fixes."""
    menu = _passing(text)
    _add_repairs(menu, repairs)
    return menu


def text_menu(
    text: SourceText,
    repairs: Sequence[TextRepair],
    at: QPoint,
    jump: Callable[[int, int], object],
) -> QMenu:
    """The context menu. ``jump`` goes to the element that the name at (line, column) refers to."""
    editor, menu = text.editor, _passing(text)
    _add_repairs(menu, repairs)
    if repairs:
        menu.addSeparator()
    marked, free = editor.textCursor().hasSelection(), not editor.isReadOnly()
    pasted = QApplication.clipboard().mimeData()
    place = editor.place_of(editor.cursorForPosition(at))
    leads = text.elements.definition(*place) is not None
    for words, call, enabled in (
        ("Cut", editor.cut, marked and free),
        ("Copy", editor.copy, marked),
        ("Paste", editor.paste, free and editor.canInsertFromMimeData(pasted)),
        ("Select all", editor.selectAll, True),
        ("", None, False),
        (
            "Go to what this stands for",
            lambda: jump(*place),
            leads,
        ),
        ("Fold", lambda: text.folding.fold_line(place[0]), text.folding.can_fold(place[0])),
        ("Fold every State Branch", text.folding.fold_all, True),
        ("Unfold everything", text.folding.unfold_all, bool(editor.folds.all)),
        ("", None, False),
        ("Find…", lambda: text.find_bar.open_bar(False), True),
        ("Replace…", lambda: text.find_bar.open_bar(True), free),
    ):
        if call is None:
            menu.addSeparator()
        else:
            menu.addAction(words, call).setEnabled(enabled)
    return menu


def _add_repairs(menu: QMenu, repairs: Sequence[TextRepair]) -> None:
    for repair in repairs:
        menu.addAction(as_it_is(repair.words), repair.apply)


def _passing(text: SourceText) -> QMenu:
    menu = QMenu(text.editor.parentWidget())
    menu.aboutToHide.connect(menu.deleteLater)
    return menu
