"""A window that a test kills: it draws or types without a pause, and tells how far it is.

    child.py FILE draw|type

Each line on its standard output is ``edit NUMBER CHANGES`` or ``safe CHANGES``.
"""

from __future__ import annotations

import os
import sys

from PySide6.QtCore import QTimer
from PySide6.QtTest import QTest

from smsl_studio.blueprint import editing
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.shell.application import make_application, make_window
from smsl_studio.studio.shell.windows import Windows

EVERY = 5
"""Milliseconds between two edits: shorter than any pause that a reader could wait for."""


def main() -> None:
    application = make_application(sys.argv)
    window = make_window(Windows(application, Settings()), sys.argv[1])
    journal, done = window.safety.journal, 0
    if sys.argv[2] == "type":
        window.show_tab("Source")
        window.source.editor.setFocus()

    def say(*words: object) -> None:
        os.write(1, f"{' '.join(map(str, words))}\n".encode())

    def edit() -> None:
        nonlocal done
        done += 1
        if sys.argv[2] == "type":
            QTest.keyClicks(window.source.editor, "x")
        else:
            name = f"State_{done:05}"
            window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", name))
        say("edit", done, journal.changes)

    journal.acknowledged.connect(lambda changes: say("safe", changes))
    timer = QTimer()
    timer.timeout.connect(edit)
    timer.start(EVERY)
    application.exec()


if __name__ == "__main__":
    main()
