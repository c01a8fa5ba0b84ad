"""Clicks, jumps and hovering in the text."""

from __future__ import annotations

from PySide6.QtCore import QPoint

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source import hover
from smsl_studio.studio.features.draw.source.menus import text_menu
from smsl_studio.studio.features.draw.source.pane_marks import PaneMarks
from smsl_studio.studio.features.draw.source.quick_fixes import QuickFixes
from smsl_studio.studio.features.draw.source.source_text import SourceText


class TextPointer:
    """Goes from a place in a pane's text to the element there, and back."""

    def __init__(
        self, text: SourceText, session: Session, marking: PaneMarks, repairing: QuickFixes
    ) -> None:
        self._text, self._session = text, session
        self._marking, self._repairing = marking, repairing
        self.selecting = False
        """Whether a click in the text is setting the selection at this moment."""
        editor = text.editor
        editor.clicked.connect(self.select_at)
        editor.called.connect(lambda at: self.jump_from(*self._place(at)))
        editor.menu_wanted.connect(self._open_menu)
        editor.words_at = self.words_at

    def select_at(self, at: QPoint) -> None:
        """Select the element that is written at a point of the viewport."""
        self._text.settle()
        address = self._text.elements.address_at(*self._place(at))
        if address is None or address.branch not in self._session.blueprint.branches:
            return
        self.selecting = True
        try:
            self._session.show_branch(address.branch)
            self._session.select((address,) if address.state else ())
        finally:
            self.selecting = False
        self._marking.mark()

    def jump(self) -> None:
        """Go to the element that the name at the caret refers to."""
        self.jump_from(*self._text.editor.caret)

    def jump_from(self, line: int, column: int) -> None:
        """Go to the element that the name at a place refers to: a state or a sub-SB."""
        self._text.settle()
        address = self._text.elements.definition(line, column)
        if address is not None and address.branch in self._session.blueprint.branches:
            self._session.jump(address)
            self.show_lines_of(address)

    def show_lines_of(self, address: Address) -> None:
        """Put the caret where an element is written."""
        lines = self._text.elements.lines_of(address)
        if lines is not None:
            self._text.editor.reveal(lines.first)

    def words_at(self, line: int, column: int) -> str:
        """The tip for a place: the marks of the line, then the element there."""
        mark = self._text.editor.gutter.marks.get(line)
        elements = self._text.elements
        address = elements.definition(line, column) or elements.address_at(line, column)
        said = hover.words(self._session.blueprint, address) if address else ""
        return "\n\n".join(part for part in (mark.words if mark else "", said) if part)

    def _place(self, at: QPoint) -> tuple[int, int]:
        editor = self._text.editor
        return editor.place_of(editor.cursorForPosition(at))

    def _open_menu(self, at: QPoint, on_screen: QPoint) -> None:
        repairs = self._repairing.at(self._place(at)[0])
        text_menu(self._text, repairs, at, self.jump_from).popup(on_screen)
