"""The dialog for a picture as a file: what, which form, how large, and a preview."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QRectF, QSizeF, Signal
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QFileDialog, QWidget

from smsl_studio.front.outputs import picture_form
from smsl_studio.legible import one_line
from smsl_studio.picture.paper import png_scale, size_of
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.base.file_dialogs import fit_to_screen
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.export.picture_dialog import PictureDialog
from smsl_studio.studio.features.export.preview import PaperSheet, as_image
from smsl_studio.studio.features.export.subject import Subject

FORMS = {"SVG": ".svg", "PNG": ".png", "PDF": ".pdf"}
SCALES = {"1 ×": 1.0, "2 ×": 2.0, "3 ×": 3.0, "4 ×": 4.0}


FULLER = (
    "The canvas is zoomed out and shortens names and facts. The picture has them whole where there "
    "is room."
)


@dataclass(frozen=True)
class FileChoices:
    """What was chosen last, for the next time."""

    form: str = ".svg"
    scale: float = 2.0
    theme: str = "light"


class ExportDialog(PictureDialog):
    """Writes a picture. The suffix of the name decides the form, as everywhere."""

    written = Signal(object)
    """Path: the file is there."""

    def __init__(
        self,
        subjects: Mapping[str, Subject],
        choices: FileChoices,
        folder: Path,
        tokens: Tokens,
        parent: QWidget,
    ) -> None:
        super().__init__(subjects, "Export picture", "Export…", tokens, parent)
        self._folder = folder
        self.form = self.choice("Form", FORMS)
        self.scale = self.choice("Scale", SCALES)
        self.theme = self.choice("Colours", {"Light": "light", "Dark": "dark"})
        for combo, value in (
            (self.form, choices.form),
            (self.scale, choices.scale),
            (self.theme, choices.theme),
        ):
            combo.setCurrentIndex(max(combo.findData(value), 0))
        self.lay_out()
        self._svg = ""
        for combo in (self.what, self.bundling, self.theme):
            combo.currentIndexChanged.connect(self._draw)
        for combo in (self.form, self.scale):
            combo.currentIndexChanged.connect(self._tell)
        self.go.clicked.connect(self._export)
        self._draw()

    @property
    def choices(self) -> FileChoices:
        """What is chosen now."""
        return FileChoices(
            str(self.form.currentData()),
            float(self.scale.currentData()),
            str(self.theme.currentData()),
        )

    def _draw(self) -> None:
        subject, theme = self.subject, self.choices.theme
        self._svg = ""
        self._tell()

        def draw() -> tuple[str, QImage]:
            svg = subject.svg(theme)
            return svg, as_image(svg)

        self.work("Drawing the preview…", draw, self._show)

    def _show(self, drawn: tuple[str, QImage]) -> None:
        self._svg, image = drawn
        whole = QRectF(image.rect())
        self.preview.show_rows([[PaperSheet(QSizeF(image.size()), image, whole, whole)]])
        self._tell()

    def _tell(self) -> None:
        """Say how large the file's picture will be."""
        choices = self.choices
        self.scale.setEnabled(choices.form == ".png" and not self.busy)
        if not self._svg:
            self.facts.setText("")
            return
        wide, high = size_of(self._svg)
        words = {
            ".svg": f"{wide:,.0f} × {high:,.0f}, sharp at any size",
            ".pdf": "One page for each State Branch; text can be searched",
        }
        scale = png_scale(self._svg, choices.scale)
        sized = f"{wide * scale:,.0f} × {high * scale:,.0f} pixels"
        if scale < choices.scale:
            sized += f", at {scale:g} × because larger files cannot be opened by many programs"
        told = words.get(choices.form, sized)
        self.facts.setText(f"{told}. {FULLER}" if self.subject.shortened else told)

    def _export(self) -> None:
        choices = self.choices
        path = self.ask_file(self._folder / f"{self._stem()}{choices.form}")
        if path is None:
            return
        subject = self.subject
        words = f"Writing {one_line(path.name)}…"
        write = partial(_write, subject, path, choices)
        self.work(words, write, self._written, blocks=True)

    def _stem(self) -> str:
        """The name of the blueprint, with the SB if only that is drawn."""
        stem, subject = Path(self.subject.title).stem, self.subject
        if subject.what == "all" or len(subject.blueprint.branches) == 1:
            return stem
        return f"{stem}-{subject.branch}".replace("/", "-")

    def ask_file(self, suggested: Path) -> Path | None:
        """Ask for the file; None if the person cancels. The suffix of the form is added."""
        form = suggested.suffix
        kinds = ";;".join(f"{words} (*{suffix})" for words, suffix in FORMS.items())
        dialog = QFileDialog(self, "Export picture", str(suggested.parent), kinds)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.selectNameFilter(next(one for one in kinds.split(";;") if f"*{form}" in one))
        dialog.setDefaultSuffix(form.removeprefix("."))
        dialog.selectFile(suggested.name)
        fit_to_screen(dialog)
        chosen = dialog.selectedFiles() if dialog.exec() else []
        dialog.deleteLater()
        return Path(chosen[0]) if chosen else None

    def _written(self, path: Path) -> None:
        self.written.emit(path)
        self.accept()


def _write(subject: Subject, path: Path, choices: FileChoices) -> Path:
    """Draw and save. Errors of the package tell why a file was not written."""
    picture_form(path)
    raw = subject.file(path, choices.theme, choices.scale)
    files = tuple(document.file for document in subject.blueprint.documents)
    save_document(raw, path, made_of=files)
    return path
