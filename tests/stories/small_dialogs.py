"""Opens every dialog on the screen of this process, and prints where each is, with its buttons.

``python -m tests.stories.small_dialogs FILE`` prints one line of JSON. The screen and its scale
come from the environment, as they do for a person.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from typing import Any

from PySide6.QtCore import QRect, Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QDialog,
    QFileDialog,
    QLabel,
    QPushButton,
    QWidget,
)

from smsl_studio.blueprint import editing
from smsl_studio.front.revisions import Revision
from smsl_studio.home import user_folder
from smsl_studio.inspection.repair import Repair
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import dress
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.draw.compare.revision_dialog import RevisionDialog
from smsl_studio.studio.features.draw.panels.fix_list import FixList
from smsl_studio.studio.shell.application import make_application, make_window, offer_recovery
from smsl_studio.studio.shell.plugin_question import PluginQuestion
from smsl_studio.studio.shell.plugins import Plugins
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows
from tests.plugin_folder import found_plugin, write_plugin
from tests.stories.small_screen import Box, box, until

MANIFEST = f'name = "lamp"\nversion = "1"\ndescription = "{"A lamp that is switched. " * 20}"\n'


def leave_work_behind(windows: Windows, file: str, name: str) -> None:
    """A window with unsaved work ends at once, as when its program is killed."""
    window = make_window(windows, file)
    branch = next(iter(window.session.blueprint.branches))
    window.session.edit("Add", lambda bp: editing.add_state(bp, branch, name))
    journal = window.safety.journal
    until(lambda: journal.safe == journal.changes)
    journal.leave_behind()
    window.session.history.setClean()
    window.close()


def by_action(windows: Windows, window: Window) -> Iterator[tuple[str, QDialog]]:
    """The dialogs that a command of the window opens."""
    # The help comes first: over a dialog that blocks it would belong to that dialog.
    for action in ("help_pages", "shortcuts", "about", "monitor", "levels", "persons",
                   "supervisors", "compare_saved", "export_picture", "print",
                   "settings"):  # fmt: skip
        known = set(window.findChildren(QDialog))
        # The command opens the monitor in a window of its own beside Supervise.
        window.set_mode("supervise" if action == "monitor" else "draw")
        window.actions_table[action].trigger()
        yield action, next(one for one in window.findChildren(QDialog) if one not in known)


def by_themselves(windows: Windows, window: Window) -> Iterator[tuple[str, QDialog]]:
    """The dialogs that something else brings up."""
    commit = Revision("0" * 40, "2026-01-01", "Ada", "Draw it anew", "plan.json")
    yield "revisions", RevisionDialog("plan.json", [commit] * 90, LIGHT, window)
    repair = Repair((), window.session.blueprint)
    yield "fixes", FixList(window.session, repair, 3, LIGHT, window)
    folder = write_plugin(user_folder() / "plugins", "lamp", "def register(library): ...")
    (folder / "plugin.toml").write_text(MANIFEST)
    yield "plugin", PluginQuestion(found_plugin("lamp"), window)
    offer = offer_recovery(windows, window)
    assert offer is not None
    yield "recovery", offer


def buttons_of(dialog: QDialog) -> dict[str, Box]:
    """What is seen of the buttons that stand below or beside what scrolls."""
    found: dict[str, Box] = {}
    for button in dialog.findChildren(QPushButton):
        if button.isVisible() and button.text() and not _scrolls(button, dialog):
            seen = button.visibleRegion().boundingRect()
            assert seen.size() == button.size(), f"{button.text()} is cut: {seen}"
            found[button.text()] = box(QRect(button.mapToGlobal(seen.topLeft()), seen.size()))
    return found


def cut_texts(dialog: QDialog) -> list[str]:
    """The texts that have less height than their lines need, or lie below another part."""
    direct = Qt.FindChildOption.FindDirectChildrenOnly
    parts = [one for one in dialog.findChildren(QWidget, options=direct) if one.isVisible()]
    texts = [one for one in parts if isinstance(one, QLabel) and one.wordWrap()]
    return [
        words.text()
        for words in texts
        if words.height() < words.heightForWidth(words.width())
        or any(words.geometry().intersects(one.geometry()) for one in parts if one is not words)
    ]


def _scrolls(part: QWidget, dialog: QDialog) -> bool:
    above = part.parentWidget()
    while above is not None and above is not dialog:
        if isinstance(above, QAbstractScrollArea):
            return True
        above = above.parentWidget()
    return False


def file_dialog(window: Window) -> dict[str, Any]:
    """Where the dialog is that asks for a file, with its buttons. It blocks, so it is looked at
    from within."""
    told: dict[str, Any] = {}

    def look() -> None:
        dialog = window.findChild(QFileDialog)
        assert dialog is not None
        told.update(frame=box(dialog.frameGeometry()), buttons=buttons_of(dialog), cut=[])
        dialog.reject()

    QTimer.singleShot(300, look)
    window.actions_table["open"].trigger()
    return told


def main(file: str) -> dict[str, Any]:
    application = make_application(sys.argv)
    dress(application, LIGHT)
    windows = Windows(application, Settings(), Plugins(Loaded))
    for name in ("State_x", "State_y", "State_z", "State_u"):
        leave_work_behind(windows, file, name)
    window = make_window(windows, file)
    until(lambda: windows.plugins.known)
    told: dict[str, Any] = {"screen": box(window.screen().availableGeometry())}
    told["open"] = file_dialog(window)
    for name, dialog in (*by_action(windows, window), *by_themselves(windows, window)):
        dialog.show()
        QTest.qWait(50)
        told[name] = {"frame": box(dialog.frameGeometry()), "buttons": buttons_of(dialog),
                      "cut": cut_texts(dialog)}  # fmt: skip
        dialog.close()
    return told


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1])))
    sys.stdout.flush()
    os._exit(0)
