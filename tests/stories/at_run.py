"""A person at the run pane: presses its buttons, clicks its arrows and reads what it shows."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from smsl_studio.blueprint.address import Address
from smsl_studio.runlog.events import Event
from smsl_studio.studio.features.run.pane import RunPane
from tests.stories.person import LEFT, Person, address

PATIENCE = 120_000
"""Milliseconds a world may take on a machine that is busy."""


class AtRun:
    """Run mode of a person's window. ``events`` are all that the runs have told so far."""

    def __init__(self, person: Person) -> None:
        self.person = person
        person.ctrl(Qt.Key.Key_2)
        self.events: list[Event] = []
        self.pane.run.events_told.connect(self.events.extend)

    @property
    def pane(self) -> RunPane:
        return self.person.window.features.run.pane

    @property
    def phase(self) -> str:
        return self.pane.transport.phase.text().removeprefix("●").strip()

    def until_phase(self, words: str) -> None:
        def there() -> None:
            run = self.pane.run
            assert self.phase == words, f"{run.sentence} {self.pane.canvas.banner}"

        self.person.qtbot.waitUntil(there, timeout=PATIENCE)

    def until_runs(self) -> None:
        """Until a library function is moving something."""
        run = self.pane.run
        self.person.qtbot.waitUntil(
            lambda: run.status is not None and run.status.running is not None, timeout=PATIENCE
        )

    def until_done(self, operations: int) -> None:
        """Until so many operations are committed and nothing moves."""
        run = self.pane.run
        self.person.qtbot.waitUntil(
            lambda: (
                run.status is not None
                and run.status.operations == operations
                and run.phase in ("paused", "ready")
            ),
            timeout=PATIENCE,
        )

    def choose(self, world: str = "", start: str = "", goal: str = "") -> None:
        """Set what the next run is."""
        transport = self.pane.transport
        for combo, words in ((transport.world, world), (transport.start, start),
                             (transport.goal, goal)):  # fmt: skip
            if words and combo.currentText() != words:
                self.person.choose(combo, words)

    def as_fast_as_it_goes(self) -> None:
        self.person.choose(self.pane.transport.speed, "Max")

    def click_arrow(self, text: str) -> None:
        """Click the arrow of an operation on the run's canvas."""
        canvas = self.pane.canvas.canvas
        rect = canvas.rect_of(address(text))
        assert rect is not None, f"{text} is not on the canvas"
        at: QPoint = canvas.mapFromScene(rect.center())
        QTest.mouseClick(canvas.viewport(), LEFT, pos=at)

    def click_in_list(self, words: str) -> None:
        """Press a button in the list of what is possible now."""
        self.person.click(self.button(words))

    def button(self, words: str) -> QPushButton:
        """A button in the list of what is possible now."""
        for row in self.pane.possible.row_widgets():
            for button in row.findChildren(QPushButton):
                if button.text() == words:
                    return button
        raise AssertionError(f"{words!r} is not offered: {self.possible()}")

    def possible(self) -> list[str]:
        """What the list says, row by row."""
        return [row.accessibleName() for row in self.pane.possible.row_widgets()]

    def active(self) -> dict[str, str]:
        status = self.pane.run.status
        return dict(status.configuration) if status else {}

    def facts(self) -> list[tuple[str, ...]]:
        """The rows of the facts table, as they are read."""
        model = self.pane.facts.model()
        return [
            tuple(str(model.index(row, column).data()) for column in range(model.columnCount()))
            for row in range(model.rowCount())
        ]

    def trail(self) -> list[Address]:
        return list(self.pane.canvas.canvas.marks.trail)

    def word(self) -> str:
        """The short sentence beside the pointer."""
        return self.pane.canvas.canvas.overlays.word.text
