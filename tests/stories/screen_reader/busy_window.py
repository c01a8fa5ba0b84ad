"""A window in which a person draws and runs all the time, in changing modes.

``python -m tests.stories.screen_reader.busy_window FILE``: the program that ``walker`` reads.
Beside FILE it writes how many things the person has done.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable
from functools import partial
from itertools import cycle
from pathlib import Path
from random import Random

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.features.draw.canvas.name_field import NameField
from smsl_studio.studio.shell.application import make_application, open_window
from smsl_studio.studio.shell.window import Window

EVERY = 150
"""Milliseconds between two acts."""
ACTS = ".acts"
"""The suffix of the file with the number of what was done."""


class Busy(QTimer):
    """Does one thing after the other, round and round; which element it is, is drawn anew.

    It lives as long as the window: PySide does not hold the object of a method that is connected.
    """

    def __init__(self, window: Window, told: Path) -> None:
        super().__init__(window)
        self._window, self._told, self._chance = window, told, Random(1)
        self._done = 0
        press = self._press
        self._acts = cycle([
            press("add_state"), self._enter, self._connect, self._enter, self._move, self._select,
            press("rename"), self._leave, press("show_source"), press("undo"), press("redo"),
            press("show_history"), self._select, press("delete"), press("undo"),
            press("show_properties"), self._select_operation, press("palette"), self._close_palette,
            press("add_branch"), press("undo"), press("mode_run"), press("run_step"), self._wait,
            press("run_play"), self._wait, press("mode_supervise"), self._wait, press("mode_draw"),
            self._select, self._move, press("mode_run"), press("run_stop"), self._wait,
            window.features.run.pane.run.end, self._wait, press("mode_draw"), self._forget,
        ])  # fmt: skip
        self.timeout.connect(self._go_on)
        self.start(EVERY)

    def act(self) -> None:
        """The next thing."""
        next(self._acts)()
        self._done += 1
        self._told.write_text(str(self._done))

    def _go_on(self) -> None:
        """The next thing. If it cannot be done, the program ends with an error."""
        try:
            self.act()
        except Exception:
            traceback.print_exc()
            os._exit(1)

    def _press(self, name: str) -> Callable[[], None]:
        return partial(self._trigger, name)

    def _trigger(self, name: str) -> None:
        self._window.actions_table[name].trigger()

    def _wait(self) -> None:
        """A person looks at what happens."""

    def _enter(self) -> None:
        field = self._window.editor.field
        if isinstance(field, NameField | ConnectCard):
            field.commit()

    def _leave(self) -> None:
        field = self._window.editor.field
        if field is not None:
            field.close_field()

    def _states(self) -> list[Address]:
        session = self._window.session
        return [Address(session.branch, name) for name in session.blueprint[session.branch].table]

    def _select(self) -> None:
        self._window.session.select([self._chance.choice(self._states())])

    def _select_operation(self) -> None:
        session = self._window.session
        at = self._chance.choice(self._states())
        names = list(session.blueprint[at.branch].table[at.state])
        if names:
            session.select([Address(at.branch, at.state, self._chance.choice(names))])

    def _connect(self) -> None:
        self._window.session.select(self._chance.sample(self._states(), 2))
        self._trigger("connect")

    def _move(self) -> None:
        at = self._chance.choice(self._states()).state
        self._window.canvas.moved.emit({at: (self._chance.random() * 900, 400.0)}, {})

    def _close_palette(self) -> None:
        self._window.command_palette.close_palette()

    def _forget(self) -> None:
        """Back to the beginning, so that there is never more to walk through."""
        self._window.session.history.setIndex(0)


def begin(file: Path) -> None:
    """Once the window is there, begin."""
    window = next(one for one in QApplication.topLevelWidgets() if isinstance(one, Window))
    Busy(window, file.with_suffix(ACTS))


if __name__ == "__main__":
    make_application(sys.argv)
    QTimer.singleShot(0, partial(begin, Path(sys.argv[1])))
    raise SystemExit(open_window(sys.argv[1:]))
