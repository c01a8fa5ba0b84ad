"""The title of the window, and the place in the file for the status line."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMainWindow

from smsl_studio.blueprint.address import Address
from smsl_studio.legible import plain_text
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.title import Title
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.shell.frame.menu_row import MenuRow
from smsl_studio.studio.shell.frame.status_line import StatusLine

PROGRAM = "SMSL Studio"


class Captions(QObject):
    """Updates the title and the status line when session or files change."""

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
        """Returns the file that is shown instead of the drawing; empty for none."""
        session.afterwards.follow(self._show_blueprint, session.blueprint_changed)
        chosen = session.selection_changed, session.branch_changed
        session.afterwards.follow(self._show_place, session.blueprint_changed, *chosen)
        for signal in (session.edited_changed, session.blueprint_changed, session.broken_changed,
                       files.changed):  # fmt: skip
            signal.connect(lambda *_: self.show_title())
        self._show_blueprint()
        self._show_place()
        self.show_title()

    def _show_blueprint(self) -> None:
        self._line.show_blueprint(self._session.blueprint)

    def _show_place(self) -> None:
        session = self._session
        chosen = next(iter(session.selection), Address(session.branch))
        self._line.show_place(session.blueprint, chosen)
        # While somebody types in the source, the status line shows the caret, not the selected
        # element.
        self._tell_caret()

    def show_title(self) -> None:
        """Show the name of the drawing, or of the file of a run that is another one."""
        other = self.other()
        self._row.show_unsettled(bool(other) or not self._files.is_draft)
        title = Title(other, "") if other else self._files.title
        if not other and not self._files.is_open:
            self._row.show_title(PROGRAM, "")
            self._window.setWindowTitle(PROGRAM)
            return
        self._row.show_title(title.name, title.edited)
        self._window.setWindowTitle(plain_text(f"{title} · {PROGRAM}"))
