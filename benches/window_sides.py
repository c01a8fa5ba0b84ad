"""The person at the window in its bench: edits, turns the wheel, and waits until all work is
done."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.generate.rules import hanoi
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import dress
from smsl_studio.studio.shell.application import make_application, make_window
from smsl_studio.studio.shell.windows import Windows

QUIET = 0.5
"""Seconds without work after which all rests."""
TIMES = 5


class Seat:
    """One window on Hanoi with so many disks, 1440 by 900, its first state selected."""

    def __init__(self, disks: int, folder: Path) -> None:
        application = make_application([])
        self._windows = Windows(application, Settings())
        dress(application, self._windows.tokens)
        file = folder / f"hanoi-{disks}.json"
        file.write_text(hanoi(disks).document.text, "utf-8")
        self.window = make_window(self._windows, str(file))
        self.window.resize(1440, 900)
        self.window.canvas.camera.motion = False
        self._names = list(self.window.session.blueprint["SB1"].table)
        self.rest()

    def paint(self) -> None:
        """All that Qt has to do now."""
        QApplication.processEvents()

    def rest(self) -> None:
        """Wait until findings, journal and all others have come to rest."""
        session, inspector = self.window.session, self.window.inspector
        quiet = time.monotonic() + QUIET
        while time.monotonic() < quiet or not inspector.current:
            before = time.thread_time()
            QApplication.processEvents()
            if time.thread_time() - before > 0.002 or not inspector.current:
                quiet = time.monotonic() + QUIET
            time.sleep(0.005)
        assert session.broken is None

    def edits(self, kind: str) -> Iterator[Callable[[], object]]:
        """Some edits of a kind, each at another state in the middle of the picture."""
        session, canvas, editor = self.window.session, self.window.canvas, self.window.editor
        middle = len(self._names) // 2

        def edit(change: Callable[..., object], *given: object) -> Callable[[], object]:
            return lambda: session.edit("Bench", lambda bp: change(bp, *given))  # type: ignore[arg-type,return-value]

        # Names as long as the others: all states have facts as before.
        for time_ in range(TIMES):
            name = self._names[middle - 4 + time_]
            address, (x, y) = Address("SB1", name), canvas.positions[name]
            session.select((address,))
            if kind == "rename an operation":
                operation = Address("SB1", name, next(iter(session.blueprint["SB1"].table[name])))
                yield edit(editing.rename, operation, f"Op_9{'qrstu'[time_]}")
            elif kind == "rename a state":
                yield edit(editing.rename, address, f"{name[:-1]}{'qrstu'[time_]}")
            elif kind == "add a state":
                yield edit(
                    editing.add_state, "SB1", f"{name[:-1]}{'vwxyz'[time_]}", (x + 60.0, y + 45.0)
                )
            elif kind == "delete a state":
                yield edit(editing.delete, (address,))
            elif kind == "move a state":
                yield lambda name=name, x=x, y=y: editor.move({name: (x + 24.0, y + 16.0)})  # type: ignore[misc]
            elif kind == "duplicate a state":
                yield edit(lambda bp, one=address: editing.duplicate(bp, [one])[0])
            else:
                goal = self._names[middle + 5]
                yield edit(editing.add_operation, "SB1", name, "Op_bench", goal)
            session.history.undo()

    def place_by_hand(self) -> None:
        """Move one state, as somebody has in most files; the places of all are written then."""
        name = self._names[0]
        x, y = self.window.canvas.positions[name]
        self.window.editor.move({name: (x + 3.0, y + 3.0)})
        self.rest()

    def look(self, near: bool) -> None:
        """Fit the picture, or look at its middle at 100 %."""
        canvas = self.window.canvas
        canvas.fit(smooth=False)
        if near:
            at = canvas.positions[self._names[len(self._names) // 2]]
            canvas.camera.go(QPointF(*at), 1.0, smooth=False)
        self.rest()

    def zoom(self, notches: int) -> None:
        """Turn the wheel over the middle of the picture."""
        self._turn(notches, Qt.KeyboardModifier.NoModifier)

    def pan(self, notches: int) -> None:
        """Turn it with Alt, which moves the picture up or down."""
        self._turn(notches, Qt.KeyboardModifier.AltModifier)

    def _turn(self, notches: int, modifiers: Qt.KeyboardModifier) -> None:
        view = self.window.canvas.viewport()
        at = QPointF(view.rect().center()) + QPointF(40, 30)
        event = QWheelEvent(
            at, view.mapToGlobal(at), QPoint(), QPoint(0, 120 * notches),
            Qt.MouseButton.NoButton, modifiers, Qt.ScrollPhase.NoScrollPhase, False,
        )  # fmt: skip
        QApplication.sendEvent(view, event)

    def close(self) -> None:
        """The window closes; nothing of it is kept."""
        self.window.session.history.setClean()
        self.window.close()
        self._windows.plugins.stop()
        QApplication.processEvents()
