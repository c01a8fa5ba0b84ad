"""Source: the exact text of the blueprint's files, typed in as in any editor.

Typing is a step of the one history; an edit from elsewhere patches the text. What is selected is
marked, findings and faults are underlined, and a click selects the element written there.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from PySide6.QtCore import QPoint, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError
from smsl_studio.inspection.finding import Finding
from smsl_studio.smsl.document import Document
from smsl_studio.studio.broken import document_of
from smsl_studio.studio.session import Broken, Session
from smsl_studio.studio.source import marks
from smsl_studio.studio.source.editor import Editor
from smsl_studio.studio.source.elements import Elements
from smsl_studio.studio.source.patches import patches
from smsl_studio.studio.source.strips import FaultStrip, FileRow, YamlStrip
from smsl_studio.studio.source.typing import Typing
from smsl_studio.studio.theme import Tokens

MOST_BANDS = 4000


class Source(QWidget):
    """The source pane. It works while it is visible; hidden it is stale and costs nothing."""

    caret_moved = Signal(int, int)
    """Line and column of the caret, from 1, when it has the focus."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self._session, self._tokens = session, tokens
        self._findings: tuple[Finding, ...] = ()
        self._active: tuple[Address, ...] = ()
        self._agreed: set[str] = set()
        self._chosen: str | None = None
        self._salvage: Blueprint | None = None
        self._file, self._following = "", True
        self.editor = Editor(tokens, self)
        self.files, self.yaml, self.faults = FileRow(), YamlStrip(), FaultStrip()
        self.typing = Typing(session, lambda: self.editor.sheet.text, self)
        self._build()
        self._connect()
        self.set_tokens(tokens)

    def _build(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.files)
        column.addWidget(self.yaml)
        column.addWidget(self.editor, 1)
        column.addWidget(self.faults)
        self.setFocusProxy(self.editor)

    def _connect(self) -> None:
        session, editor = self._session, self.editor
        session.opened.connect(self._another_file)
        session.blueprint_changed.connect(lambda *_: self._text_changed())
        session.broken_changed.connect(self._text_changed)
        session.selection_changed.connect(lambda *_: self._selection_changed())
        session.branch_changed.connect(lambda *_: self._branch_changed())
        session.settling.connect(self.settle)
        editor.typed.connect(self._typed)
        editor.caret_moved.connect(self._tell_caret)
        editor.left.connect(self.settle)
        editor.clicked.connect(self.select_at)
        self.files.chosen.connect(self._choose_file)
        self.yaml.agreed.connect(self._agree)
        self.faults.show_wanted.connect(self.show_fault)

    # What others ask of it.

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self.editor.set_tokens(tokens)
        for strip in (self.yaml, self.faults):
            strip.set_tokens(tokens)
        self.mark()

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Underline what findings are about, and mark their lines."""
        self._findings = tuple(findings)
        self.mark()

    def set_active(self, addresses: Iterable[Address]) -> None:
        """Light the lines of what is active in a run."""
        self._active = tuple(addresses)
        self.mark()

    def settle(self) -> None:
        """Take over what was typed, if anything was."""
        if self.typing.pending:
            self.typing.settle()
            self._refresh()
            self.mark()

    @property
    def file(self) -> str:
        """The file whose text is shown."""
        return self._file

    @property
    def elements(self) -> Elements:
        """Where the elements of the shown text stand."""
        return Elements(self.editor.sheet, self._document())

    @property
    def marked_lines(self) -> tuple[int, ...]:
        """The lines (from 1) in which the selected elements are written."""
        self._refresh()
        sheet = self.editor.sheet
        return tuple(sorted({sheet.line_of(line) + 1 for line in self._lines_of_selection()}))

    def show_fault(self) -> None:
        """Show the first place at which the text does not read."""
        broken = self._session.broken
        if broken is None:
            return
        self._choose_file(broken.file)
        self.editor.set_caret(*marks.fault_span(self.editor.sheet, broken.error))
        self.editor.bring_into_view(self.editor.caret[0])
        self.editor.setFocus()

    def show_lines_of(self, address: Address) -> None:
        """Put the caret where an element is written."""
        lines = self.elements.lines_of(address)
        if lines is not None:
            self.editor.reveal(lines.first)

    # Following the session.

    def _another_file(self) -> None:
        self.typing.forget()
        self._agreed.clear()
        self._chosen, self._file, self._active = None, "", ()
        self._salvage = self._session.blueprint if self._session.broken else None

    def _text_changed(self) -> None:
        if self.isVisible():
            self._refresh()
            self.mark()

    def _branch_changed(self) -> None:
        self._chosen = None
        self._selection_changed()

    def _selection_changed(self) -> None:
        """Show the selected element (or the SB's beginning) and mark its lines."""
        if not self.isVisible():
            return
        self._refresh()
        self.mark()
        lines = self._lines_of_selection()
        if self._following and lines and not self.editor.hasFocus():
            self.editor.reveal(min(lines))

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._refresh()
        self._selection_changed()

    def _refresh(self) -> None:
        """Bring what is shown up to date, replacing only what differs."""
        texts, file = self._session.texts, self._wanted_file()
        text = texts[file]
        self.editor.set_form(self._document_named(file).form)
        if file != self._file and text != self.editor.sheet.text:
            self.editor.load(text)
        elif text != self.editor.sheet.text:
            self._patch(text)
        self._file = self.typing.file = file
        self.files.show_files(tuple(texts), file)
        self._allow()
        self._say_faults()

    def _patch(self, text: str) -> None:
        found = patches(self.editor.sheet.text, text)
        self.typing.forget()
        self.editor.apply(found)
        if found and self.editor.hasFocus():
            self.editor.set_caret(found[-1][0] + len(found[-1][2]))

    @property
    def _salvaged(self) -> bool:
        """Whether the graph is what could be read of a file that was opened broken."""
        return self._session.broken is not None and self._session.blueprint is self._salvage

    def _wanted_file(self) -> str:
        """The file that was chosen, else that of the SB that is shown."""
        blueprint, broken = self._session.blueprint, self._session.broken
        files = [document.file for document in blueprint.documents]
        if self.typing.pending and self.typing.file in files:
            return self.typing.file
        if self._chosen in files:
            return str(self._chosen)
        if broken is not None and self._salvaged:
            return broken.file
        return blueprint.home(self._session.branch).file

    def _document(self) -> Document:
        return self._document_named(self._wanted_file())

    def _document_named(self, file: str) -> Document:
        return document_of(self._session.blueprint, file)

    def _choose_file(self, file: str) -> None:
        self.settle()
        self._chosen = file
        self._refresh()
        self.mark()

    # Typing.

    def _typed(self, line: int) -> None:
        self.typing.begin(f"Type in line {self.editor.sheet.line_of(line) + 1}")

    def _allow(self) -> None:
        """Which text may be typed in: not YAML unasked, and no other file than a broken one."""
        broken, form = self._session.broken, self._document().form
        noted = form == "yaml" and self._file not in self._agreed and not self._session.edited
        self.yaml.setVisible(noted and broken is None)
        elsewhere = broken is not None and broken.file != self._file
        self.editor.set_writable(not (noted and broken is None) and not elsewhere)

    def _agree(self) -> None:
        self._agreed.add(self._file)
        self._allow()
        self.editor.setFocus()

    def _say_faults(self) -> None:
        broken = self._session.broken
        elsewhere = broken is not None and broken.file != self._file
        name = broken.file if broken and elsewhere else ""
        self.faults.show_faults(broken.error if broken else None, name, self._salvaged)

    # Pointing.

    def select_at(self, at: QPoint) -> None:
        """Select the element that is written at a point."""
        self.settle()
        place = self.editor.place_of(self.editor.cursorForPosition(at))
        address = self.elements.address_at(*place)
        if address is None or address.branch not in self._session.blueprint.branches:
            return
        self._following = False
        try:
            self._session.show_branch(address.branch)
            self._session.select((address,) if address.state else ())
        finally:
            self._following = True
        self.mark()

    def _tell_caret(self) -> None:
        if self.editor.hasFocus():
            line, column = self.editor.caret
            self.caret_moved.emit(self.editor.sheet.line_of(line) + 1, column + 1)

    # Marks.

    def faults_here(self) -> tuple[ReadError, ...]:
        """The faults of the text that is shown, as it is shown."""
        broken = self._session.broken
        here = broken is not None and broken.file == self._file
        return broken.error.faults if broken and here and self._is(broken) else ()

    def findings_here(self) -> tuple[Finding, ...]:
        """The findings of the text that is shown, where it is the one that was inspected."""
        if not self.elements.exact:
            return ()
        return tuple(one for one in self._findings if one.place.file == self._file)

    def _is(self, broken: Broken) -> bool:
        return broken.text == self.editor.sheet.text

    def mark(self) -> None:
        """Draw bands and wavy lines anew; while one types the old ones move with the text."""
        if not self.isVisible() or self._file != self._wanted_file() or self.typing.pending:
            return
        editor, tokens = self.editor, self._tokens
        findings, faults = self.findings_here(), self.faults_here()
        selected, active = self._lines_of_selection(), self._lines_of(self._active)
        editor.gutter.marks = marks.by_line(editor.sheet, findings, faults)
        editor.gutter.banded, editor.gutter.active = frozenset(selected), frozenset(active)
        editor.setExtraSelections([
            *(marks.band(editor, line, tokens.accs) for line in sorted({*selected, *active})),
            *marks.of_findings(editor, findings),
            *marks.of_faults(editor, faults),
        ])  # fmt: skip
        editor.gutter.update()

    def _lines_of_selection(self) -> set[int]:
        return self._lines_of(self._session.selection)

    def _lines_of(self, addresses: Sequence[Address]) -> set[int]:
        found: set[int] = set()
        blueprint: Blueprint = self._session.blueprint
        here = [one for one in addresses[:50] if blueprint.home(one.branch).file == self._file]
        elements = self.elements if here else None
        for address in here:
            lines = elements.lines_of(address) if elements else None
            if lines is not None:
                last = min(lines.last, lines.first + MOST_BANDS)
                found.update(range(lines.first, last + 1))
        return found
