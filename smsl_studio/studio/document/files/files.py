"""Files: new, open, save, save as, recent files, and the question about unsaved work."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.project import real_path
from smsl_studio.blueprint.revision import revised
from smsl_studio.errors import SaveError, StudioError
from smsl_studio.front.approval_badge import is_generated
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.forms import SUFFIXES
from smsl_studio.smsl.traits import losses
from smsl_studio.smsl.unfinished import clear_up
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.words import counted, series
from smsl_studio.studio.document.files.fresh import UNTITLED, empty_blueprint
from smsl_studio.studio.document.files.interrupted import Settled, settle_interrupted
from smsl_studio.studio.document.files.on_disk import OnDisk
from smsl_studio.studio.document.files.opened_file import OpenedFile, open_file
from smsl_studio.studio.document.files.questions import Answer, Asker
from smsl_studio.studio.document.files.store import Pairs, store
from smsl_studio.studio.document.files.title import Title, told_apart
from smsl_studio.studio.document.save_as import (
    form_words,
    leaves_comments,
    moved,
    over_an_import,
)
from smsl_studio.studio.document.session import Session


class Files(QObject):
    """Reads and writes the files of a session. A refused action loses nothing."""

    begun = Signal()
    """Something will be open now, for the first time in this window."""
    changed = Signal()
    """The file, its name, its text on the disk, or the list of recent files changed."""
    asking = Signal()
    """The person wants another file. Emitted before any question, which may stay open for long."""
    refused = Signal(object)
    """A StudioError: a file was not opened or not saved. Everything is as before."""
    said = Signal(str)
    """A short sentence about what was done."""
    settling = Signal()
    """A save or a change of the blueprint comes next: take over what is still being typed."""

    def __init__(
        self, session: Session, settings: Settings, asker: Asker, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._settings, self._asker = session, settings, asker
        self.path: Path | None = None
        self.is_open = False
        """Whether a file was opened or a drawing was begun. At first a window has neither."""
        self.take_over: Callable[[], str] = lambda: ""
        """Takes over what is typed in a form that has a button for this. Returns why it could not,
        as a sentence; empty if nothing is left. The owner of the form sets it."""
        self.on_disk = OnDisk()
        self._name, self._left = UNTITLED, ""
        self._told: set[str] = set()
        self._given_up: set[tuple[Path, tuple[str, ...]]] = set()
        session.unsaved = lambda one: self.on_disk.is_nowhere(one.file, one.text)
        session.blueprint_changed.connect(self._begin)
        session.blueprint_changed.connect(self._learn)
        session.aside_changed.connect(self._tell_aside)

    @property
    def name(self) -> str:
        """The file name that the window shows."""
        return self._name

    @property
    def is_draft(self) -> bool:
        """Whether this is a new drawing that was never saved, or nothing at all. What was
        generated is no draft: it is whole, and in quarantine."""
        new = self.path is None and self._name == UNTITLED
        return new and not is_generated(self._session.blueprint)

    @property
    def texts(self) -> dict[str, str]:
        """All texts to be saved: those of the session, and unsaved ones that were set aside."""
        aside = {file: one.text for file, one in self._session.aside.items()
                 if self._session.unsaved(one)}  # fmt: skip
        return {**self._session.texts, **aside}

    @property
    def unsaved(self) -> tuple[str, ...]:
        """The files whose text differs from the disk; the blueprint's own file comes first."""
        return self.unsaved_of(self.texts)

    def unsaved_of(self, texts: Mapping[str, str]) -> tuple[str, ...]:
        """The files for which the disk has another text than ``texts``."""
        own = self._session.blueprint.file
        found = self.on_disk.differing(texts)
        if self.path is not None:
            return found
        others = tuple(file for file in found if file != own)
        fresh = self._session.edited or texts[own] != self._session.texts[own]
        return (own, *others) if fresh else others

    @property
    def edited(self) -> bool:
        """Whether closing would lose changes."""
        return self._session.edited and bool(self.unsaved)

    @property
    def title(self) -> Title:
        """The words for the title bar: the name, and which files are not saved."""
        if not self.edited:
            return Title(self._name, "")
        own, unsaved = self._session.blueprint.file, self.unsaved
        others = [self.display(file) for file in unsaved if file != own]
        if len(others) < len(unsaved):
            return Title(f"{self._name} and {len(others)} more" if others else self._name, "edited")
        return Title(self._name, f"{others[0]} edited" if len(others) == 1 else
                     f"{len(others)} other files edited")  # fmt: skip

    def display(self, file: str) -> str:
        """The name of a file as people know it."""
        return self._name if file == self._session.blueprint.file else Path(file).name

    @property
    def recent(self) -> tuple[Path, ...]:
        """The files opened or saved last, the newest first."""
        return self._settings.recent

    def new(self) -> None:
        """Start an empty blueprint with one SB, after asking about unsaved changes."""
        self.asking.emit()
        if self.may_leave():
            self.show(OpenedFile(empty_blueprint()), None, UNTITLED)

    def open(self, path: Path | None = None) -> bool:
        """Open a file; without ``path`` ask for one.

        False if it cannot be read or the person cancels.
        """
        self.asking.emit()
        if path is None:
            path = self._asker.file_to_open(self._folder())
        opened = self._read(path) if path is not None else None
        self.settling.emit()
        edited = self._session.edited
        if path is None or opened is None or not self.may_leave():
            return False
        if edited:
            # The person may just have saved to this very file.
            opened = self._read(path)
            if opened is None:
                return False
        self.show(opened, path.absolute(), path.name)
        self._settings.remember(path.absolute())
        self.changed.emit()
        return True

    def open_copy(self, path: Path, change: Callable[[Blueprint], Blueprint] | None = None) -> bool:
        """Open a sample as a new blueprint with its name. ``change`` may change it before.

        False if it cannot be read, or if the person keeps the blueprint that is open.
        """
        self.asking.emit()
        opened = self._read(path)
        if opened is None or not self.may_leave():
            return False
        made = replace(opened, blueprint=change(opened.blueprint)) if change else opened
        self.show(made, None, path.name)
        return True

    def show(self, opened: OpenedFile, path: Path | None, name: str) -> None:
        """Show an opened file. ``path`` is its place on the disk, None if it has none."""
        self._begin()
        self.path, self._name = path, name
        self.on_disk.forget()
        self._session.open(opened.blueprint, opened.broken)
        self._learn(opened.blueprint, opened.blueprint)
        self.changed.emit()
        self._say_how_yaml_is_written()

    def _begin(self, *_: object) -> None:
        if not self.is_open:
            self.is_open = True
            self.begun.emit()

    def save(self, by_itself: bool = False) -> bool:
        """Save all texts that differ from the disk, all or none.

        Ask for a place if there is none yet. A save ``by_itself`` leaves a form alone in which
        somebody may be typing.
        """
        self.settling.emit()
        self._left = "" if by_itself else self.take_over()
        if self.path is None:
            return self.save_as()
        files = self.unsaved
        own = self._session.blueprint.file
        if not files and not self.on_disk.look(own).changed:
            self._saved(())
            return True
        return self._store(files or (own,))

    def save_as(self) -> bool:
        """Ask for a place and save the blueprint's own text there; the suffix decides the form."""
        self.settling.emit()
        self._left = self.take_over()
        path = self._asker.file_to_save(self.path or self._folder() / self._name)
        return path is not None and self._save_to(path.absolute())

    def may_leave(self) -> bool:
        """Whether the blueprint may be closed: there is nothing unsaved, or the person decided."""
        answer = self.ask_unsaved()
        return self.save() if answer == "save" else answer == "discard"

    def ask_unsaved(self, several: bool = False) -> Answer:
        """Ask what to do with unsaved changes; ``discard`` if there are none.

        ``several`` says that several windows are asked about. Two of them may show files with the
        same name, so the question then says more about the file.
        """
        self.settling.emit()
        left = self.take_over()
        if left and not self._asker.may_drop(left):
            return "cancel"
        if not self.edited:
            return "discard"
        names = [self.display(file) for file in self.unsaved]
        has = "has" if len(names) == 1 else "have"
        said = f"{series(names)} {has} unsaved changes."
        if several:
            said = f"{said} {told_apart(self._name, self.path, self._session)}"
        return self._asker.unsaved(said)

    def _folder(self) -> Path:
        if self.path is not None:
            return self.path.parent
        return self.recent[0].parent if self.recent else Path.home()

    def _read(self, path: Path) -> OpenedFile | None:
        try:
            opened = open_file(path)
            settled = self.settle_interrupted(path, opened)
            if settled == "called off":
                return None
            clear_up(Path(real_path(str(path))).parent)
            return open_file(path) if settled == "changed" else opened
        except StudioError as error:
            self._settings.forget(path.absolute())
            self.refused.emit(error)
            self.changed.emit()
            return None

    def settle_interrupted(self, path: Path, opened: OpenedFile) -> Settled:
        """Ask about interrupted saves of an opened file and of the files that it imports."""
        imported = [document.file for document in opened.blueprint.documents[1:]]
        try:
            return settle_interrupted([str(path), *imported], self._asker)
        except SaveError as error:
            # The texts that were read are valid, so they can still be shown.
            self.refused.emit(error)
            return "nothing"

    def _learn(self, before: Blueprint, after: Blueprint) -> None:
        """Remember the texts on the disk of files that came with an import or came back by an
        undo."""
        texts = self._session.texts
        if self.path is None:
            texts.pop(self._session.blueprint.file, None)
        former = {document.file for document in before.documents}
        for file in texts.keys() - former:
            if file in self.on_disk and self.on_disk.look(file).text == texts[file]:
                self.on_disk.saw(file, texts[file])
        self.on_disk.saw_if_new(texts)

    def _tell_aside(self) -> None:
        """Say which unsaved files are no longer imported, because the person may not notice it."""
        names = [Path(file).name for file in self.unsaved if file in self._session.aside]
        self.changed.emit()
        if names:
            verb = "is" if len(names) == 1 else "are"
            self.said.emit(f"{series(names)} {verb} no longer imported. Save keeps what is "
                           "unsaved there.")  # fmt: skip

    def _say_how_yaml_is_written(self) -> None:
        """Say how YAML is written: once for each file, before the first edit."""
        forms = {document.file: document.form for document in self._session.blueprint.documents}
        yaml = [file for file in forms if forms[file] == "yaml" and file not in self._told]
        self._told.update(yaml)
        if yaml:
            names = series([self.display(file) for file in yaml])
            self.said.emit(f"{names}: YAML is written whole when it is edited; comments may move.")

    def _store(self, files: Sequence[str]) -> bool:
        """Write these files of the session to their places; returns whether that was done."""
        if not self._may_save_broken(files):
            return False
        if not self._written([(self._document(file), self._place(file)) for file in files]):
            return False
        self._session.saved(self._session.blueprint)
        self._saved([self.display(file) for file in files])
        return True

    def _save_to(self, path: Path) -> bool:
        """Write the own text to another place, and other unsaved files to their places."""
        session = self._session
        own, broken = session.blueprint.file, session.broken
        if self.path is not None and path == self.path:
            return self._store((own, *(file for file in self.unsaved if file != own)))
        others = [file for file in self.unsaved if file != own]
        if self._is_imported(path):
            self.refused.emit(over_an_import(path.name))
            return False
        if not (self._may_save_broken([own, *others]) and self._comments_may_go(path)):
            return False
        try:
            found = moved(self._document(own), path, whole=broken is None or broken.file != own)
        except StudioError as error:
            self.refused.emit(error)
            return False
        pairs = [(self._document(file), self._place(file)) for file in others]
        if not self._written([(found.document, path), *pairs], chosen=path):
            return False
        self.path, self._name = path, path.name
        former = session.blueprint.document
        # The document of a broken text is that of the last text that could be read.
        named = found.document if found.anew else replace(former, file=str(path))
        session.saved(revised(session.blueprint, {former: named}))
        self._learn(session.blueprint, session.blueprint)
        self._settings.remember(path)
        self._say_how_yaml_is_written()
        self._saved([path.name, *map(self.display, others)])
        if path.suffix.lower() not in SUFFIXES:
            kind, known = form_words(path, found.document), series(list(SUFFIXES))
            self.said.emit(f"Saved {path.name} as {kind}. Names with {known} say the form.")
        return True

    def _written(self, pairs: Pairs, chosen: Path | None = None) -> bool:
        """Write documents to their places (see ``store``); returns whether that was done."""

        def ask(files: list[str]) -> bool:
            """Ask whether these files may be overwritten."""
            return self._asker.may_overwrite(series([self.display(file) for file in files]))

        if not self._may_lose([path for _, path in pairs]):
            return False
        try:
            return store(pairs, self.on_disk, ask, chosen)
        except StudioError as error:
            self.refused.emit(error)
            return False

    def _may_lose(self, paths: Sequence[Path]) -> bool:
        """Ask once before a file loses its owner, group, permissions or hard links."""
        for path in paths:
            lost: tuple[str, ...] = ()
            with suppress(OSError):  # the save itself will report it
                lost = losses(Path(real_path(str(path))))
            if not lost or (path, lost) in self._given_up:
                continue
            if not self._asker.may_lose(f"Saved, {path.name} loses {series(lost)}."):
                return False
            self._given_up.add((path, lost))
        return True

    def _saved(self, names: Sequence[str]) -> None:
        self.changed.emit()
        said = f"Saved {series(names)}." if names else f"{self._name} is saved already."
        self.said.emit(f"{said} {self._left}".rstrip())

    def _document(self, file: str) -> Document:
        """A document as it will be written, with the typed text if that is broken."""
        documents = {document.file: document for document in self._session.blueprint.documents}
        return replace({**self._session.aside, **documents}[file], text=self.texts[file])

    def _is_imported(self, path: Path) -> bool:
        others = (*self._session.blueprint.documents[1:], *self._session.aside.values())
        return any(real_path(one.file) == real_path(str(path)) for one in others)

    def _place(self, file: str) -> Path:
        own = self.path is not None and file == self._session.blueprint.file
        return self.path if own and self.path is not None else Path(file)

    def _may_save_broken(self, files: Sequence[str]) -> bool:
        broken = self._session.broken
        if broken is None or broken.file not in files:
            return True
        faults = counted(len(broken.error.faults), "fault")
        return self._asker.may_save_broken(self.display(broken.file), faults)

    def _comments_may_go(self, path: Path) -> bool:
        document = self._session.blueprint.document
        if not leaves_comments(document, path):
            return True
        return self._asker.may_leave_comments(self._name, form_words(path, document))
