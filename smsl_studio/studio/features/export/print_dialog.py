"""The dialog for paper: one sheet or a poster, with a preview of every sheet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from PySide6.QtCore import QMarginsF, QRectF, QSizeF, Signal
from PySide6.QtGui import QImage, QPageLayout, QPageSize
from PySide6.QtPrintSupport import QPrintDialog, QPrinter
from PySide6.QtWidgets import QLineEdit, QWidget

from smsl_studio.errors import StudioError, UsageError
from smsl_studio.picture.paper import size_of
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.export.picture_dialog import PictureDialog
from smsl_studio.studio.features.export.poster import Printed, on_one_sheet, poster
from smsl_studio.studio.features.export.preview import PaperSheet, as_image
from smsl_studio.studio.features.export.print_job import PrintJob
from smsl_studio.studio.features.export.subject import PAPER, Subject

PAPERS = {
    "A4": QPageSize.PageSizeId.A4,
    "A3": QPageSize.PageSizeId.A3,
    "Letter": QPageSize.PageSizeId.Letter,
    "Tabloid": QPageSize.PageSizeId.Tabloid,
}
SIZES = {"One sheet": 0} | {
    f"Poster, {counted(across, 'sheet')} wide": across for across in (1, 2, 3, 4, 6, 8)
}
MARGIN = 10.0
"""The margin of the paper in mm, which most printers leave white."""
Rows = list[list[Printed]]


class PrintDialog(PictureDialog):
    """Prints each picture on one sheet, or on as many as the poster needs."""

    printed = Signal(str)
    """What was printed."""

    def __init__(self, subjects: Mapping[str, Subject], tokens: Tokens, parent: QWidget) -> None:
        super().__init__(subjects, "Print", "Print…", tokens, parent)
        self.size_ = self.choice("Size", SIZES)
        self.paper = self.choice("Paper", PAPERS)
        self.turn = self.choice(
            "Orientation",
            {
                "As it fits": None,
                "Portrait": QPageLayout.Orientation.Portrait,
                "Landscape": QPageLayout.Orientation.Landscape,
            },
        )
        self.lay_out()
        self._job: PrintJob | None = None
        self._pages: Sequence[tuple[str, QImage]] = ()
        for combo in (self.what, self.bundling):
            combo.currentIndexChanged.connect(self._draw)
        for combo in (self.size_, self.paper, self.turn):
            combo.currentIndexChanged.connect(self._show)
        self.go.clicked.connect(self._print)
        self._draw()

    def _draw(self) -> None:
        subject = self.subject
        self._pages = ()
        self._show()

        def draw() -> list[tuple[str, QImage]]:
            return [(svg, as_image(svg)) for svg in subject.pages(PAPER)]

        self.work("Drawing the preview…", draw, self._drawn)

    def _drawn(self, pages: Sequence[tuple[str, QImage]]) -> None:
        self._pages = pages
        self._show()

    def layout_of(self, svg: str) -> QPageLayout:
        """The paper for a picture, upright or not as it fits better if that is not chosen."""
        turn = self.turn.currentData()
        if turn is None:
            wide, high = size_of(svg)
            turn = QPageLayout.Orientation.Landscape if wide > high else turn
        return QPageLayout(
            QPageSize(self.paper.currentData()),
            turn or QPageLayout.Orientation.Portrait,
            QMarginsF(MARGIN, MARGIN, MARGIN, MARGIN),
            QPageLayout.Unit.Millimeter,
        )

    def rows_of(self, svg: str, layout: QPageLayout) -> Rows:
        """The sheets of a picture. UsageError if they would be too many."""
        room = layout.paintRect(QPageLayout.Unit.Point)
        size, across = (room.width(), room.height()), int(self.size_.currentData())
        return poster(size_of(svg), size, across) if across else on_one_sheet(size_of(svg), size)

    def _show(self) -> None:
        """Show the sheets, and say how many there are."""
        try:
            laid = [
                (svg, image, layout, self.rows_of(svg, layout))
                for svg, image in self._pages
                for layout in (self.layout_of(svg),)
            ]
        except UsageError as error:
            self.preview.show_rows(())
            self.facts.setText("")
            self.show_refusal(error)
            self.go.setEnabled(False)
            return
        self.show_refusal(None)
        self.go.setEnabled(bool(laid))
        self.preview.show_rows(
            [
                [_sheet(one, svg, image, layout) for one in row]
                for svg, image, layout, rows in laid
                for row in rows
            ]
        )
        count = sum(len(row) for _, _, _, rows in laid for row in rows)
        words = counted(count, "sheet") if laid else ""
        if any(len(rows) * len(rows[0]) > 1 for _, _, _, rows in laid):
            words += ". Neighbours overlap by 10 mm, and each says where it belongs."
        self.facts.setText(words)

    def _print(self) -> None:
        printer = QPrinter(QPrinter.PrinterMode.HighResolution)
        printer.setDocName(self.subject.title)
        printer.setPageLayout(self.layout_of(self._pages[0][0]))
        if not self.ask_printer(printer):
            return
        job = PrintJob(printer, self)
        for svg, _ in self._pages:
            layout = self.layout_of(svg)
            job.add(svg, layout, self.rows_of(svg, layout))
        self._job = job
        job.advanced.connect(self._advanced)
        job.ended.connect(self._ended)
        self._advanced(0, job.count)
        job.begin()

    def ask_printer(self, printer: QPrinter) -> bool:
        """Ask for the printer, or for a file; False if the person cancels."""
        dialog = QPrintDialog(printer, self)
        dialog.setOption(QPrintDialog.PrintDialogOption.PrintPageRange, False)
        self._propose_file(dialog)
        agreed = bool(dialog.exec())
        dialog.deleteLater()
        return agreed

    def _propose_file(self, dialog: QPrintDialog) -> None:
        """Propose a file beside that of the drawing, where Qt's own dialog has a field for it.

        Otherwise Qt would propose the home of the user. The name of a file set in the printer would
        choose printing into a file also where there are printers.
        """
        field = dialog.findChild(QLineEdit, "filename")
        path = Path(self.subject.blueprint.file)
        if field is not None and path.exists():
            field.setText(str(path.resolve().with_suffix(".pdf")))

    def _advanced(self, done: int, of: int) -> None:
        self.show_work(f"Printing sheet {min(done + 1, of):,} of {of:,}…", True, done, of)

    def _ended(self, error: StudioError | None) -> None:
        job, self._job = self._job, None
        self.show_work("")
        if error is not None or job is None:
            self.show_refusal(error)
            return
        self.printed.emit(f"Printed {counted(job.count, 'sheet')}{job.where}.")
        self.accept()

    def call_off(self) -> None:
        """Call the printing off between two sheets."""
        if self._job is not None:
            self._job.call_off()
            self._job = None
        super().call_off()


def _sheet(one: Printed, svg: str, image: QImage, layout: QPageLayout) -> PaperSheet:
    """A sheet of the preview: what is printed, with the margins around it."""
    paper = layout.fullRect(QPageLayout.Unit.Point)
    room = layout.paintRect(QPageLayout.Unit.Point)
    wide, high = size_of(svg)
    fine, tall = image.width() / wide, image.height() / high
    x, y, w, h = one.source
    left, top, across, down = one.target
    return PaperSheet(
        QSizeF(paper.size()),
        image,
        QRectF(x * fine, y * tall, w * fine, h * tall),
        QRectF(room.x() + left, room.y() + top, across, down),
    )
