"""The source pane: the exact text of the blueprint's files, edited as in any editor.

Typing makes steps of the common history, and an edit from elsewhere patches the text. The lines of
the selection are marked, findings and faults are underlined, and a click selects the element that
is written there.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from PySide6.QtCore import Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.smsl.document import Document
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.broken import document_of
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source import marks
from smsl_studio.studio.features.draw.source.editor import Editor
from smsl_studio.studio.features.draw.source.elements import Elements
from smsl_studio.studio.features.draw.source.find_bar import FindBar
from smsl_studio.studio.features.draw.source.fold_verbs import FoldVerbs
from smsl_studio.studio.features.draw.source.keys import PaneKeys
from smsl_studio.studio.features.draw.source.pane_marks import PaneMarks
from smsl_studio.studio.features.draw.source.patches import patches
from smsl_studio.studio.features.draw.source.pointer import TextPointer
from smsl_studio.studio.features.draw.source.popup import Popup
from smsl_studio.studio.features.draw.source.quick_fixes import QuickFixes
from smsl_studio.studio.features.draw.source.strips import FaultStrip, FileRow, YamlStrip
from smsl_studio.studio.features.draw.source.typed_text import TypedText


class SourcePane(QWidget):
    """The source pane. It follows the session only while it is visible."""

    caret_moved = Signal(int, int)
    """(line, column): the place of the caret, from 1, while the pane has the keyboard focus."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self._session, self._tokens = session, tokens
        self._agreed: set[str] = set()
        self._chosen: str | None = None
        self._salvage = session.blueprint if session.broken else None
        self._file = ""
        self.editor = Editor(tokens, self)
        self.files, self.yaml, self.faults = FileRow(), YamlStrip(), FaultStrip()
        self.find_bar = FindBar(self.editor)
        self.popup = Popup(self.editor, lambda: session.blueprint)
        self.folding = FoldVerbs(self.editor)
        self.marking = PaneMarks(self, session, self._marked)
        self.repairing = QuickFixes(self, session, self.marking, self.faults)
        self.pointing = TextPointer(self, session, self.marking, self.repairing)
        self.typing = TypedText(session, lambda: self.editor.sheet.text, self)
        self._build()
        self._connect()
        self.set_tokens(tokens)

    def _build(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.files)
        column.addWidget(self.yaml)
        column.addWidget(self.find_bar)
        column.addWidget(self.editor, 1)
        column.addWidget(self.faults)
        self.setFocusProxy(self.editor)
        self.editor.keys = PaneKeys(self, self.popup, self.pointing, self.repairing)

    def _connect(self) -> None:
        session, editor = self._session, self.editor
        session.opened.connect(self._another_file)
        session.blueprint_changed.connect(lambda *_: self._text_changed())
        session.broken_changed.connect(self._text_changed)
        session.selection_changed.connect(lambda *_: self._selection_changed())
        session.branch_changed.connect(lambda *_: self._branch_changed())
        session.settling.connect(self.settle)
        editor.typed.connect(self.typing.begin)
        editor.starting.connect(self.settle)
        editor.caret_moved.connect(self.tell_caret)
        editor.entered.connect(self.tell_caret)
        editor.left.connect(self.typing.hurry)
        self.find_bar.changed.connect(self.marking.mark)
        self.files.chosen.connect(self._choose_file)
        self.yaml.agreed.connect(self._agree)
        self.faults.show_wanted.connect(self.show_fault)

    # Called by other parts.

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme, in the text and all strips."""
        self._tokens = tokens
        self.editor.set_tokens(tokens)
        for strip in (self.yaml, self.faults, self.find_bar, self.repairing.bulb):
            strip.set_tokens(tokens)
        self.marking.mark()

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Underline the words of findings and mark their lines."""
        self.marking.set_findings(findings)

    def set_library(self, names: Iterable[str]) -> None:
        """Take the names of operations from plugins, which completion offers too."""
        self.popup.library = tuple(names)

    def set_active(self, addresses: Iterable[Address]) -> None:
        """Highlight the lines of the elements that are active in a run."""
        self.marking.set_active(addresses)

    def settle(self) -> None:
        """Take over the typed text now, if there is any."""
        if self.typing.pending:
            self.typing.settle()
            self._refresh()
            self.marking.mark()

    @property
    def pending(self) -> dict[str, str]:
        """The typed text that is not yet a step of the history, by its file."""
        return {self.typing.file: self.editor.sheet.text} if self.typing.pending else {}

    @property
    def file(self) -> str:
        """The file whose text is shown."""
        return self._file

    @property
    def current(self) -> bool:
        """Whether the shown file is the one that should be shown."""
        return self._file == self._wanted_file()

    @property
    def elements(self) -> Elements:
        """Finds the elements in the text that is shown."""
        return Elements(self.editor.sheet, self._document())

    @property
    def marked_lines(self) -> tuple[int, ...]:
        """The lines (from 1) in which the selected elements are written."""
        self._refresh()
        sheet = self.editor.sheet
        return tuple(
            sorted({sheet.line_of(line) + 1 for line in self.marking.lines_of_selection()})
        )

    def show_fault(self) -> None:
        """Go to the first fault of the broken text."""
        broken = self._session.broken
        if broken is None:
            return
        self._choose_file(broken.file)
        self.editor.set_caret(*marks.fault_span(self.editor.sheet, broken.error))
        self.editor.bring_into_view(self.editor.caret[0])
        self.editor.setFocus()

    def undo(self) -> None:
        """Undo the last step, wherever it was made; text being typed is a step, too."""
        self.settle()
        self._session.history.undo()

    def redo(self) -> None:
        """Take over the text being typed, then redo."""
        self.settle()
        self._session.history.redo()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.typing.stop()

    def leave(self, onwards: bool) -> None:
        """Give the keyboard focus to the widget after the text, or before it."""
        self.focusNextPrevChild(onwards)

    def tell_caret(self) -> None:
        """Emit ``caret_moved``, while the text or the find bar has the keyboard focus."""
        focus = QApplication.focusWidget()
        if focus is not None and self.isAncestorOf(focus):
            line, column = self.editor.caret
            self.caret_moved.emit(self.editor.sheet.line_of(line) + 1, column + 1)
            self.repairing.show_bulb()

    # Following the session.

    def _another_file(self) -> None:
        self.typing.forget()
        self._agreed.clear()
        self._chosen, self._file = None, ""
        self.marking.active = ()
        self._salvage = self._session.blueprint if self._session.broken else None

    def _text_changed(self) -> None:
        if self.isVisible():
            self._refresh()
            self.marking.mark()

    def _branch_changed(self) -> None:
        self._chosen = None
        self._selection_changed()

    def _selection_changed(self) -> None:
        """Mark the lines of the selection (or of the SB) and scroll to them."""
        if not self.isVisible():
            return
        self._refresh()
        self.marking.mark()
        lines = self.marking.lines_of_selection()
        if lines and not self.pointing.selecting and not self.editor.hasFocus():
            self.editor.reveal(min(lines))

    def showEvent(self, event: QShowEvent) -> None:
        """Show the text as it is now, because the pane did not follow while hidden."""
        super().showEvent(event)
        self._refresh()
        self._selection_changed()

    def _refresh(self) -> None:
        """Bring the shown text up to date, replacing only what differs."""
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
        """Whether the file was opened with faults, so that the graph shows only a part of it."""
        return self._session.broken is not None and self._session.blueprint is self._salvage

    def _wanted_file(self) -> str:
        """The file being typed in, else the chosen one, else the file of the SB that is shown."""
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
        self.marking.mark()

    def _marked(self) -> None:
        self.repairing.show_bulb()

    # Typing.

    def _allow(self) -> None:
        """Set whether the text can be edited.

        YAML needs the person's consent first. While one file is broken, no other file can be
        edited.
        """
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
