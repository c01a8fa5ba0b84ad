"""A person at a real window, who uses the pointer, keys and actions.

Questions about files are answered at once, and the world of a run lives in this process. Everything
else is as in the real program.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QInputMethodEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QMenu

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import open_request
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.features.draw.canvas.copy_card import CopyCard
from smsl_studio.studio.features.draw.canvas.name_field import NameField
from smsl_studio.studio.features.draw.canvas.rename_field import RenameField
from smsl_studio.studio.features.draw.drawn.note_field import NoteField
from smsl_studio.studio.running import run_opener
from smsl_studio.studio.running.runner import FASTEST
from smsl_studio.studio.shell.plugins import Plugins
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows

PATIENCE = 60.0
"""Wall seconds a run may take to do what it was told."""
STANDING = ("paused", "ready", "waiting", "no_route", "taken_over", "fault_hold", "stopped")
"""The phases in which a run waits for somebody."""
LEFT = Qt.MouseButton.LeftButton


class Seat:
    """A window on a file at ``path``; ``answer`` is what is said of unsaved changes."""

    def __init__(self, folder: Path) -> None:
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        self.windows = Windows(application, Settings(folder / "home"), Plugins(Loaded))
        self.windows.plugins.loaded, self.windows.plugins.known = Loaded(), True
        self.window = Window(self.windows)
        self.window.canvas.camera.motion = False
        self.window.resize(1440, 900)
        self.window.show()
        self.window.activateWindow()
        # What is painted says nothing here, and painting would be most of the work.
        self.window.setUpdatesEnabled(False)
        speed = self.window.features.run.pane.transport.speed
        speed.setCurrentIndex(speed.findData(FASTEST))
        self.folder, self.path, self.answer = folder, folder, "discard"
        QApplication.processEvents()

    def open(self, name: str, text: str) -> None:
        """Begin anew: another file, no run, and nothing of before."""
        self.window.features.run.pane.run.close()
        self.window.features.run.pane.show_drawing()
        self.window.session.history.setClean()
        self.window.set_mode("draw")
        self.window.show_tab("Properties")
        self.path = self.folder / name
        self.path.write_bytes(text.encode())
        self.reopen("discard")

    def close(self) -> None:
        self.window.features.run.pane.run.close()
        self.window.session.history.setClean()
        self.window.close()
        QApplication.processEvents()
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    # What hands do.

    def act(self, name: str) -> None:
        """An action of the menus, where it can be chosen now."""
        # A key or a click in a menu comes before it.
        self.window.session.afterwards.catch_up()
        self.window.actions_table[name].trigger()
        QApplication.processEvents()

    def write(self, *names: str) -> None:
        """Type into the fields that are open, and press Enter; Esc where that is refused."""
        field = self.window.editor.field
        lines: tuple[QLineEdit, ...] = ()
        if isinstance(field, ConnectCard):
            lines = (field.operation, field.target)
        elif isinstance(field, NameField):
            lines = (field.field,)
        elif isinstance(field, CopyCard):
            lines = (field.name,)
        for line, name in zip(lines, names, strict=False):
            if not line.isHidden():
                line.selectAll()
                typed = QInputMethodEvent()
                typed.setCommitString(name)
                QApplication.sendEvent(line, typed)
        if lines:
            QTest.keyClick(lines[0], Qt.Key.Key_Return)
        if self.window.editor.field is not None:
            QTest.keyClick(lines[0], Qt.Key.Key_Escape)
        QApplication.processEvents()

    def draw(self, words: str) -> None:
        """Type into the open field of a note or a group, and keep it; Esc where it is refused."""
        drawn, held = self.window.features.draw.notes, Qt.KeyboardModifier.NoModifier
        if drawn.field is None:
            return
        field = drawn.field.field
        field.selectAll()
        typed = QInputMethodEvent()
        typed.setCommitString(words)
        QApplication.sendEvent(field, typed)
        if isinstance(drawn.field, NoteField):
            held = Qt.KeyboardModifier.ControlModifier
        QTest.keyClick(field, Qt.Key.Key_Return, held)
        if drawn.field is not None:
            QTest.keyClick(field, Qt.Key.Key_Escape)

    def choose_where(self, downs: int) -> None:
        """Go down in the answers below a name field, if it asks where to rename."""
        field = self.window.editor.field
        for _ in range(downs):
            if isinstance(field, RenameField):
                QTest.keyClick(field.field, Qt.Key.Key_Down)

    def choose_value(self, digit: int, at: int) -> None:
        """Choose one of the values that the menu of a fact offers for the selected states."""
        self.window.drawing.values.open(digit)
        menu = QApplication.activePopupWidget()
        if isinstance(menu, QMenu):
            offered = [entry for entry in menu.actions() if entry.isCheckable()]
            offered[at % len(offered)].trigger()
            menu.close()
        QApplication.processEvents()

    def paste(self, text: str) -> None:
        """Paste a text on the canvas, and agree if there is something to agree to."""
        QApplication.clipboard().setText(text)
        self.window.canvas.setFocus()
        self.act("paste")
        card = self.window.clipping.table_card
        if card.isVisible():
            (card.agree if card.agree.isEnabled() else card.cancel).click()
        QApplication.processEvents()

    def point(self, state: str) -> QPoint:
        """Where a state stands, in pixels; it is brought into view."""
        canvas = self.window.canvas
        at = QPointF(*canvas.positions[state])
        canvas.reveal_point(at, smooth=False)
        return canvas.mapFromScene(at)

    def click(self, state: str, shift: bool = False) -> None:
        held = Qt.KeyboardModifier.ShiftModifier if shift else Qt.KeyboardModifier.NoModifier
        QTest.mouseClick(self.window.canvas.viewport(), LEFT, held, self.point(state))
        QApplication.processEvents()
        self.window.drawing.values.give_up()
        menu = QApplication.activePopupWidget()
        if menu is not None:
            menu.close()

    def drag(self, state: str, by: QPoint) -> None:
        start, view = self.point(state), self.window.canvas.viewport()
        QTest.mousePress(view, LEFT, pos=start)
        for share in (0.1, 0.5, 1.0):
            QTest.mouseMove(view, start + by * share)
            QApplication.processEvents()
        QTest.mouseRelease(view, LEFT, pos=start + by)
        QApplication.processEvents()

    def reopen(self, answer: str) -> bool:
        self.answer = answer
        with self._answers():
            done = self.window.files.open(self.path)
        QApplication.processEvents()
        return done

    def save(self) -> bool:
        with self._answers():
            done = self.window.files.save()
        QApplication.processEvents()
        return done

    # Runs.

    def step(self) -> None:
        """One operation of a run, which begins where there is none."""
        run = self.window.features.run.pane.run
        with patch.object(run_opener, "open_request", _in_this_process):
            self.act("run_step")
            self._until(lambda: not run.exists or run.phase != "opening")
        self._until(lambda: not run.exists or (run.phase in STANDING and not run.pausing))

    def stop(self) -> None:
        """Stop the run, and end it."""
        run = self.window.features.run.pane.run
        if run.exists:
            self.act("run_stop")
            self._until(lambda: not run.exists or run.phase == "stopped")
            run.end()
            self._until(lambda: not run.exists)

    def _until(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, "the run does not do what it is told"
            QApplication.processEvents()
            time.sleep(0.001)
        QApplication.processEvents()

    @contextmanager
    def _answers(self) -> Iterator[None]:
        with (
            patch.object(Dialogs, "unsaved", lambda *_: self.answer),
            patch.object(Dialogs, "may_overwrite", lambda *_: True),
            patch.object(Dialogs, "may_lose", lambda *_: True),
        ):
            yield


def _in_this_process(request: RunRequest, *given: Any) -> Dispatcher:
    """A run without a child process: what is looked at is the window, and it begins at once."""
    return open_request(replace(request, host="local"), *given)
