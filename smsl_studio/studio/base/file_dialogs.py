"""The dialogs that ask for a file or a folder. None of them is larger than its screen."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from smsl_studio.studio.base.screens import open_at


def ask_to_open(parent: QWidget, title: str, folder: str, kinds: str) -> str:
    """The file that a person chose to open; empty if the person cancels.

    ``kinds`` are the file types, separated by ``;;``.
    """
    dialog = QFileDialog(parent, title, folder, kinds)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    return _answer(dialog)[0]


def ask_to_save(parent: QWidget, title: str, suggested: str, kinds: str = "") -> tuple[str, str]:
    """The file to save to, and the chosen file type; two empty texts if the person cancels."""
    path = Path(suggested)
    dialog = QFileDialog(parent, title, str(path.parent), kinds)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setFileMode(QFileDialog.FileMode.AnyFile)
    dialog.selectFile(path.name)
    return _answer(dialog)


def ask_folder(parent: QWidget, title: str) -> str:
    """The folder that a person chose; empty if the person cancels."""
    dialog = QFileDialog(parent, title)
    dialog.setFileMode(QFileDialog.FileMode.Directory)
    dialog.setOption(QFileDialog.Option.ShowDirsOnly)
    return _answer(dialog)[0]


def fit_to_screen(dialog: QFileDialog) -> None:
    """Open a file dialog with its usual size, limited to the screen."""
    usual = dialog.sizeHint()
    open_at(dialog, usual.width(), usual.height())


def _answer(dialog: QFileDialog) -> tuple[str, str]:
    fit_to_screen(dialog)
    chosen = dialog.selectedFiles() if dialog.exec() else []
    kind = dialog.selectedNameFilter()
    dialog.deleteLater()
    return (chosen[0], kind) if chosen else ("", "")
