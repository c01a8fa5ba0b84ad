"""What a person does with files of other programs: import one, export for one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QObject

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import StudioError, UsageError
from smsl_studio.exchange.findings import ExchangeFinding
from smsl_studio.exchange.table import FORMS, READ, WRITTEN, suffix_of
from smsl_studio.front.exchanges import Exported, Imported, exported, imported
from smsl_studio.legible import plain_text
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.file_dialogs import ask_to_open, ask_to_save
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.files.opened_file import OpenedFile
from smsl_studio.studio.features.exchange.findings_dialog import FindingsDialog
from smsl_studio.studio.running.window_parts import WindowParts

KINDS = {f"{one.words} (*{one.suffix})": one.suffix for one in FORMS if one.written}
READABLE = f"Files of other programs ({' '.join(f'*{one}' for one in READ)} statemachine.json)"


class ExchangeVerbs(QObject):
    """Reads and writes in the background. What was left out is shown in a list."""

    def __init__(self, parts: WindowParts, tokens: Callable[[], Tokens]) -> None:
        super().__init__(parts.window)
        self._parts, self._tokens = parts, tokens
        self.beside = Beside(self)

    def import_file(self) -> None:
        """Ask for a file of another program and read it."""
        name = ask_to_open(
            self._parts.window, "Import from another program", str(self._folder()), READABLE
        )
        if name:
            self.read(Path(name))

    def read(self, path: Path) -> None:
        """Read a file of another program as a new blueprint."""

        def tried() -> Imported | StudioError:
            try:
                return imported(path)
            except StudioError as error:
                return error

        self._work("Reading…", tried, lambda came: self._show(path, came))

    def export_file(self) -> None:
        """Ask for a place and write the blueprint in the form of its suffix."""
        files = self._parts.files
        files.settling.emit()
        suggested = self._folder() / f"{Path(files.name).stem}{WRITTEN[0]}"
        name, kind = ask_to_save(
            self._parts.window, "Export for another program", str(suggested), ";;".join(KINDS)
        )
        if not name:
            return
        path = Path(name)
        if not suffix_of(name, WRITTEN):
            path = path.with_name(f"{path.name}{KINDS.get(kind, WRITTEN[0])}")
            if path.exists():  # the dialog has asked about the shorter name alone
                words = f"{path.name} is there already"
                advice = "Write its whole name to replace it."
                self._parts.toast.refuse(UsageError(words, advice=advice))
                return
        self.write(path)

    def write(self, path: Path) -> None:
        """Write the blueprint that is open, in the form of the suffix."""
        blueprint = self._parts.session.blueprint

        def tried() -> Exported | StudioError:
            try:
                made = exported(blueprint, path)
                files = tuple(document.file for document in blueprint.documents)
                save_document(made.text, path, made_of=files)
                return made
            except StudioError as error:
                return error

        self._work("Writing…", tried, lambda came: self._tell_written(path, came))

    def _show(self, path: Path, came: Imported | StudioError) -> None:
        files, toast = self._parts.files, self._parts.toast
        if isinstance(came, StudioError):
            toast.refuse(came)
            return
        files.asking.emit()
        if not files.may_leave():
            toast.hide()
            return
        name = f"{path.name.partition('.')[0] or 'imported'}.json"
        files.show(OpenedFile(_named(came.blueprint, name)), None, name)
        said = f"Imported {path.name}: {counted(came.blueprint.state_count, 'state')}."
        self._tell(said, "Import", came.findings)

    def _tell_written(self, path: Path, came: Exported | StudioError) -> None:
        if isinstance(came, StudioError):
            self._parts.toast.refuse(came)
            return
        self._tell(f"Wrote {path.name}.", "Export", came.findings)

    def _tell(self, said: str, title: str, findings: Sequence[ExchangeFinding]) -> None:
        self._parts.toast.say(plain_text(said))
        if findings:
            dialog = FindingsDialog(title, said, findings, self._tokens(), self._parts.window)
            dialog.show()

    def _work(self, words: str, work: Callable[[], object], then: Callable[..., object]) -> None:
        self.beside.drop()
        self._parts.toast.offer(words, "Cancel", self.beside.drop)
        self.beside.do(work, then)

    def _folder(self) -> Path:
        path = self._parts.files.path
        return path.parent if path is not None else Path.home()


def _named(blueprint: Blueprint, name: str) -> Blueprint:
    """Return a blueprint under a name in the window, not under that of the file it came from."""
    return read_blueprint(parse_json(blueprint.document.text, name))
