"""Tidings of the inspection: everything in the window that shows findings hears of them here."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from PySide6.QtCore import QObject

from smsl_studio.inspection.finding import Finding
from smsl_studio.studio.canvas.editor import CanvasEditor
from smsl_studio.studio.inspector import Inspector
from smsl_studio.studio.panels.findings import Findings
from smsl_studio.studio.status_line import StatusLine
from smsl_studio.studio.words import tally, worst


class Marked(Protocol):
    """What marks the elements that it shows with their findings."""

    def set_findings(self, findings: Sequence[Finding]) -> None: ...


class Tidings(QObject):
    """Hands findings on to the list, the canvas, the status line and whatever marks elements."""

    def __init__(
        self,
        inspector: Inspector,
        findings: Findings,
        editor: CanvasEditor,
        line: StatusLine,
        marked: Sequence[Marked],
        then: Callable[[], object],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._findings, self._editor, self._line = findings, editor, line
        self._marked, self._then = tuple(marked), then
        inspector.started.connect(self._checking)
        inspector.found.connect(self._found)

    def forget(self) -> None:
        """Another file was opened: what was found in the last one says nothing about it."""
        for part in self._marked:
            part.set_findings(())
        self._findings.forget()
        self._editor.set_findings({})
        self._line.show_findings("checking")

    def _checking(self) -> None:
        self._findings.set_checking()

    def _found(self, findings: tuple[Finding, ...]) -> None:
        for part in (self._findings, *self._marked):
            part.set_findings(findings)
        self._editor.set_findings(worst(findings))
        self._line.show_findings(tally(findings) or "no findings")
        self._then()
