"""The dialogs of a window about files, and about what happens to unsaved changes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QGridLayout, QMessageBox, QSpacerItem, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.smsl.forms import SUFFIXES
from smsl_studio.studio.base.file_dialogs import ask_to_open, ask_to_save
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.files.questions import Answer, Interrupted

ALL = "All files (*)"
KINDS = {
    ".json": "JSON (*.json)",
    ".smsl": "SMSL (*.smsl)",
    ".yaml": "YAML (*.yaml *.yml)",
}
OPEN = f"SMSL blueprints ({' '.join(f'*{suffix}' for suffix in SUFFIXES)});;{ALL}"
SCRIPTS = "Scripts (*.jsonl)"

FINISH, UNDO, STAY = "Finish the save", "Undo it", "Stay"
TITLE_BUTTONS = 220
"""Pixels of a title bar beside the title: icon, buttons, and the name of the program."""
ROLES = {
    FINISH: QMessageBox.ButtonRole.AcceptRole,
    "Save": QMessageBox.ButtonRole.AcceptRole,
    "Cancel": QMessageBox.ButtonRole.RejectRole,
    STAY: QMessageBox.ButtonRole.RejectRole,
}
"""The roles of the buttons that lose nothing. All others are destructive."""


class Dialogs:
    """Asks the person in dialogs of one window. It implements ``Asker``."""

    def __init__(self, window: QWidget) -> None:
        self._window = window

    def file_to_open(self, folder: Path) -> Path | None:
        """Ask for a blueprint file; None if the person cancels."""
        return self._file("Open blueprint", folder)

    def file_to_import(self, folder: Path) -> Path | None:
        """Ask for a file to import State Branches from. Return None if the person cancels."""
        return self._file("Import a blueprint", folder)

    def file_to_compare(self, folder: Path) -> Path | None:
        """Ask for the other file of a comparison; None if the person cancels."""
        return self._file("Compare with a blueprint", folder)

    def _file(self, title: str, folder: Path) -> Path | None:
        name = ask_to_open(self._window, title, str(folder), OPEN)
        return Path(name) if name else None

    def file_to_save(self, suggested: Path) -> Path | None:
        """Ask where to save; None if the person cancels.

        The suffix decides the form. A name without a suffix gets that of the chosen file type.
        """
        first = suggested.suffix if suggested.suffix in KINDS else ".json"
        kinds = [KINDS[first], *(words for words in KINDS.values() if words != KINDS[first]), ALL]
        name, chosen = ask_to_save(
            self._window, "Save blueprint as", str(suggested), ";;".join(kinds)
        )
        if not name:
            return None
        path = Path(name)
        if path.suffix:
            return path
        # The dialog checked the name as it was typed, so the name with the suffix is checked here.
        path = path.with_suffix(next((s for s, words in KINDS.items() if words == chosen), first))
        return path if not path.exists() or self._may_replace(path) else None

    def script_to_save(self, suggested: Path) -> Path | None:
        """Ask where to save a script; None if the person cancels."""
        kinds = ";;".join((SCRIPTS, ALL))
        name, _ = ask_to_save(self._window, "Save script", str(suggested), kinds)
        path = Path(name)
        if not name or path.suffix:
            return path if name else None
        path = path.with_suffix(".jsonl")
        return path if not path.exists() or self._may_replace(path) else None

    def _may_replace(self, path: Path) -> bool:
        return self._agrees(
            "Replace file",
            f"{path.name} is there already.",
            "Replacing it loses what it holds now.",
            f"Replace {path.name}",
        )

    def interrupted(self, names: str, when: str) -> Interrupted:
        """Ask what to do with an interrupted save: finish it, undo it, or decide later."""
        said = f"The program ended {when} while it was saving {names}."
        why = (
            "The new texts stand beside the files. Finishing the save puts them in their places. "
            "Undoing it leaves each file as it was before."
        )
        chosen = self._chosen(
            "Interrupted save", said, why, (FINISH, UNDO, "Cancel"), default=FINISH
        )
        return "finish" if chosen == FINISH else "undo" if chosen == UNDO else "cancel"

    def may_overwrite(self, names: str) -> bool:
        """Ask whether changes of another program may be overwritten."""
        return self._agrees(
            "Changed outside this window",
            f"{names} was changed outside this window since it was read.",
            "Saving replaces what is there now with your text.",
            "Save over it",
        )

    def may_lose(self, said: str) -> bool:
        """Ask whether a save may lose properties of the file; ``said`` says which."""
        return self._agrees(
            "What a save cannot keep",
            said,
            "A save replaces the file with a new one. The system does not allow this user to give "
            "the new file all of these. Save as writes to another place.",
            "Save",
        )

    def may_drop(self, said: str) -> bool:
        """Ask whether to leave what is typed in a form and cannot be taken over."""
        why = "It is written nowhere else. Go back to complete it, or leave without it."
        return self._agrees("Not added yet", said, why, "Leave without it")

    def may_save_broken(self, name: str, faults: str) -> bool:
        """Ask whether a text that cannot be read as a blueprint may be saved as it is."""
        return self._agrees(
            "The text cannot be read",
            f"The text of {name} cannot be read as a blueprint.",
            f"It has {faults}. The file can be saved as it is and repaired later.",
            "Save as it is",
        )

    def may_leave_comments(self, name: str, form: str) -> bool:
        """Ask whether the comments may be left out in a form that has none."""
        return self._agrees(
            "Comments",
            f"{name} has comments, and they are lost in {form}.",
            "The old file keeps them.",
            f"Save as {form}",
        )

    def unsaved(self, said: str) -> Answer:
        """Ask what to do with unsaved changes: "save", "discard" or "cancel"."""
        words = ("Save", "Discard changes", "Cancel")
        why = "Saving writes them to the file. Discarding loses them."
        chosen = self._chosen("Unsaved changes", said, why, words, default="Save")
        return "save" if chosen == "Save" else "cancel" if chosen == "Cancel" else "discard"

    def may_end_run(self, said: str) -> bool:
        """Ask whether the window may close and stop its run; ``said`` names the run."""
        words = ("Stop and close", STAY)
        why = "Closing the window ends it. What moves is stopped first."
        return self._chosen("A run is there", said, why, words, default=STAY) != STAY

    def may_go_on(self, ran: str, drawn: str) -> bool:
        """Ask whether the run of the file ``ran`` may go on, while ``drawn`` is shown."""
        return self._agrees(
            "A run of another file",
            f"The run that is there is of {ran} and began before {drawn} was opened.",
            f"It would go on now. To run {drawn}, end that run first.",
            f"Go on with {ran}",
        )

    def _come_forward(self) -> None:
        """Bring the window to the front, so that the person sees which one the question is
        about."""
        if self._window.isMinimized():
            self._window.showNormal()
        if not self._window.isActiveWindow():
            self._window.raise_()
            self._window.activateWindow()

    def _agrees(self, title: str, what: str, why: str, verb: str) -> bool:
        return self._chosen(title, what, why, (verb, "Cancel"), default="Cancel") == verb

    def _chosen(self, title: str, what: str, why: str, words: Sequence[str], default: str) -> str:
        """The text of the button that was pressed.

        Escape presses the last one, which loses nothing.
        """
        self._come_forward()
        box = QMessageBox(self._window)
        box.setWindowTitle(plain_text(title))
        box.setText(tip_text(what))
        box.setInformativeText(tip_text(why))
        buttons = {
            one: box.addButton(
                as_it_is(one), ROLES.get(one, QMessageBox.ButtonRole.DestructiveRole)
            )
            for one in words
        }
        box.setDefaultButton(buttons[default])
        _widen(box, title)
        box.setEscapeButton(buttons[words[-1]])
        box.exec()
        clicked = box.clickedButton()
        box.deleteLater()
        return next((one for one, made in buttons.items() if made is clicked), words[-1])


def _widen(box: QMessageBox, title: str) -> None:
    """Make the dialog so wide that its title is whole beside the buttons of the window."""
    grid = box.layout()
    if isinstance(grid, QGridLayout):
        wide = box.fontMetrics().horizontalAdvance(plain_text(title)) + TITLE_BUTTONS
        grid.addItem(QSpacerItem(wide, 0), grid.rowCount(), 0, 1, grid.columnCount())
