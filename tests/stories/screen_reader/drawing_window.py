"""A window in which a person draws all the time, and which tells how much memory it takes.

``python -m tests.stories.screen_reader.drawing_window FILE``: the program that ``walker`` reads.
Beside FILE it writes a line for every 50 edits: their number, the memory in MB, and how many
parts of the tree are held. A reader makes it hold new parts after each edit, because each edit
gives a state or an operation another name.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from random import Random

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import rename
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.canvas.accessible_held import HELD
from smsl_studio.studio.shell.application import make_application, open_window
from smsl_studio.studio.shell.window import Window

EVERY = 150
"""Milliseconds between two edits."""
TOLD, BACK = 50, 40
"""After so many edits the memory is told, and all that was done is undone."""
MEMORY = ".memory"
"""The suffix of the file with the memory."""
PAGE = os.sysconf("SC_PAGE_SIZE")


class Drawing(QTimer):
    """Gives one element after the other a new name.

    It lives as long as the window: PySide does not hold the object of a method that is connected.
    """

    def __init__(self, window: Window, told: Path) -> None:
        super().__init__(window)
        self._session, self._told = window.session, told
        self._chance, self._edits = Random(1), 0
        self.timeout.connect(self.act)
        self.start(EVERY)

    def act(self) -> None:
        """One edit."""
        self._edits += 1
        if self._edits % BACK == 0:
            self._session.history.setIndex(0)
        else:
            self._session.edit("Rename", self._change())
        if self._edits % TOLD == 0:
            resident = int(Path("/proc/self/statm").read_text().split()[1])
            line = f"{self._edits} {resident * PAGE / 1e6:.1f} {len(HELD)}\n"
            with self._told.open("a") as file:
                file.write(line)

    def _change(self) -> Callable[[Blueprint], Blueprint]:
        branch = self._session.branch
        table = self._session.blueprint[branch].table
        state = self._chance.choice(list(table))
        operations = list(table[state])
        if operations and self._edits % 2:
            at = Address(branch, state, self._chance.choice(operations))
            return partial(rename, address=at, new_name=f"op{self._edits}")
        at, digits = Address(branch, state), "".join(c for c in state if c.isdigit())[-3:]
        return partial(rename, address=at, new_name=f"S{self._edits}x{digits}")


def begin(file: Path) -> None:
    """Once the window is there, begin."""
    window = next(one for one in QApplication.topLevelWidgets() if isinstance(one, Window))
    Drawing(window, file.with_suffix(MEMORY))


if __name__ == "__main__":
    make_application(sys.argv)
    QTimer.singleShot(0, partial(begin, Path(sys.argv[1])))
    raise SystemExit(open_window(sys.argv[1:]))
