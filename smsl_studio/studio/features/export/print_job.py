"""PrintJob: prints sheet by sheet, so that the window goes on and the job can be called off."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from PySide6.QtCore import QByteArray, QObject, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QPageLayout, QPainter, QPen
from PySide6.QtPrintSupport import QPrinter
from PySide6.QtSvg import QSvgRenderer

from smsl_studio.errors import SaveError, StudioError
from smsl_studio.legible import plain_text
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.base.theme import text_font
from smsl_studio.studio.features.export.poster import FOOT, Printed

POINTS = 72.0
WORDS, TRIM = QColor("#5F6979"), QColor("#C2C8D1")


class PrintJob(QObject):
    """One job of a printer. A file is written whole or not at all, as any other file."""

    advanced = Signal(int, int)
    """(sheets that are done, all sheets)."""
    ended = Signal(object)
    """None if everything was printed, else a StudioError."""

    def __init__(self, printer: QPrinter, parent: QObject) -> None:
        super().__init__(parent)
        self._printer = printer
        self._sheets: list[tuple[QSvgRenderer, QPageLayout, Printed]] = []
        self._painter = QPainter()
        self._next = 0
        self._file = ""
        self._folder: TemporaryDirectory[str] | None = None

    @property
    def count(self) -> int:
        """The number of sheets."""
        return len(self._sheets)

    @property
    def where(self) -> str:
        """The file to which the job is printed, in words; empty for a printer."""
        return plain_text(f" to {Path(self._file).name}") if self._file else ""

    def add(self, svg: str, layout: QPageLayout, rows: Sequence[Sequence[Printed]]) -> None:
        """Add the sheets of a picture. All of one job are printed on the same paper."""
        renderer = QSvgRenderer(QByteArray(svg.encode("utf-8")), self)
        self._sheets.extend((renderer, layout, sheet) for row in rows for sheet in row)

    def begin(self) -> None:
        """Begin to print."""
        self._file = self._printer.outputFileName()
        if self._file:
            self._folder = TemporaryDirectory(prefix="smsl-print-")
            self._printer.setOutputFileName(str(Path(self._folder.name) / "job.pdf"))
        self._printer.setPageLayout(self._sheets[0][1])
        if not self._painter.begin(self._printer):
            self._end(SaveError("the printer does not begin", advice="Choose another printer."))
            return
        self._later()

    def call_off(self) -> None:
        """Stop between two sheets. Nothing is written to a file."""
        self._next = self.count + 1
        self._printer.abort()
        self._painter.end()
        self._forget()

    def _later(self) -> None:
        QTimer.singleShot(0, self, self._print_next)

    def _print_next(self) -> None:
        if self._next > self.count:  # called off
            return
        if self._next == self.count:
            self._painter.end()
            self._end(self._kept())
            return
        renderer, layout, sheet = self._sheets[self._next]
        self._printer.setPageLayout(layout)
        if self._next and not self._printer.newPage():
            self._painter.end()
            self._end(SaveError("the printer takes no more sheets", advice="Print the rest again."))
            return
        self._paint(renderer, layout, sheet)
        self._next += 1
        self.advanced.emit(self._next, self.count)
        self._later()

    def _paint(self, renderer: QSvgRenderer, layout: QPageLayout, sheet: Printed) -> None:
        painter, dots = self._painter, self._printer.resolution() / POINTS
        painter.save()
        painter.scale(dots, dots)
        target = QRectF(*sheet.target)
        painter.save()
        painter.setClipRect(target)
        renderer.setViewBox(QRectF(*sheet.source))
        renderer.render(painter, target)
        painter.restore()
        if sheet.words:
            painter.setPen(QPen(TRIM, 0.5, Qt.PenStyle.DashLine))
            painter.drawRect(target)
            painter.setPen(WORDS)
            painter.setFont(text_font(8))
            room = layout.paintRect(QPageLayout.Unit.Point)
            foot = QRectF(0.0, room.height() - FOOT + 3.0, room.width(), FOOT - 3.0)
            painter.drawText(foot, Qt.AlignmentFlag.AlignLeft, sheet.words)
        painter.restore()

    def _kept(self) -> StudioError | None:
        """Put the file that was printed into its place; the error if that is not possible."""
        if self._folder is None:
            return None
        try:
            made = Path(self._folder.name) / "job.pdf"
            raw = made.read_bytes() if made.exists() else b""
            if not raw.rstrip().endswith(b"%%EOF"):
                raise SaveError(
                    f"{self._file} was not saved: the sheets are not complete",
                    advice="Free some room on the disk for temporary files.",
                )
            save_document(raw, self._file)
        except StudioError as error:
            return error
        return None

    def _end(self, error: StudioError | None) -> None:
        self._forget()
        self.ended.emit(error)

    def _forget(self) -> None:
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None
