"""Shows a window in each mode on the screen of this process, and prints where Stop is and how
large the canvas of Draw is.

``python -m tests.stories.small_screen FILE`` prints one line of JSON. The screen and its scale come
from the environment, as they do for a person.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import dress
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.shell.application import make_application, make_window
from smsl_studio.studio.shell.plugins import Plugins
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows

Box = tuple[int, int, int, int]


def box(rect: QRect) -> Box:
    """A rectangle as it is told."""
    return rect.x(), rect.y(), rect.width(), rect.height()


def stop_of(window: Window) -> QPushButton:
    """The button that is shown and stops the run; there is exactly one."""
    found = [
        button
        for button in window.mode_bar.findChildren(QPushButton)
        if button.accessibleName() == "Stop" and button.isVisible()
    ]
    assert len(found) == 1, f"{window.mode}: {len(found)} Stops"
    return found[0]


def seen_of(part: QWidget) -> Box:
    """What is seen of a part; it must be the whole of it, as soon as all has its place."""
    until(lambda: part.visibleRegion().boundingRect().size() == part.size())
    seen = part.visibleRegion().boundingRect()
    assert seen.size() == part.size(), f"{part.accessibleName()} is cut: {seen} of {part.size()}"
    return box(QRect(part.mapToGlobal(seen.topLeft()), seen.size()))


def until(condition: Callable[[], bool]) -> None:
    """Let the window go on until something is so."""
    for _ in range(3_000):
        if condition():
            return
        QTest.qWait(10)
    raise AssertionError("it did not come about")


def main(file: str) -> dict[str, Box]:
    application = make_application(sys.argv)
    dress(application, LIGHT)
    home = Path(tempfile.mkdtemp())
    windows = Windows(application, Settings(home), Plugins(Loaded))
    window = make_window(windows, file)
    until(lambda: windows.plugins.known)
    QTest.qWait(400)
    window.activateWindow()
    QTest.keyClick(window, Qt.Key.Key_2, Qt.KeyboardModifier.ControlModifier)
    window.features.run.pane.transport.world.setCurrentText("table")
    QTest.keyClick(window, Qt.Key.Key_F10)
    until(lambda: window.features.run.pane.run.exists)
    told = {"screen": box(window.screen().availableGeometry())}
    for key, mode in ((Qt.Key.Key_1, "draw"), (Qt.Key.Key_3, "supervise"), (Qt.Key.Key_2, "run")):
        QTest.keyClick(window, key, Qt.KeyboardModifier.ControlModifier)
        QTest.qWait(50)
        assert window.mode == mode
        stop = stop_of(window)
        seen = stop.visibleRegion().boundingRect()
        told[mode] = box(QRect(stop.mapToGlobal(seen.topLeft()), seen.size()))
        told[f"frame in {mode}"] = box(window.frameGeometry())
        if mode == "draw":
            docks = window.docks
            told["canvas"] = box(window.canvas.geometry())
            QTest.keyClick(window, Qt.Key.Key_J, Qt.KeyboardModifier.ControlModifier)
            told["findings by key"] = box(
                docks.bottom.geometry() if docks.bottom_shown() else QRect()
            )
    QTest.keyClick(window, Qt.Key.Key_3, Qt.KeyboardModifier.ControlModifier)
    pane = window.features.supervise.pane
    # A run that is stopped before its world stands is over at once.
    until(lambda: window.features.run.pane.run.phase == "paused")
    QTest.qWait(50)
    for part in (pane.bar.phase, pane.step_in.veto, pane.step_in.prune, pane.step_in.hand):
        told[f"seen: {part.accessibleName()}"] = seen_of(part)
    stop = stop_of(window)
    QTest.mouseClick(stop, Qt.MouseButton.LeftButton, pos=QPoint(stop.width() - 4, 20))
    until(lambda: window.features.run.pane.run.phase == "stopped")
    until(lambda: "Stopped" in pane.bar.phase.text())
    QTest.keyClick(window, Qt.Key.Key_F5)
    asking = pane.step_in.asking
    until(asking.isVisible)
    QTest.qWait(50)
    for name, shown in (("Reset", asking.do), ("Do nothing", asking.leave)):
        told[f"seen: {name}"] = seen_of(shown)
    told[f"seen: {pane.bar.phase.accessibleName()}"] = seen_of(pane.bar.phase)
    return told


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1])))
    sys.stdout.flush()
    os._exit(0)
