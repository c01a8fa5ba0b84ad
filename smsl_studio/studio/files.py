"""Files: new, open, save, save as, recent files, and the guard before unsaved work is lost."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal, Protocol

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import new_blueprint
from smsl_studio.errors import StudioError
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.files import read_document, save_document
from smsl_studio.smsl.forms import SUFFIXES
from smsl_studio.studio.session import Session
from smsl_studio.studio.settings import Settings

Answer = Literal["save", "discard", "cancel"]
UNTITLED = "untitled.json"


class Asker(Protocol):
    """Who asks the person; the dialogs of the window, or a test."""

    def file_to_open(self, folder: Path) -> Path | None:
        """The file to open, None where it was called off."""

    def file_to_save(self, suggested: Path) -> Path | None:
        """Where to save, None where it was called off."""

    def unsaved(self, name: str) -> Answer:
        """What becomes of unsaved changes."""


class Files(QObject):
    """Where the session's blueprint comes from and goes to. Nothing is lost on a refusal."""

    changed = Signal()
    """The file, its name or the recent files have changed."""
    refused = Signal(object)
    """A StudioError: the file was not opened or not saved; what was there still is."""
    said = Signal(str)
    """Something that went well, in a short sentence."""
    settling = Signal()
    """The blueprint is about to be saved or left: what is still being typed has to be in it."""

    def __init__(
        self, session: Session, settings: Settings, asker: Asker, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._settings, self._asker = session, settings, asker
        self.path: Path | None = None
        self._name = UNTITLED

    @property
    def name(self) -> str:
        """The name that the window shows."""
        return self._name

    @property
    def recent(self) -> tuple[Path, ...]:
        return self._settings.recent

    def new(self) -> None:
        """Start an empty blueprint with one SB."""
        if self.may_leave():
            self._show(empty_blueprint(), None, UNTITLED)

    def open(self, path: Path | None = None) -> bool:
        """Open a file (asking which); False where it cannot be read or was called off."""
        if path is None:
            path = self._asker.file_to_open(self._folder())
        blueprint = self._read(path) if path is not None else None
        self.settling.emit()
        edited = self._session.edited
        if path is None or blueprint is None or not self.may_leave():
            return False
        if edited:
            # The answer may have been to save, and that to this very file.
            blueprint = self._read(path)
            if blueprint is None:
                return False
        self._show(blueprint, path.absolute(), path.name)
        self._settings.remember(path.absolute())
        self.changed.emit()
        return True

    def open_copy(self, path: Path) -> bool:
        """Open a sample as a new blueprint of that name; saving asks where to."""
        blueprint = self._read(path)
        if blueprint is None or not self.may_leave():
            return False
        self._show(blueprint, None, path.name)
        return True

    def save(self) -> bool:
        """Save where the blueprint came from, or ask where to."""
        self.settling.emit()
        return self._write(self.path) if self.path is not None else self.save_as()

    def save_as(self) -> bool:
        """Ask where to save, and save there."""
        self.settling.emit()
        path = self._asker.file_to_save(self.path or self._folder() / self._name)
        return path is not None and self._write(path)

    def may_leave(self) -> bool:
        """Whether the blueprint may go: it is saved, or the person says what becomes of it."""
        self.settling.emit()
        if not self._session.edited:
            return True
        answer = self._asker.unsaved(self._name)
        return self.save() if answer == "save" else answer == "discard"

    def _folder(self) -> Path:
        if self.path is not None:
            return self.path.parent
        return self.recent[0].parent if self.recent else Path.home()

    def _read(self, path: Path) -> Blueprint | None:
        try:
            return read_blueprint(read_document(path))
        except StudioError as error:
            self._settings.forget(path.absolute())
            self.refused.emit(error)
            self.changed.emit()
            return None

    def _show(self, blueprint: Blueprint, path: Path | None, name: str) -> None:
        self.path, self._name = path, name
        self._session.open(blueprint)
        self.changed.emit()

    def _write(self, path: Path) -> bool:
        blueprint = self._session.blueprint
        document = replace(blueprint.document, file=str(path))
        try:
            save_document(document, path)
        except StudioError as error:
            self.refused.emit(error)
            return False
        self.path, self._name = path.absolute(), path.name
        self._session.saved(replace(blueprint, document=document))
        self._settings.remember(path.absolute())
        self.changed.emit()
        self.said.emit(f"Saved {path.name}.")
        return True


def samples() -> tuple[Path, ...]:
    """The samples that come along, in every form."""
    found = (path for path in samples_dir().iterdir() if path.suffix in SUFFIXES)
    return tuple(sorted(found))


def empty_blueprint() -> Blueprint:
    """What New shows: one SB without states."""
    blank = new_blueprint(UNTITLED)
    return editing.add_branch(blank, fresh_branch_name(blank))
