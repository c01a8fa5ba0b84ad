"""Repairing: quick fixes at the caret, behind the bulb, the gutter's marks and Ctrl+."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.studio.features.draw.source.menus import Bulb, repair_menu
from smsl_studio.studio.features.draw.source.repairs import TextRepair, of_faults, of_findings

if TYPE_CHECKING:
    from smsl_studio.studio.document.session import Session
    from smsl_studio.studio.features.draw.source.pane import SourcePane


class QuickFixes:
    """Offers what repairs the text of one pane."""

    def __init__(self, pane: SourcePane, session: Session) -> None:
        self._pane, self._session = pane, session
        self.bulb = Bulb(pane.editor)
        pane.editor.gutter.fixes_wanted.connect(self.offer_at)
        self.bulb.clicked.connect(self.offer)
        pane.faults.fix_wanted.connect(self._fix_first)

    def every(self) -> tuple[TextRepair, ...]:
        """Every fix for the text that is shown; while one does not read, those of its faults."""
        pane, sheet = self._pane, self._pane.editor.sheet
        if self._session.broken is not None:
            return tuple(of_faults(self._session, sheet, pane.marking.faults_here()))
        return tuple(of_findings(self._session, sheet, pane.marking.findings_here(), pane.file))

    def at(self, line: int) -> tuple[TextRepair, ...]:
        """The fixes of one line."""
        if self._pane.typing.pending or line not in self._pane.editor.gutter.marks:
            return ()
        return tuple(one for one in self.every() if one.line == line)

    def offer(self) -> None:
        """A menu of the fixes at the caret's line; else of the first line that has some."""
        self.offer_at(self._pane.editor.caret[0])

    def offer_at(self, line: int) -> None:
        """A menu of the fixes of a line."""
        pane, editor = self._pane, self._pane.editor
        pane.settle()
        repairs = self.every()
        here = [one for one in repairs if one.line == line]
        here = here or [one for one in repairs if one.line == repairs[0].line]
        if not here:
            return
        if editor.caret[0] != here[0].line:
            editor.set_caret(editor.sheet.offset(here[0].line, 0))
            editor.bring_into_view(here[0].line)
        menu = repair_menu(pane, here)
        menu.setActiveAction(menu.actions()[0])
        menu.popup(editor.viewport().mapToGlobal(editor.cursorRect().bottomLeft()))

    def show_bulb(self) -> None:
        """Show the bulb where the caret's line has fixes."""
        self.bulb.show_for(self.at(self._pane.editor.caret[0]))

    def _fix_first(self) -> None:
        pane = self._pane
        repairs = list(of_faults(self._session, pane.editor.sheet, pane.marking.faults_here()))
        if repairs:
            repairs[0].apply()
        else:
            pane.show_fault()
