"""Notices what other programs do to the open files.

A file without unsaved changes is read again, as an undoable step. For a file with unsaved changes
the person is asked; both texts are kept until then.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.revision import imported_anew
from smsl_studio.errors import EditRefused
from smsl_studio.studio.document.broken import Broken, Reading, read_text
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.on_disk import DiskLook
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.safety.change_bar import ChangeBar
from smsl_studio.studio.features.draw.safety.watcher import Watcher

if TYPE_CHECKING:
    from smsl_studio.studio.document.versions import Version

    Compare = Callable[[Version], None]
    """Opens the compare view with another version."""

AGAIN = 400
"""Milliseconds before a broken text is read again, because it may be written only in part."""
Sign = tuple[int, int, int] | None


class OutsideChanges(QObject):
    """Watches every file of the session."""

    said = Signal(str)
    """str: a file was read again; a sentence for a toast."""
    warned = Signal(str)
    """str: a file is gone or is no text any more; a sentence for a warning."""
    refused = Signal(object)
    """StudioError: the text of the other program cannot be shown."""

    def __init__(
        self,
        session: Session,
        files: Files,
        bar: ChangeBar,
        compare: Compare,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._files, self._bar, self._compare = session, files, bar, compare
        self._signs: dict[str, Sign] = {}
        self._watched: tuple[str, ...] = ()
        self._doubted: dict[str, str] = {}
        self._asked: dict[str, DiskLook] = {}
        self.watcher = Watcher(self)
        self.watcher.stirred.connect(self.look)
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.setInterval(AGAIN)
        self._later.timeout.connect(self._look_again)
        files.changed.connect(self._follow)
        session.blueprint_changed.connect(lambda *_: self._follow())
        session.opened.connect(self._forget)
        session.broken_changed.connect(self._look_for_missing)
        bar.difference_wanted.connect(self.show_difference)
        bar.theirs_wanted.connect(self.take_theirs)
        bar.mine_wanted.connect(self.keep_mine)

    @property
    def asked(self) -> tuple[str, ...]:
        """The files that the person is asked about."""
        return tuple(self._asked)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._later.stop()
        self.watcher.stop()

    def look(self) -> None:
        """Check every file, and handle those whose size, time or inode has changed since the
        last call."""
        for file in self._watched:
            now = _sign(file)
            if now != self._signs[file]:
                self._signs[file] = now
                self._look_at(file)

    def take_theirs(self) -> None:
        """Take the text of the other program, as an undoable step."""
        # Typed text becomes a step of its own first, so that undo brings it back.
        self._files.settling.emit()
        file = next(iter(self._asked), None)
        if file is not None and self._take(
            self._asked[file], f"Take {self._files.display(file)} from the disk"
        ):
            self._asked.pop(file, None)
            self._ask()

    def ask(self, file: str) -> None:
        """Ask about a file whose text on the disk this window has never shown."""
        look = self._files.on_disk.look(file)
        if look.text is not None and look.text != self._files.texts.get(file):
            self._files.on_disk.saw(file, None)
            self._asked[file] = look
            self._ask()

    def keep_mine(self) -> None:
        """Keep the own text, although another one is on the disk."""
        file = next(iter(self._asked), None)
        if file is not None:
            look = self._asked.pop(file)
            self._files.on_disk.saw(file, look.text)
            # The disk holds another text, so no step of the history is the saved one.
            self._session.history.resetClean()
            self._files.changed.emit()
            self._ask()

    def show_difference(self) -> None:
        """Compare the text of the other program with the drawing."""
        look = next(iter(self._asked.values()), None)
        if look is None or look.text is None:
            return
        if look.file in self._session.aside:
            self.refused.emit(_not_drawn(self._files.display(look.file)))
            return
        theirs = read_text(self._session.blueprint, look.file, look.text)
        if isinstance(theirs, Broken):
            self.refused.emit(theirs.refusal)
        else:
            name = self._files.display(look.file)
            from smsl_studio.studio.document.versions import Version

            self._compare(Version(f"{name}, as it is on the disk", theirs))

    def _follow(self) -> None:
        """Watch the files of the blueprint, and the missing files that it imports."""
        self._drop_answered()
        known = [file for file in self._files.texts if file in self._files.on_disk]
        missing = _missing(self._session.blueprint)
        before, self._watched = self._watched, tuple(dict.fromkeys([*known, *missing]))
        back = [name for name in self._watched if name in self._signs and name not in before]
        for name in self._watched:
            self._signs.setdefault(name, _sign(name))
        self.watcher.watch(Path(os.path.abspath(name)) for name in self._watched)  # noqa: PTH100
        if back:
            # These files were not watched while they were not imported.
            self.watcher.stir()

    def _drop_answered(self) -> None:
        """Drop the question about a file that was saved since, which the person agreed to."""
        texts, on_disk = self._files.texts, self._files.on_disk
        for file, look in self._asked.items():
            if texts.get(file) == look.text:
                on_disk.saw(file, look.text)
        done = [file for file in self._asked if on_disk.text(file) == texts.get(file)
                or file not in texts]  # fmt: skip
        for file in done:
            del self._asked[file]
        if done:
            self._ask()

    def _forget(self) -> None:
        """Forget everything, because another blueprint was opened."""
        self._signs.clear()
        self._watched = ()
        self._doubted.clear()
        self._asked.clear()
        self._ask()

    def _look_at(self, file: str) -> None:
        if file not in self._files.texts:
            self._found(file)
            return
        look = self._files.on_disk.look(file)
        if not look.changed:
            self._asked.pop(file, None)
            self._ask()
        elif look.gone:
            self._gone(file)
        elif look.text is None:
            self.warned.emit(f"{self._files.display(file)} was changed and is no text any more.")
        else:
            self._changed(look, look.text)

    def _changed(self, look: DiskLook, text: str) -> None:
        self._files.settling.emit()
        mine, file = self._files.texts[look.file], look.file
        if text == mine:
            self._files.on_disk.saw(file, text)
            self._settle()
        elif mine != self._files.on_disk.text(file) or self._held(file):
            self._asked[file] = look
            self._ask()
        else:
            self._read(look, text)

    def _read(self, look: DiskLook, text: str) -> None:
        """Take the text from the disk, unless it may be written only in part."""
        file, reading = look.file, read_text(self._session.blueprint, look.file, text)
        if isinstance(reading, Broken) and self._is_doubtful(file, text):
            self._doubted[file] = text
            self._later.start()
            return
        self._doubted.pop(file, None)
        name = self._files.display(file)
        self._take(look, f"{name} was changed outside this window", reading)
        self.said.emit(f"{name} was changed outside this window. The window shows its new text.")

    def _held(self, file: str) -> bool:
        """Whether another file is broken, so that no step can be made for this one."""
        broken = self._session.broken
        return broken is not None and broken.file != file

    def _is_doubtful(self, file: str, text: str) -> bool:
        """Whether a broken text may be written only in part.

        It is taken if the session is broken already or if the same text was seen twice.
        """
        return self._session.broken is None and self._doubted.get(file) != text

    def _look_again(self) -> None:
        for file in list(self._doubted):
            self._signs[file] = _sign(file)
            self._look_at(file)

    def _take(self, look: DiskLook, words: str, reading: Reading | None = None) -> bool:
        """Take the text from the disk as a step. Returns False if that is not possible yet."""
        if look.text is None:
            return False
        if look.file in self._session.aside:
            self._session.give_up(words, look.file)
        else:
            reading = reading or read_text(self._session.blueprint, look.file, look.text)
            self._session.take(words, reading, look.file)
            if self._session.texts[look.file] != look.text:
                return False
        self._files.on_disk.saw(look.file, look.text)
        self._settle()
        return True

    def _settle(self) -> None:
        """Mark the history as clean if nothing is unsaved."""
        if not self._files.unsaved:
            self._session.history.setClean()
        self._files.changed.emit()

    def _gone(self, file: str) -> None:
        self._files.on_disk.saw(file, None)
        self._asked.pop(file, None)
        self._ask()
        self._session.history.resetClean()
        self._files.changed.emit()
        self.warned.emit(
            f"{self._files.display(file)} is gone from its folder: it was deleted or moved. "
            "Save writes it again."
        )

    def _found(self, file: str) -> None:
        """Import a file that was missing and exists now."""
        self._files.settling.emit()
        if self._session.broken is not None:
            # An import now would replace the typed text with the last text that could be read.
            self._signs[file] = None
            return
        reading = imported_anew(self._session.blueprint)
        if all(os.path.realpath(document.file) != file for document in reading.documents):
            return
        name = Path(file).name
        self._session.take(f"Import {name}", reading, self._session.blueprint.file)
        self._settle()
        self.said.emit(f"{name} exists now, and is imported.")

    def _look_for_missing(self) -> None:
        if self._session.broken is None and any(self._signs[one] is None for one in self._watched):
            self.watcher.stir()

    def _ask(self) -> None:
        self._bar.show_files([self._files.display(file) for file in self._asked])


def _sign(file: str) -> Sign:
    """Time, size and inode of a file, which tell a change without reading it.

    None if it is missing.
    """
    try:
        found = os.stat(file)  # noqa: PTH116
    except (OSError, ValueError):
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


def _not_drawn(name: str) -> EditRefused:
    return EditRefused(
        f"nothing is drawn of {name}, because it is no longer imported",
        advice="Take theirs, or keep yours; undo brings yours back.",
    )


def _missing(blueprint: Blueprint) -> list[str]:
    """The imported files that could not be read."""
    imports = blueprint.imports
    here = {os.path.realpath(document.file) for document in blueprint.documents}
    wanted = [failure.wanted for failure in imports.failures] if imports else []
    return [file for file in wanted if file and file not in here]
