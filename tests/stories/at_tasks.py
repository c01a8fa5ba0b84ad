"""A person who answers tasks: reads the card, chooses and decides, in any mode."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from smsl_studio.front.views.card_view import CardView
from smsl_studio.runlog.events import Event
from smsl_studio.studio.features.people.people import People
from smsl_studio.studio.features.people.task_card import TaskCard
from smsl_studio.studio.running.persons import Person as Named
from tests.stories.person import LEFT, Person

PATIENCE = 30_000
SURGEON, NURSE = Named("A. Okafor", "surgeon"), Named("L. Brandt", "nurse")


def asking(folder: Path, **notes: Any) -> Path:
    """A file with one SB, 0 > 1 > 2 on one fact; ``notes`` are of its operations."""
    facts = notes.pop("facts", {})
    branch = {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_2", "NUM_FACTS": 1},
        "_operations": notes,
        "_facts": facts,
        "State_0": {"go": "State_1"},
        "State_1": {"on": "State_2", "back": "State_0"},
        "State_2": {"down": "State_1"},
    }
    path = folder / "asking.json"
    path.write_text(json.dumps({"SB": branch}, indent=4))
    return path


class AtTasks:
    """Supervise of a person's window, with these persons known to it; ``events`` as told."""

    def __init__(self, person: Person, *named: Named) -> None:
        self.person = person
        for one in named:
            person.windows.persons.put(one)
        self.events: list[Event] = []
        self.run = person.window.features.run.pane.run
        self.run.events_told.connect(self.events.extend)
        pane = person.window.features.run.pane
        person.ctrl(Qt.Key.Key_2)
        person.until(lambda: pane.transport.world.findText("table") >= 0)
        if pane.transport.world.currentText() != "table":
            person.choose(pane.transport.world, "table")
        person.ctrl(Qt.Key.Key_3)

    @property
    def people(self) -> People:
        return self.person.window.features.people.people

    @property
    def card(self) -> TaskCard:
        return self.people.card

    @property
    def shown(self) -> CardView:
        card = self.card.card
        assert card is not None, "nobody is asked anything"
        return card

    @property
    def words(self) -> tuple[str, ...]:
        """The lines that say how tasks ended."""
        return self.card.lines.words

    @property
    def outcomes(self) -> list[str]:
        return [vars_of(event, "outcome") for event in self.events if event.event == "task_closed"]

    def start(self) -> None:
        self.person.press(Qt.Key.Key_F5)
        self.person.until(lambda: self.run.status is not None)

    def until_asked(self, question: str) -> None:
        self.person.qtbot.waitUntil(
            lambda: self.card.card is not None and self.card.card.question == question,
            timeout=PATIENCE,
        )

    def until_phase(self, phase: str) -> None:
        self.person.qtbot.waitUntil(lambda: self.run.phase == phase, timeout=PATIENCE)

    def until_said(self, words: str) -> None:
        """Until a line says how a task ended."""
        self.person.qtbot.waitUntil(
            lambda: any(words in line for line in self.words), timeout=PATIENCE
        )

    def answer_as(self, named: Named, pin: str = "") -> None:
        """Say who one is."""
        who = self.card.answer.who
        if who.person is None or who.person.name != named.name:
            self.person.choose(who.choice, named.words)
        if pin:
            self.person.click(who.pin)
            QTest.keyClicks(who.pin, pin)

    def choose(self, words: str) -> None:
        """Click an answer, where it is seen."""
        row = next(row for row in self.card.options if row.option.words == words)

        def chosen() -> bool:
            # A card that has just come is laid out in a moment, and a click may fall beside it.
            seen = row.visibleRegion().boundingRect()
            if not row.isChecked() and not seen.isEmpty():
                QTest.mouseClick(row, LEFT, pos=seen.center())
            return row.isChecked()

        self.person.until(chosen)

    def decide(self) -> None:
        """Press the button below the answers."""
        self.person.click(self.card.answer.button)

    def active(self) -> dict[str, str]:
        return dict(self.run.status.configuration) if self.run.status else {}


def vars_of(event: Event, name: str) -> str:
    return str(getattr(event, name))
