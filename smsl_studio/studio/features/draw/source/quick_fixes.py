"""Offers quick fixes at the caret, from the bulb, the gutter's marks and Ctrl+."""

from __future__ import annotations

from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source.menus import Bulb, repair_menu
from smsl_studio.studio.features.draw.source.pane_marks import PaneMarks
from smsl_studio.studio.features.draw.source.repairs import TextRepair, of_faults, of_findings
from smsl_studio.studio.features.draw.source.source_text import SourceText
from smsl_studio.studio.features.draw.source.strips import FaultStrip


class QuickFixes:
    """Offers the fixes for the text of one pane."""

    def __init__(
        self, text: SourceText, session: Session, marking: PaneMarks, faults: FaultStrip
    ) -> None:
        self._text, self._session, self._marking = text, session, marking
        self.bulb = Bulb(text.editor)
        text.editor.gutter.fixes_wanted.connect(self.offer_at)
        self.bulb.clicked.connect(self.offer)
        faults.fix_wanted.connect(self._fix_first)

    def every(self) -> tuple[TextRepair, ...]:
        """Every fix for the text that is shown.

        While a file is broken, only the fixes of its faults.
        """
        text, sheet = self._text, self._text.editor.sheet
        if self._session.broken is not None:
            return tuple(of_faults(self._session, sheet, self._marking.faults_here()))
        return tuple(of_findings(self._session, sheet, self._marking.findings_here(), text.file))

    def at(self, line: int) -> tuple[TextRepair, ...]:
        """The fixes of a line."""
        if self._text.typing.pending or line not in self._text.editor.gutter.marks:
            return ()
        return tuple(one for one in self.every() if one.line == line)

    def offer(self) -> None:
        """Open a menu of the fixes in the caret's line, else in the first line that has some."""
        self.offer_at(self._text.editor.caret[0])

    def offer_at(self, line: int) -> None:
        """Open a menu of the fixes in a line, else in the first line that has some."""
        text, editor = self._text, self._text.editor
        text.settle()
        repairs = self.every()
        here = [one for one in repairs if one.line == line]
        here = here or [one for one in repairs if one.line == repairs[0].line]
        if not here:
            return
        if editor.caret[0] != here[0].line:
            editor.set_caret(editor.sheet.offset(here[0].line, 0))
            editor.bring_into_view(here[0].line)
        menu = repair_menu(text, here)
        menu.setActiveAction(menu.actions()[0])
        menu.popup(editor.viewport().mapToGlobal(editor.cursorRect().bottomLeft()))

    def show_bulb(self) -> None:
        """Show the bulb if the caret's line has fixes."""
        self.bulb.show_for(self.at(self._text.editor.caret[0]))

    def _fix_first(self) -> None:
        text = self._text
        repairs = list(of_faults(self._session, text.editor.sheet, self._marking.faults_here()))
        if repairs:
            repairs[0].apply()
        else:
            text.show_fault()
