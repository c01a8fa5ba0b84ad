"""Compares the unsaved work that a journal kept with the file on the disk."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.comparison import compare as compared
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.journal.entry import JournalEntry
from smsl_studio.studio.document.journal.restoration import sides
from smsl_studio.studio.features.draw.compare.dialog import CompareDialog


def difference_dialog(entry: JournalEntry, tokens: Tokens, parent: QWidget) -> bool:
    """Compare the kept work with the file on the disk.

    Returns False if there is nothing to compare.
    """
    both = sides(entry)
    if not both.comparable or both.before is None:
        return False
    dialog = CompareDialog(tokens, parent)
    dialog.jump.hide()
    difference = compared(both.before.blueprint, both.after.blueprint)
    words = f"{entry.name}, as it is on the disk", f"{entry.name}, as it would be recovered"
    dialog.show_difference(difference, *words)
    dialog.open()
    return True
