"""Draws the selection, the search matches and the findings in the text of one pane."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import ReadError
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source import marks
from smsl_studio.studio.features.draw.source.source_text import SourceText

MOST_BANDS = 4000


class PaneMarks:
    """Keeps the bands and wavy lines of a pane's text, and the marks of its gutter."""

    def __init__(self, text: SourceText, session: Session, then: Callable[[], object]) -> None:
        """``then`` is called after each update of the marks."""
        self._text, self._session, self._then = text, session, then
        self._findings: tuple[Finding, ...] = ()
        self.active: tuple[Address, ...] = ()

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Underline the words of findings and mark their lines."""
        self._findings = tuple(findings)
        self.mark()

    def set_active(self, addresses: Iterable[Address]) -> None:
        """Highlight the lines of the elements that are active in a run."""
        found = tuple(addresses)
        if found != self.active:
            self.active = found
            self.mark()

    def faults_here(self) -> tuple[ReadError, ...]:
        """The faults of the text that is shown; none if it has changed since they were found."""
        broken = self._session.broken
        if broken is None or broken.file != self._text.file:
            return ()
        return broken.error.faults if broken.text == self._text.editor.sheet.text else ()

    def findings_here(self) -> tuple[Finding, ...]:
        """The findings in the file that is shown; none if its text has changed or is broken."""
        broken = self._session.broken
        if (broken is not None and broken.file == self._text.file) or not self._text.elements.exact:
            return ()
        return tuple(one for one in self._findings if one.places_in(self._text.file))

    def mark(self) -> None:
        """Draw bands and wavy lines anew. While one types, the old ones move with the text."""
        text, editor = self._text, self._text.editor
        if not text.isVisible() or not text.current or text.typing.pending:
            return
        findings, faults = self.findings_here(), self.faults_here()
        selected, active = self.lines_of_selection(), self._lines_of(self.active)
        editor.gutter.marks = marks.by_line(editor.sheet, findings, faults, text.file)
        editor.gutter.banded, editor.gutter.active = frozenset(selected), frozenset(active)
        colour = editor.tokens.accs
        editor.setExtraSelections([
            *(marks.band(editor, line, colour) for line in sorted({*selected, *active})),
            *marks.of_findings(editor, findings, text.file),
            *marks.of_faults(editor, faults),
            *marks.of_matches(editor, text.find_bar.found.matches),
        ])  # fmt: skip
        editor.gutter.update()
        self._then()

    def lines_of_selection(self) -> set[int]:
        """The shown lines in which the selected elements are written."""
        return self._lines_of(self._session.selection)

    def _lines_of(self, addresses: Sequence[Address]) -> set[int]:
        found: set[int] = set()
        home, file = self._session.blueprint.home, self._text.file
        here = [one for one in addresses[:50] if home(one.branch).file == file]
        elements = self._text.elements
        for address in here:
            lines = elements.lines_of(address)
            if lines is not None:
                last = min(lines.last, lines.first + MOST_BANDS)
                found.update(range(lines.first, last + 1))
        return found
