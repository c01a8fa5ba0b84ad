"""Saves what the picture of the world shows: as it is now, or as a clip of the run."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QObject, Qt, QTimer
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QProgressDialog, QWidget

from smsl_studio.errors import StudioError
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.file_dialogs import ask_to_save
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.running.scene.clip_file import FORMATS, ClipFrame, clip_bytes
from smsl_studio.studio.running.scene.kept_poses import KeptPoses
from smsl_studio.studio.running.scene.world_view import WorldView

PICTURE = "Picture (*.png)"
CLIPS = "Clip (*.gif);;Clip (*.webp)"
WIDEST = 800
"""The largest width of a clip (pixels)."""
MOST = 240
"""The largest number of pictures in a clip. A longer run is shown faster."""
FASTEST_MS = 40
PATIENCE_MS = 1000
"""Work that takes longer than this shows how far it is, and can be called off."""


def save_picture(view: WorldView, suggested: Path, toast: Toast, window: QWidget) -> None:
    """Ask for a file, and save the picture of the world as it is now."""
    image = view.picture()
    path = _asked(window, "Save picture", suggested.with_suffix(".png"), PICTURE)
    if path is not None and not image.isNull() and _written(_png(image), path, toast):
        toast.say(f"{path.name} holds the picture of the world")


class ClipSaver(QObject):
    """Draws the pictures of a clip one by one while the window goes on, and writes the file.

    A second clip is not begun before the first one is done or called off.
    """

    def __init__(self, view: WorldView, toast: Toast, window: QWidget) -> None:
        super().__init__(window)
        self._view, self._toast, self._window = view, toast, window
        self._work = Beside(self)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._draw_one)
        self._poses: list[tuple[float, ...]] = []
        self._frames: list[ClipFrame] = []
        self._path = Path()
        self._each = FASTEST_MS
        self._shown: QProgressDialog | None = None

    @property
    def busy(self) -> bool:
        """Whether a clip is being made."""
        return self._shown is not None

    def save(self, kept: KeptPoses, suggested: Path) -> None:
        """Ask for a file, and begin to make a clip of what was watched."""
        if self.busy or not len(kept):
            return
        path = _asked(self._window, "Save clip", suggested.with_suffix(".gif"), CLIPS)
        if path is None or not self._view.has_picture:
            return
        if path.suffix.lower() not in FORMATS:
            self._toast.refuse(
                StudioError(f"{path.name} is no clip", advice="Name it .gif or .webp")
            )
            return
        self._path, self._poses, self._frames = path, kept.spread(MOST), []
        self._each = max(FASTEST_MS, round(1000 * kept.seconds / max(len(kept) - 1, 1)))
        self._shown = shown = QProgressDialog(self._window)
        shown.setLabelText(f"Drawing {counted(len(self._poses), 'picture')}")
        shown.setWindowTitle("Save clip")
        shown.setRange(0, len(self._poses) + 1)
        shown.setMinimumDuration(PATIENCE_MS)
        shown.setWindowModality(Qt.WindowModality.NonModal)
        shown.setAutoClose(False)
        shown.setAutoReset(False)
        shown.canceled.connect(self.cancel)
        shown.setValue(0)
        self._timer.start(0)

    def cancel(self) -> None:
        """Make no clip. No file was written."""
        self._timer.stop()
        self._work.drop()
        self._end()
        self._toast.say("No clip was saved")

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._timer.stop()
        self._end()
        self._work.stop()

    def _draw_one(self) -> None:
        image = self._view.picture(self._poses[len(self._frames)])
        if image.isNull():
            self.cancel()
            return
        self._frames.append(_frame(image, self._frames[0].size if self._frames else None))
        assert self._shown is not None
        self._shown.setValue(len(self._frames))
        if len(self._frames) == len(self._poses):
            self._timer.stop()
            self._shown.setLabelText(f"Writing {self._path.name}")
            frames, suffix, each = self._frames, self._path.suffix.lower(), self._each
            self._work.do(lambda: clip_bytes(frames, suffix, each), self._write)

    def _write(self, made: bytes) -> None:
        many = counted(len(self._frames), "picture")
        self._end()
        if _written(made, self._path, self._toast):
            self._toast.say(f"{self._path.name} holds {many}, {len(made) / 1e6:.1f} MB")

    def _end(self) -> None:
        shown, self._shown, self._frames, self._poses = self._shown, None, [], []
        if shown is not None:
            shown.canceled.disconnect(self.cancel)
            shown.close()
            shown.deleteLater()


def _asked(window: QWidget, title: str, suggested: Path, kinds: str) -> Path | None:
    name, kind = ask_to_save(window, title, str(suggested), kinds)
    if not name:
        return None
    path = Path(name)
    if path.suffix:
        return path
    return path.with_suffix(kind.partition("*")[2].partition(")")[0] or suggested.suffix)


def _written(content: bytes, path: Path, toast: Toast) -> bool:
    try:
        save_document(content, path)
    except StudioError as error:
        toast.refuse(error)
        return False
    return True


def _png(image: QImage) -> bytes:
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, "PNG")  # type: ignore[call-overload]
    return bytes(buffer.data().data())


def _frame(image: QImage, size: tuple[int, int] | None) -> ClipFrame:
    """Return an image as a frame of a clip, in the size of the first one or at most ``WIDEST``."""
    image.setDevicePixelRatio(1.0)
    wanted = size or (min(image.width(), WIDEST), 0)
    smooth = Qt.TransformationMode.SmoothTransformation
    if size is not None and image.size().toTuple() != size:
        image = image.scaled(*size, Qt.AspectRatioMode.IgnoreAspectRatio, smooth)
    elif size is None and image.width() != wanted[0]:
        image = image.scaledToWidth(wanted[0], smooth)
    rows = image.convertToFormat(QImage.Format.Format_RGB888)
    width, height, line = rows.width(), rows.height(), rows.bytesPerLine()
    bits = bytes(rows.constBits())
    pixels = b"".join(bits[line * y : line * y + 3 * width] for y in range(height))
    return ClipFrame(pixels, width, height)
