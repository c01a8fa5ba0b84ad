"""A person in Supervise mode who uses the keyboard alone: keys, cards and messages."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton

from smsl_studio.runlog.events import Commanded, Event
from smsl_studio.studio.features.supervise.pane import SupervisePane
from smsl_studio.studio.running.run_session import RunSession
from tests.stories.person import Person

PATIENCE = 30_000
Key = Qt.Key


class AtSupervise:
    """``events`` are all that the runs have told so far."""

    def __init__(self, person: Person) -> None:
        self.person = person
        self.events: list[Event] = []
        self.run.events_told.connect(self.events.extend)
        person.ctrl(Key.Key_3)

    @property
    def pane(self) -> SupervisePane:
        return self.person.window.features.supervise.pane

    @property
    def run(self) -> RunSession:
        return self.person.window.features.run.pane.run

    @property
    def phase(self) -> str:
        """How the run stands, as the bar says it."""
        return self.pane.bar.phase.text().removeprefix("●").strip()

    def until_phase(self, words: str) -> None:
        def there() -> None:
            assert self.phase == words, f"{self.run.sentence} {self.pane.notice.words}"

        self.person.qtbot.waitUntil(there, timeout=PATIENCE)

    def until_in(self, state: str) -> None:
        """Until the SB that is shown is in a state, and nothing moves."""

        def there() -> bool:
            view, status = self.pane.view, self.run.status
            still = status is not None and status.running is None and status.carrying is None
            return view is not None and view.state == state and still

        self.person.qtbot.waitUntil(there, timeout=PATIENCE)

    def start(self, world: str, key: Key = Key.Key_F5) -> None:
        """Choose a world in Run mode, go back, and start."""
        transport = self.person.window.features.run.pane.transport
        self.person.ctrl(Key.Key_2)
        if transport.world.currentText() != world:
            self.person.choose(transport.world, world)
        self.person.ctrl(Key.Key_3)
        self.person.press(key)

    def start_paused(self, world: str = "table") -> None:
        """Have the first operation of a run carried out."""
        self.start(world, Key.Key_F10)
        self.until_phase("Paused")

    def press(self, *keys: Key) -> None:
        for key in keys:
            self.person.press(key)

    def number(self, operation: str) -> Key:
        """The key of an operation."""
        view = self.pane.view
        assert view is not None
        for card in view.cards:
            if card.name == operation:
                return Key(Key.Key_0 + card.number)
        raise AssertionError(f"{operation} is not out of {view.state}")

    def standing(self, operation: str) -> str:
        """How an operation stands."""
        view = self.pane.view
        standing = {card.name: card.standing for card in view.cards} if view else {}
        return standing.get(operation, "")

    def until_stands(self, operation: str, standing: str) -> None:
        self.person.qtbot.waitUntil(lambda: self.standing(operation) == standing, timeout=PATIENCE)

    @property
    def asked(self) -> str:
        """What is asked once more; empty where nothing is."""
        asking = self.pane.step_in.asking
        return asking.words if asking.isVisible() else ""

    def tab_to(self, button: QPushButton) -> None:
        """Press Tab until a button has the focus."""
        for _ in range(60):
            if button.hasFocus():
                return
            self.person.press(Key.Key_Tab)
        raise AssertionError(f"Tab does not lead to {button.text()}")

    def commanded(self) -> list[tuple[str, str]]:
        """Every command of the record, with its refusal."""
        found = (event for event in self.events if isinstance(event, Commanded))
        return [(event.command, event.refused) for event in found]
