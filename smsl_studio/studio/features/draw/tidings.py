"""Passes the findings of the inspection to every part of the window that shows them.

A text that cannot be read has no findings; the parts show its faults instead.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import PurePath
from typing import Protocol

from PySide6.QtCore import QObject

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.words import worst
from smsl_studio.studio.document.broken import Broken, faults_of
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.panels.findings import Findings
from smsl_studio.studio.features.draw.panels.unfinished import quiet, sum_of
from smsl_studio.studio.running.window_parts import WindowParts

EMPTY = "R03"
"""The rule for SBs without states."""


class Marked(Protocol):
    """A part that marks the elements it shows with their findings."""

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Mark the elements that have these findings."""


class Tidings(QObject):
    """Passes new findings to the list, the canvas and the other parts that mark elements.

    ``say`` shows the sum of the findings in a few words; ``then`` is called after the parts have
    them.
    """

    def __init__(
        self,
        parts: WindowParts,
        findings: Findings,
        editor: CanvasEditor,
        marked: Sequence[Marked],
        say: Callable[[str], object],
        then: Callable[[], object],
    ) -> None:
        super().__init__(parts.window)
        session, inspector = parts.session, parts.inspector
        self._session = session
        self._findings, self._editor, self._say = findings, editor, say
        self._marked, self._then = tuple(marked), then
        inspector.started.connect(self._checking)
        session.afterwards.follow(self._show_found, inspector.found)
        session.afterwards.follow(then, inspector.found)
        parts.files.changed.connect(self._show_again)
        findings.check_wanted.connect(self.check)
        session.opened.connect(self._opened)
        session.broken_changed.connect(self._broken)
        self.asked: Callable[[], tuple[Finding, ...]] = lambda: ()
        """Returns the open comments of a review, as findings."""
        self._salvaged: Blueprint | None = None
        self._inspector, self._files = inspector, parts.files
        self._checked = False

    def check(self) -> None:
        """Show the findings of a drawing that was never saved as those of any other."""
        self._checked = True
        self._show_again()

    def _show_again(self) -> None:
        """Show the findings again if they are shown otherwise now, because the drawing was
        saved."""
        if self._findings.draft != self._is_draft and self._inspector.current:
            self._found(self._inspector.findings)
            self._then()

    @property
    def _is_draft(self) -> bool:
        """Whether somebody is just drawing, and has not asked for a check yet."""
        return self._files.is_draft and not self._checked

    def show_asked(self) -> None:
        """Show the findings again, because the comments of a review are others now."""
        if self._inspector.current:
            self._found(self._inspector.findings)
            self._then()

    def forget(self) -> None:
        """Remove all findings, because another file was opened."""
        for part in self._marked:
            part.set_findings(())
        self._findings.forget()
        self._editor.set_findings({})
        self._say("checking")

    def _opened(self) -> None:
        """Remember the blueprint of a file that was broken when opened: it holds only what could
        be read."""
        self._checked = False
        self._salvaged = self._session.blueprint if self._session.broken is not None else None

    def _broken(self) -> None:
        broken = self._session.broken
        self._findings.set_broken(broken)
        self._editor.canvas.show_banner(self._said(broken))
        if broken is not None:
            self._say(faults_of(broken))
        elif self._inspector.current:
            self._say(self._told(self._findings.findings))
        else:
            self._say("checking")

    def _said(self, broken: Broken | None) -> str:
        """The banner of the canvas while the text cannot be read; empty if it can be read."""
        if broken is None:
            return ""
        shown = self._session.blueprint
        drawn = "The drawing shows the last version that could be read."
        if shown is self._salvaged:
            drawn = (
                "The drawing shows what could be read."
                if len(shown)
                else "Nothing of it can be drawn."
            )
        return f"The text of {PurePath(broken.file).name} cannot be read. {drawn}"

    def _checking(self) -> None:
        self._findings.set_checking()

    def _show_found(self) -> None:
        if self._inspector.current:
            self._found(self._inspector.findings)

    def _found(self, findings: tuple[Finding, ...]) -> None:
        if self._session.broken is not None and self._session.blueprint is self._salvaged:
            # The unreadable part is missing in it; that is no mistake and needs no fix.
            findings = ()
        if not self._session.blueprint.state_count:
            # A new blueprint has no states yet; that is no mistake of the person.
            findings = tuple(finding for finding in findings if finding.rule != EMPTY)
        self._findings.draft = self._is_draft
        self._findings.proving = self._inspector.proving
        if self._is_draft:
            findings = quiet(findings)
        findings = (*findings, *self.asked())
        for part in (self._findings, *self._marked):
            part.set_findings(findings)
        self._editor.set_findings(worst(findings))
        if self._session.broken is None:
            self._say(self._told(findings))

    def _told(self, findings: Sequence[Finding]) -> str:
        """The number of findings in words. An empty blueprint has “nothing to check”."""
        nothing = "no findings" if self._session.blueprint.state_count else "nothing to check"
        return sum_of(findings) or nothing
