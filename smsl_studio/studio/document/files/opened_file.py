"""Opening a file: its blueprint, or as much of one as a faulty text allows."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint, salvage
from smsl_studio.errors import ReadError
from smsl_studio.smsl.document.conflict_markers import told_of_markers
from smsl_studio.smsl.files import read_content, text_of
from smsl_studio.smsl.forms import form_named, form_of, recovered
from smsl_studio.smsl.garbage import uncollected
from smsl_studio.studio.document.broken import Broken


@dataclass(frozen=True)
class OpenedFile:
    """The result of opening a file; ``broken`` is set if the text cannot be read as a blueprint."""

    blueprint: Blueprint
    broken: Broken | None = None


def open_file(path: Path) -> OpenedFile:
    """Open a file; raises ReadError if it cannot be read or is no text."""
    return understood(text_of(read_content(path), str(path)), str(path))


def understood(text: str, file: str) -> OpenedFile:
    """The blueprint of a text, or as much of one as a faulty text allows."""
    form = form_named(form_of(file, text))
    with uncollected():
        try:
            document = form.parse(text, file)
        except ReadError as error:
            broken = Broken(file, text, told_of_markers(error, text, file))
            return OpenedFile(salvage(recovered(text, file)), broken)
        try:
            return OpenedFile(read_blueprint(document))
        except ReadError as error:
            return OpenedFile(salvage(document), Broken(file, text, error))
