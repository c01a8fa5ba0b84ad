"""What other programs do to the files that are open: noticed, told, and never overwritten unseen.

A file without unsaved changes follows the disk as a step of the history. One with unsaved changes
is asked about, and both texts stay until the person has decided.
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
    from smsl_studio.studio.features.draw.compare.versions import Version

    Compare = Callable[[Version], None]
    """Shows the difference from another version to what is drawn."""

AGAIN = 400
"""Milliseconds after which one looks again at a text that does not read: it may be half written."""
Sign = tuple[int, int, int] | None


class OutsideChanges(QObject):
    """Watches every file of the session."""

    said = Signal(str)
    """A file was taken over as it is now."""
    warned = Signal(str)
    """A file is gone, or cannot be read any more."""
    refused = Signal(object)
    """A StudioError: what the other program wrote cannot be shown."""

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
        """The window closes."""
        self._later.stop()
        self.watcher.stop()

    def look(self) -> None:
        """Look at every file whose size, time or identity is another than last time."""
        for file in self._watched:
            now = _sign(file)
            if now != self._signs[file]:
                self._signs[file] = now
                self._look_at(file)

    def take_theirs(self) -> None:
        """Show what the other program wrote, as a step that can be undone."""
        # What is being typed is a step of its own, so that undo brings it back.
        self._files.settling.emit()
        file = next(iter(self._asked), None)
        if file is not None and self._take(
            self._asked[file], f"Take {self._files.display(file)} from the disk"
        ):
            self._asked.pop(file, None)
            self._ask()

    def ask(self, file: str) -> None:
        """Ask about a file of which another program has written what nobody here has seen."""
        look = self._files.on_disk.look(file)
        if look.text is not None and look.text != self._files.texts.get(file):
            self._files.on_disk.saw(file, None)
            self._asked[file] = look
            self._ask()

    def keep_mine(self) -> None:
        """Go on with the own text, knowing that another one stands on the disk."""
        file = next(iter(self._asked), None)
        if file is not None:
            look = self._asked.pop(file)
            self._files.on_disk.saw(file, look.text)
            # Whatever was saved before is not what stands there now.
            self._session.history.resetClean()
            self._files.changed.emit()
            self._ask()

    def show_difference(self) -> None:
        """Show the difference from their text to what is drawn."""
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
            from smsl_studio.studio.features.draw.compare.versions import Version

            self._compare(Version(f"{name}, as it is on the disk", theirs))

    def _follow(self) -> None:
        """Watch what belongs to the blueprint now, and what it looks for in vain."""
        self._drop_answered()
        known = [file for file in self._files.texts if file in self._files.on_disk]
        missing = _missing(self._session.blueprint)
        before, self._watched = self._watched, tuple(dict.fromkeys([*known, *missing]))
        back = [name for name in self._watched if name in self._signs and name not in before]
        for name in self._watched:
            self._signs.setdefault(name, _sign(name))
        self.watcher.watch(Path(os.path.abspath(name)) for name in self._watched)  # noqa: PTH100
        if back:
            # Nobody has looked at these while they were imported no longer.
            self.watcher.stir()

    def _drop_answered(self) -> None:
        """What was saved over, with the person's consent, is no question any more."""
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
        """Another blueprint is shown."""
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
        """Follow the disk, unless what stands there is half done."""
        file, reading = look.file, read_text(self._session.blueprint, look.file, text)
        if isinstance(reading, Broken) and self._is_doubtful(file, text):
            self._doubted[file] = text
            self._later.start()
            return
        self._doubted.pop(file, None)
        name = self._files.display(file)
        self._take(look, f"{name} was changed by another program", reading)
        self.said.emit(f"{name} was changed by another program. Shown is what it holds now.")

    def _held(self, file: str) -> bool:
        """Whether another text does not read, so that no step can be made in this one."""
        broken = self._session.broken
        return broken is not None and broken.file != file

    def _is_doubtful(self, file: str, text: str) -> bool:
        """Whether a text that does not read did before, and was not seen twice."""
        return self._session.broken is None and self._doubted.get(file) != text

    def _look_again(self) -> None:
        for file in list(self._doubted):
            self._signs[file] = _sign(file)
            self._look_at(file)

    def _take(self, look: DiskLook, words: str, reading: Reading | None = None) -> bool:
        """Make a step of what another program wrote; False where that cannot be done yet."""
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
        """Where nothing is unsaved any more, the history is clean here."""
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
        """A file that was imported in vain is there now."""
        self._files.settling.emit()
        if self._session.broken is not None:
            # Importing it would put the last text that read in the place of what is typed.
            self._signs[file] = None
            return
        reading = imported_anew(self._session.blueprint)
        if all(os.path.realpath(document.file) != file for document in reading.documents):
            return
        name = Path(file).name
        self._session.take(f"Import {name}", reading, self._session.blueprint.file)
        self._settle()
        self.said.emit(f"{name} is there now, and imported.")

    def _look_for_missing(self) -> None:
        if self._session.broken is None and any(self._signs[one] is None for one in self._watched):
            self.watcher.stir()

    def _ask(self) -> None:
        self._bar.show_files([self._files.display(file) for file in self._asked])


def _sign(file: str) -> Sign:
    """What tells that a file is another one, without reading it; None where there is none."""
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
    """The files that are imported and could not be read."""
    imports = blueprint.imports
    here = {os.path.realpath(document.file) for document in blueprint.documents}
    wanted = [failure.wanted for failure in imports.failures] if imports else []
    return [file for file in wanted if file and file not in here]
