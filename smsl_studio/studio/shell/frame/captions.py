"""Captions: what the frame of the window says of what is open, and of where one is in it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMainWindow

from smsl_studio.blueprint.address import Address
from smsl_studio.legible import plain_text
from smsl_studio.studio.document.files.files import Files, Title
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.shell.frame.menu_row import MenuRow
from smsl_studio.studio.shell.frame.status_line import StatusLine


class Captions(QObject):
    """Keeps the title and the status line in step with session and files."""

    def __init__(
        self,
        session: Session,
        files: Files,
        tell_caret: Callable[[], object],
        row: MenuRow,
        line: StatusLine,
        window: QMainWindow,
    ) -> None:
        super().__init__(window)
        self._session, self._files, self._tell_caret = session, files, tell_caret
        self._row, self._line, self._window = row, line, window
        self.other: Callable[[], str] = lambda: ""
        """The file that is shown in place of the drawing; the empty text for none."""
        session.blueprint_changed.connect(lambda *_: self._show_blueprint())
        session.selection_changed.connect(lambda *_: self._show_place())
        session.branch_changed.connect(lambda *_: self._show_place())
        for signal in (session.edited_changed, session.blueprint_changed, session.broken_changed,
                       files.changed):  # fmt: skip
            signal.connect(lambda *_: self.show_title())
        self._show_blueprint()
        self.show_title()

    def _show_blueprint(self) -> None:
        self._line.show_blueprint(self._session.blueprint)
        self._show_place()

    def _show_place(self) -> None:
        session = self._session
        chosen = next(iter(session.selection), Address(session.branch))
        self._line.show_place(session.blueprint, chosen)
        # Whoever types wants to know where the caret is, not where the graph follows it.
        self._tell_caret()

    def show_title(self) -> None:
        """Name what the window shows: the drawing, or the file of a run that is another one."""
        other = self.other()
        title = Title(other, "") if other else self._files.title
        self._row.show_title(title.name, title.edited)
        self._window.setWindowTitle(plain_text(f"{title} · SMSL Studio"))
