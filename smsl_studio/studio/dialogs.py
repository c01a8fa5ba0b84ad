"""The few questions that stop the window: which file, and what becomes of unsaved changes."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from smsl_studio.studio.files import Answer

KINDS = "SMSL blueprints (*.json);;All files (*)"


class Dialogs:
    """Asks in dialogs of the window it belongs to."""

    def __init__(self, window: QWidget) -> None:
        self._window = window

    def file_to_open(self, folder: Path) -> Path | None:
        name, _ = QFileDialog.getOpenFileName(self._window, "Open blueprint", str(folder), KINDS)
        return Path(name) if name else None

    def file_to_save(self, suggested: Path) -> Path | None:
        name, _ = QFileDialog.getSaveFileName(
            self._window, "Save blueprint as", str(suggested), KINDS
        )
        if not name:
            return None
        path = Path(name)
        if path.suffix:
            return path
        # The dialog asks about the name that was typed, not about the one it becomes.
        path = path.with_suffix(".json")
        return path if not path.exists() or self._may_replace(path) else None

    def _may_replace(self, path: Path) -> bool:
        box = QMessageBox(self._window)
        box.setWindowTitle("Replace file")
        box.setText(f"{path.name} is there already.")
        box.setInformativeText("Replacing it loses what it holds now.")
        replace = box.addButton(f"Replace {path.name}", QMessageBox.ButtonRole.DestructiveRole)
        stay = box.addButton("Cancel", QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(stay)
        box.setEscapeButton(stay)
        box.exec()
        return box.clickedButton() is replace

    def unsaved(self, name: str) -> Answer:
        box = QMessageBox(self._window)
        box.setWindowTitle("Unsaved changes")
        box.setText(f"{name} has unsaved changes.")
        box.setInformativeText("Saving writes them to the file. Discarding loses them.")
        save = box.addButton("Save", QMessageBox.ButtonRole.AcceptRole)
        discard = box.addButton("Discard changes", QMessageBox.ButtonRole.DestructiveRole)
        stay = box.addButton("Cancel", QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(save)
        box.setEscapeButton(stay)
        box.exec()
        if box.clickedButton() is save:
            return "save"
        return "discard" if box.clickedButton() is discard else "cancel"
