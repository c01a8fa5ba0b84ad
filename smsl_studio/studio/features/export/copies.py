"""Copy the selection, or else the SB that is shown, as a picture or as the text of a diagram."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import PurePath

from PySide6.QtCore import QMimeData, QObject
from PySide6.QtGui import QGuiApplication, QImage

from smsl_studio.errors import StudioError
from smsl_studio.front.outputs import picture_bytes
from smsl_studio.legible import one_line
from smsl_studio.picture.dot import as_dot
from smsl_studio.picture.mermaid import MOST_EDGES, as_mermaid
from smsl_studio.picture.part import PicturePart
from smsl_studio.stop import heed
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.export.subject import SELECTION, Subject

MORE = ("_states", "_operations", "_facts")
"""What a text of a diagram leaves out."""
SVG, PNG = "image/svg+xml", "image/png"
Data = Callable[[], QMimeData]


class CopyVerbs(QObject):
    """Copies in the background. The toast says what is done, with a button that calls it off."""

    def __init__(self, subject: Callable[[], Subject], toast: Toast, parent: QObject) -> None:
        """``subject`` returns what would be copied now."""
        super().__init__(parent)
        self._subject, self._toast = subject, toast
        self.beside = Beside(self)

    def picture(self, theme: str) -> None:
        """Copy a picture as PNG and as SVG."""
        subject = self._subject()

        def draw() -> Data:
            svg = subject.svg(theme)
            heed()
            png = picture_bytes([svg], subject.title, PurePath("copy.png"))
            return lambda: _picture_data(svg, png)

        self._copy(draw, f"Copied {_what(subject)} as a picture.")

    def dot(self) -> None:
        """Copy a diagram for Graphviz."""
        self._text(as_dot, "DOT")

    def mermaid(self) -> None:
        """Copy a diagram for Mermaid."""
        self._text(as_mermaid, "Mermaid", MOST_EDGES)

    def stop(self) -> None:
        """End the work, because the window closes."""
        self.beside.stop()

    def _text(
        self, write: Callable[[Sequence[PicturePart]], str], name: str, most: int | None = None
    ) -> None:
        subject = self._subject()
        said = f"Copied {_what(subject)} as {name}."
        if any(part.picture.branch.fields.get(key) for part in subject.parts() for key in MORE):
            said += " It has names and arrows; titles, facts and other details are left out."
        edges = sum(len(part.edges) for part in subject.parts())
        if most is not None and edges > most:
            said += f" {name} draws {most} operations unless its settings allow more."

        def made() -> Data:
            text = write(subject.parts())
            return lambda: _text_data(text)

        self._copy(made, said)

    def _copy(self, make: Callable[[], Data], said: str) -> None:
        def tried() -> Data | StudioError:
            try:
                return make()
            except StudioError as error:
                return error

        def put(came: Data | StudioError) -> None:
            if isinstance(came, StudioError):
                self._toast.refuse(came)
                return
            QGuiApplication.clipboard().setMimeData(came())
            self._toast.say(said)

        self.beside.drop()
        self._toast.offer("Copying…", "Cancel", self.beside.drop)
        self.beside.do(tried, put)


def _picture_data(svg: str, png: bytes) -> QMimeData:
    data = QMimeData()
    data.setImageData(QImage.fromData(png))
    data.setData(PNG, png)
    data.setData(SVG, svg.encode("utf-8"))
    return data


def _text_data(text: str) -> QMimeData:
    data = QMimeData()
    data.setText(text)
    return data


def _what(subject: Subject) -> str:
    """What is copied, in words."""
    if subject.what != SELECTION:
        return one_line(subject.branch)
    part = subject.parts()[0]
    if len(part.states) == 1:
        return one_line(part.picture.names[part.states[0]])
    return counted(len(part.states), "state")
