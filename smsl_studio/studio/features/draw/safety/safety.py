"""Protects unsaved work: the journal, recovery after a crash, and changes by other programs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.journal.entry import KeptText
from smsl_studio.studio.document.journal.place import folder_of
from smsl_studio.studio.document.journal.unsaved import Unsaved
from smsl_studio.studio.document.journal.writer import Journal
from smsl_studio.studio.features.draw.safety.change_bar import ChangeBar
from smsl_studio.studio.features.draw.safety.outside import OutsideChanges
from smsl_studio.studio.features.draw.source.pane import SourcePane
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.document.journal.leftovers import Left
    from smsl_studio.studio.features.draw.safety.outside import Compare


class Safety(QObject):
    """Keeps the journal of one window, recovers the work of another one, and watches the files."""

    def __init__(
        self,
        parts: WindowParts,
        source: SourcePane,
        compare: Compare,
    ) -> None:
        super().__init__(parts.window)
        session, files, toast = parts.session, parts.files, parts.toast
        self._session, self._files, self._toast = session, files, toast
        self._home = parts.settings.folder
        unsaved = Unsaved(session, files, lambda: source.pending)
        self.journal = Journal(unsaved, folder_of(self._home), self)
        self.journal.failed.connect(toast.warn)
        for signal in (session.blueprint_changed, session.broken_changed, session.edited_changed,
                       files.changed, source.editor.typed):  # fmt: skip
            signal.connect(lambda *_: self.journal.changed())
        self.bar = ChangeBar(parts.tokens)
        self.outside = OutsideChanges(session, files, self.bar, compare, self)
        self.outside.said.connect(toast.say)
        self.outside.warned.connect(toast.warn)
        self.outside.refused.connect(toast.refuse)
        parts.window.installEventFilter(self)

    def below(self, top: QWidget) -> QWidget:
        """A widget with the top of the window, and the bar about changed files below it."""
        both = QWidget()
        column = QVBoxLayout(both)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(top)
        column.addWidget(self.bar)
        return both

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.bar.set_tokens(tokens)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Check the files when the window becomes active: another program may have changed them."""
        if event.type() == QEvent.Type.WindowActivate:
            self.outside.look()
        return super().eventFilter(watched, event)

    @property
    def untouched(self) -> bool:
        """Whether nothing was opened or drawn here, so that another blueprint may replace it."""
        files, session = self._files, self._session
        return files.is_draft and not session.edited

    def recover(self, left: Left) -> bool:
        """Show the work that another window has left behind.

        Its journal is deleted as soon as this window has kept everything. Returns False if the
        person cancelled, because a save of its files was interrupted.
        """
        from smsl_studio.studio.document.journal.restoration import on_disk, restore

        before = on_disk(left.entry)
        if before is not None:
            path = Path(left.entry.path)
            if self._files.settle_interrupted(path, before) == "called off":
                return False
        restored = restore(left.entry, self._files, self._session)
        for file in restored.changed:
            self.outside.ask(file)
        self.journal.flush()
        safe = [self._put_aside(kept) for kept in restored.lost]
        if all(safe) and self.journal.whole:
            left.drop()
        else:
            left.keep()
        return True

    def close(self) -> None:
        """End all work, because the window closes. Unsaved work was saved or given up before."""
        self.outside.stop()
        self.journal.close()

    def _put_aside(self, kept: KeptText) -> bool:
        """Write a text that cannot be shown any more to a file. Returns whether that worked."""
        from smsl_studio.studio.document.journal.restoration import keep_text

        name = Path(kept.file).name
        try:
            where = keep_text(kept, self._home)
        except OSError as error:
            self._toast.warn(f"The unsaved text of {name} cannot be put aside: {error.strerror}.")
            return False
        self._toast.warn(
            f"{name} cannot be shown in {self._files.name} as it is now. "
            f"Its unsaved text was put into {where}."
        )
        return True
