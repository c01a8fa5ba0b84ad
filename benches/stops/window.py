"""The real window, whose run is stopped at random moments of every phase, by F8 or by closing.

``python -m benches.stops.window PHASE MOMENTS FOLDER`` prints one JSON object for each moment. For
F8 the time is until the window shows that the run is stopped; for closing, until the run's thread
and its world are gone. The window is drawn without a screen.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox

from benches.stops.hooks import call_before
from smsl_studio.host.spare import Spare
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import dress
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.shell.application import make_window
from smsl_studio.studio.shell.plugins import Plugins
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows

LIMIT = 20.0
"""Wall seconds after which a moment is told as one that was never stopped."""
PLACE = Path("reached")


@dataclass(frozen=True)
class Scene:
    """A blueprint, the world it runs in, where the plugin's code stalls, or the function with which
    the phase begins; moments are drawn from ``span`` seconds after that."""

    file: str
    world: str = "stall"
    stall: str = ""
    reached: str = ""
    span: float = 0.3


SCENES = {
    "window, describing": Scene("walk.json", stall="describing"),
    "window, spare child that builds": Scene("walk.json", stall="building"),
    "window, planning": Scene(
        "cube.json", "table", reached="smsl_studio.dispatch.route.planner:Planner.legs", span=2.0
    ),
    "window, operation": Scene("walk.json", stall="operation"),
    "window, operation that hangs": Scene("walk.json", stall="hanging"),
    "window, operation that does not brake": Scene("walk.json", stall="braking"),
    "window, sensing": Scene("walk.json", stall="sensing"),
    "window, waiting for people": Scene(
        "human.json", "table", reached="smsl_studio.dispatch.execution.desk:Desk.ask"
    ),
}


class Moments:
    """One window, in which a run is begun and stopped again and again."""

    def __init__(self, phase: str, folder: Path) -> None:
        self._scene, self._random = SCENES[phase], Random(phase)
        self._application = QApplication([])
        dress(self._application, LIGHT)
        settings = Settings(folder / "home")
        self._windows = Windows(self._application, settings, Plugins(), spare=Spare())
        self._window: Window = make_window(self._windows, str(folder / self._scene.file))
        self._until(lambda: self._windows.plugins.known)
        self._window.set_mode("run")
        _choose(self._window.features.run.pane.transport.world, self._scene.world)
        os.environ["STALL"] = self._scene.stall

    def moment(self, number: int) -> dict[str, Any]:
        """Begin a run, and stop it in the phase."""
        run = self._window.features.run.pane.run
        PLACE.unlink(missing_ok=True)
        Path("begun").unlink(missing_ok=True)
        self._press(Qt.Key.Key_F5)
        if not self._until(PLACE.exists):
            return {"wrong": f"the phase was not reached: {run.phase} {run.sentence}"}
        after = self._random.uniform(0.0, self._scene.span)
        until = time.monotonic() + after
        self._until(lambda: time.monotonic() > until)
        asked = time.monotonic()
        if number % 2:
            run.close()
            stopped = True
        else:
            self._press(Qt.Key.Key_F8)
            stopped = self._until(lambda: run.phase == "stopped")
        ms = (time.monotonic() - asked) * 1000
        wrong = "" if stopped else f"still {run.phase} {run.sentence}"
        run.close()
        children = [int(one) for one in PLACE.read_text().split()]
        gone = self._until(lambda: not any(Path(f"/proc/{one}").exists() for one in children
                                           if one != os.getpid()))  # fmt: skip
        return {"after": after, "ms": ms, "wrong": wrong or ("" if gone else "a child is left")}

    def close(self) -> None:
        self._window.session.history.setClean()
        self._window.close()
        spare = self._windows.spare
        if spare is not None:
            spare.close()

    def _press(self, key: Qt.Key) -> None:
        QTest.keyClick(self._window, key)

    def _until(self, holds: Callable[[], bool]) -> bool:
        limit = time.monotonic() + LIMIT
        while not holds():
            if time.monotonic() > limit:
                return False
            self._application.processEvents()
            time.sleep(0.0005)
        return True


def _choose(combo: QComboBox, world: str) -> None:
    combo.setCurrentIndex(combo.findData(world))


def main(phase: str, moments: int, folder: Path) -> None:
    """Print one object a moment."""
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    os.environ["SMSL_PLUGIN_PATH"] = str(folder / "plugins")
    os.environ["STALL"] = ""
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)
        place = PLACE.absolute()
        reached = SCENES[phase].reached
        if reached:
            call_before(reached, place.touch)
        stage = Moments(phase, folder)
        for number in range(moments):
            print(json.dumps({"phase": phase, **stage.moment(number)}), flush=True)
        stage.close()
        os.chdir(folder)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), Path(sys.argv[3]))
