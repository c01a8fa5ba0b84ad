"""Chooses the version to compare with, and keeps the compare view up to date."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import AddressError, StudioError
from smsl_studio.studio.base.actions import key_words
from smsl_studio.studio.base.beside import Beside, Came
from smsl_studio.studio.base.run_keys import lend_run_keys
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.compare.keys import NEXT_KEYS

if TYPE_CHECKING:
    from smsl_studio.front.revisions import Revision
    from smsl_studio.front.views.claim_run import RunStep
    from smsl_studio.studio.document.versions import Version
    from smsl_studio.studio.features.draw.compare.dialog import CompareDialog

    Runs = tuple[Sequence[RunStep], Sequence[RunStep]]

WAIT = 120
"""Milliseconds after an edit before the compare view is updated."""
BACK = f"{key_words(NEXT_KEYS)} goes back to the compare view, to the next change."
"""Shown when the drawing comes to the front, because it may hide the compare view."""


class Comparison(QObject):
    """Shows what changed from another version to the blueprint that is drawn now.

    The compare view follows every edit while it is open. ``ask_file`` asks for a file, starting in
    a folder; None means cancelled.
    """

    refused = Signal(object)
    """StudioError: the other version cannot be found or read."""
    element_shown = Signal(object)
    """Address: a changed element was selected in the drawing and has to be scrolled to."""
    said = Signal(str)
    """str: a hint about the next step, for a toast."""
    changed = Signal()
    """The compare view was opened or closed."""

    def __init__(
        self,
        session: Session,
        files: Files,
        ask_file: Callable[[Path], Path | None],
        tokens: Tokens,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self._session, self._files, self.ask_file = session, files, ask_file
        self._tokens, self._window = tokens, parent
        self.wish: Callable[[str], bool | None] = lambda file: None
        """A function that takes the file of the drawing. It returns whether the person wants this
        drawing collapsed."""
        self._version: Version | None = None
        self._dialog: CompareDialog | None = None
        # git may take long if the history is long.
        self._beside = Beside(self)
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.setInterval(WAIT)
        self._later.timeout.connect(self._refresh)
        session.blueprint_changed.connect(lambda *_: self._follow())
        session.broken_changed.connect(self._follow)
        session.opened.connect(self.close)

    @property
    def dialog(self) -> CompareDialog | None:
        """The compare view, while it is open."""
        return self._dialog

    @property
    def is_open(self) -> bool:
        """Whether the compare view is open."""
        return self._dialog is not None

    @property
    def can_use_saved(self) -> bool:
        """Whether the blueprint has a file to compare with."""
        return self._files.path is not None

    def with_file(self) -> None:
        """Ask for a file and compare with it."""
        self.choose_file(self._compare)

    def with_saved(self) -> None:
        """Compare with the text that was last saved or read."""
        self.choose_saved(self._compare)

    def with_revision(self) -> None:
        """Ask for a commit, and compare the drawing with the file of that commit."""
        self.choose_revision(self._compare)

    def choose_file(self, then: Callable[[Version], object]) -> None:
        """Ask for a file, and call ``then`` with it as a version."""
        from smsl_studio.studio.document.versions import in_file

        self._files.settling.emit()
        folder = self._files.path.parent if self._files.path else Path.cwd()
        path = self.ask_file(folder)
        if path is not None:
            self._hand_over(then, _tried(partial(in_file, path)))

    def choose_saved(self, then: Callable[[Version], object]) -> None:
        """Call ``then`` with the text that was last saved or read, as a version."""
        from smsl_studio.studio.document.versions import as_saved

        self._files.settling.emit()
        file = self._session.blueprint.file
        text, name = self._files.on_disk.text(file), self._files.name
        self._hand_over(then, _tried(partial(as_saved, text, file, name)))

    def choose_revision(self, then: Callable[[Version], object]) -> None:
        """Ask for a commit, and call ``then`` with the file of that commit as a version."""
        from smsl_studio.front.revisions import revisions

        self._files.settling.emit()
        path = self._files.path
        if path is None:
            return
        self._beside.drop()
        self._beside.do(
            partial(_tried, partial(revisions, path)), partial(self._ask_which, path, then)
        )

    def with_signed(self) -> None:
        """Compare with the content that was signed last."""
        from smsl_studio.studio.document.versions import as_signed

        self._files.settling.emit()
        self._beside.drop()
        work = partial(_tried, partial(as_signed, self._session.blueprint))
        self._beside.do(work, partial(self._hand_over, self._compare))

    def with_version(self, version: Version) -> None:
        """Compare with a version that is already loaded."""
        self._compare(version)

    def play(self, version: Version, runs: Runs) -> None:
        """Compare with a version, and walk through a run on both sides up to a difference."""
        self._compare(version)
        if self._dialog is not None:
            self._dialog.show_runs(*runs)

    def next_change(self) -> None:
        """Go to the next change, if the compare view is open."""
        if self._dialog is not None:
            self._dialog.show_next()
            self._come_to_front(self._dialog)

    def previous_change(self) -> None:
        """Go to the previous change, if the compare view is open."""
        if self._dialog is not None:
            self._dialog.show_previous()
            self._come_to_front(self._dialog)

    def close(self) -> None:
        """Close the compare view, because another file was opened."""
        if self._dialog is not None:
            self._dialog.close()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._later.stop()
        self._beside.stop()
        self.close()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme, in the open compare view too."""
        self._tokens = tokens
        if self._dialog is not None:
            self._dialog.set_tokens(tokens)

    def _hand_over(self, then: Callable[[Version], object], version: Version | StudioError) -> None:
        if isinstance(version, StudioError):
            self.refused.emit(version)
        else:
            then(version)

    def _ask_which(
        self,
        path: Path,
        then: Callable[[Version], object],
        found: tuple[Revision, ...] | StudioError,
    ) -> None:
        if isinstance(found, StudioError):
            self.refused.emit(found)
        elif path == self._files.path:
            from smsl_studio.studio.features.draw.compare.revision_dialog import RevisionDialog

            asking = RevisionDialog(path.name, found, self._tokens, self._window)
            asking.chosen.connect(lambda revision: self._with(path, then, revision))
            asking.open()

    def _with(self, path: Path, then: Callable[[Version], object], revision: Revision) -> None:
        from smsl_studio.studio.document.versions import at_revision

        work = partial(_tried, partial(at_revision, path, revision))
        self._beside.do(work, partial(self._hand_over, then))

    def _compare(self, version: Version) -> None:
        from smsl_studio.studio.features.draw.compare.dialog import CompareDialog

        self._version = version
        if self._dialog is not None:
            self._dialog.close()
        self._dialog = CompareDialog(self._tokens, self._window)
        self._dialog.collapse(self.wish(self._session.blueprint.file))
        self._dialog.stand_alone(self._window)
        lend_run_keys(self._dialog, self._window)
        self._dialog.element_wanted.connect(self._show_element)
        self._dialog.undo_wanted.connect(self._undo)
        self._dialog.redo_wanted.connect(self._redo)
        self._dialog.finished.connect(self._closed)
        self._refresh()
        self._dialog.show()
        self.changed.emit()

    def _follow(self) -> None:
        if self._dialog is not None:
            self._later.start()

    def _refresh(self) -> None:
        if self._dialog is None or self._version is None:
            return
        session, name = self._session, self._files.name
        words = f"{name}, as it is drawn"
        if session.broken is not None:
            words = f"{name}, as it last could be read"
        difference = self._version.until(session.blueprint)
        self._dialog.show_difference(difference, self._version.words, words)

    def _undo(self) -> None:
        self._files.settling.emit()
        self._session.history.undo()

    def _redo(self) -> None:
        self._files.settling.emit()
        self._session.history.redo()

    def _closed(self) -> None:
        if self.sender() is self._dialog:
            self._dialog = self._version = None
            self.changed.emit()

    def _show_element(self, address: Address) -> None:
        """Select the element in the drawing, or the nearest parent that still exists."""
        wanted: Address | None = address
        while wanted is not None:
            try:
                found = self._session.blueprint.resolve(wanted)
            except AddressError:
                wanted = wanted.parent
                continue
            self._session.show_branch(found.branch)
            self._session.select((found,) if found.state else ())
            self.element_shown.emit(found)
            self._come_to_front(self._window)
            self.said.emit(BACK)
            return

    def _come_to_front(self, window: QWidget) -> None:
        """Raise a window: on a small screen, drawing and compare view hide each other."""
        window.raise_()
        window.activateWindow()


def _tried(work: Callable[[], Came]) -> Came | StudioError:
    """The result of a function, or the StudioError that it raised."""
    try:
        return work()
    except StudioError as error:
        return error
