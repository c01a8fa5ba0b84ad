"""The result of reading a typed text: a blueprint, or ``Broken`` if the text cannot be read."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path, PurePath

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.revision import revised, with_document
from smsl_studio.errors import ConvertError, EditRefused, ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.conflict_markers import told_of_markers
from smsl_studio.smsl.forms import form_named
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.save_as import stepped


@dataclass(frozen=True)
class Broken:
    """A text that cannot be read as a blueprint, and the error with its faults."""

    file: str
    text: str
    error: ReadError

    @property
    def refusal(self) -> EditRefused:
        """The error for an edit that is tried while the text cannot be read."""
        place = self.error.place
        where = f", line {place.line}" if place else ""
        return EditRefused(
            f"the text of {PurePath(self.file).name} cannot be read{where}: {self.error.sentence}",
            place,
            "Repair the text first, or undo what was typed.",
        )


Reading = Blueprint | Broken


def faults_of(broken: Broken) -> str:
    """The number of faults in a broken text, in words."""
    return f"{counted(len(broken.error.faults), 'fault')} in the text"


def read_text(former: Blueprint, file: str, text: str) -> Reading:
    """The blueprint after one of its files got this text, or ``Broken`` if it cannot be read.

    A pure function, so a second thread may call it. Raises KeyError if the blueprint has no such
    file.
    """
    try:
        document = document_of(former, file)
        fresh = form_named(document.form).parse(text, file)
        return with_document(former, fresh)
    except ReadError as error:
        return Broken(file, text, told_of_markers(error, text, file))


def document_of(blueprint: Blueprint, file: str) -> Document:
    """The document of this file; raises KeyError if the blueprint has none."""
    for document in blueprint.documents:
        if document.file == file:
            return document
    raise KeyError(file)


def texts_of(blueprint: Blueprint, broken: Broken | None) -> dict[str, str]:
    """The text of every file as it would be saved, including a broken one."""
    texts = {document.file: document.text for document in blueprint.documents}
    if broken is not None:
        texts[broken.file] = broken.text
    return texts


def under_name(
    blueprint: Blueprint, broken: Broken | None, file: str
) -> tuple[Blueprint, Broken | None]:
    """The same blueprint and broken text, after the blueprint's own file was saved as ``file``.

    The new name may mean another form and another folder (see ``stepped``). If the form cannot
    express a text, the text is shown as a broken one, so that nothing of it is lost.
    """
    if blueprint.file == file:
        return blueprint, broken
    former = blueprint.document
    try:
        document = stepped(former, Path(file))
    except ConvertError as error:
        moved = revised(blueprint, {former: replace(former, file=file)})
        fault = ReadError(error.sentence, error.place, error.advice)
        return moved, broken or Broken(file, former.text, fault)
    moved = revised(blueprint, {former: document})
    if broken is None or broken.file != blueprint.file:
        return moved, broken
    again = read_text(moved, file, broken.text)
    return moved, again if isinstance(again, Broken) else replace(broken, file=file)
