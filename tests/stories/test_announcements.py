"""What a screen reader reads out by itself: run states, holds, questions, findings, messages."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QAccessibleAnnouncementEvent, QAccessibleEvent

from smsl_studio.studio.base import announcement
from tests.stories.at_tasks import NURSE, SURGEON, AtTasks, asking
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
Heard = list[tuple[str, bool]]


@pytest.fixture
def heard(monkeypatch: pytest.MonkeyPatch) -> Heard:
    """Every announcement, and whether it interrupts."""
    found: Heard = []

    class Reader(QAccessible):
        """A screen reader runs, and keeps what it is told."""

        @staticmethod
        def isActive() -> bool:
            return True

        @staticmethod
        def updateAccessibility(event: QAccessibleEvent, /) -> None:
            if isinstance(event, QAccessibleAnnouncementEvent):
                urgent = event.politeness() == QAccessible.AnnouncementPoliteness.Assertive
                found.append((event.message(), urgent))

    monkeypatch.setattr(announcement, "QAccessible", Reader)
    return found


def test_findings_are_told_when_their_sum_changes(sit: Sit, heard: Heard) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.until_inspected()
    heard.clear()
    before = len(person.window.findings.findings)
    person.select("SB1/State000/Operation000")
    person.press(Key.Key_Delete)
    person.until_inspected()
    assert len(person.window.findings.findings) != before
    told = [words for words, _ in heard if words.startswith("Findings: ")]
    assert told == [f"Findings: {person.window.status_line.counts[3].text()}."]
    assert "warning" in told[0] or "error" in told[0]


def test_run_states_questions_and_holds_are_told(sit: Sit, heard: Heard, tmp_path: Path) -> None:
    path = asking(tmp_path, go={"confirm": ["surgeon"], "answer_within": 40.0})
    person = sit(path)
    at = AtTasks(person, SURGEON, NURSE)
    heard.clear()
    person.press(Key.Key_F5)
    person.until(lambda: at.people.has_task())
    person.until(lambda: any("Waiting" in words for words, _ in heard))
    card = at.people.card.card
    assert card is not None
    asked = [one for one in heard if card.question in one[0]]
    assert len(asked) == 1, "once, and not with each tick"
    assert asked[0][1], "a question interrupts"
    # The question is told in every mode, and not again when its card is shown.
    person.ctrl(Key.Key_1)
    person.press(Key.Key_F4)
    assert len([one for one in heard if card.question in one[0]]) == 1
    person.press(Key.Key_F8)
    person.until(lambda: at.run.phase == "stopped")
    stops = [one for one in heard if one[0].startswith("The run: Stopped.")]
    assert stops
    assert all(urgent for _, urgent in stops)
    assert len(stops[0][0]) > len("The run: Stopped. "), "with the sentence about it"


def test_a_refusal_interrupts_and_a_sentence_at_the_pointer_does_not(
    sit: Sit, heard: Heard
) -> None:
    person = sit(SAMPLES / "hfsm.json")
    heard.clear()
    person.select("SB1/State111")
    person.press(Key.Key_O)
    assert heard == [("No operation leaves State111.", False)]
    person.press(Key.Key_Delete)
    person.ctrl(Key.Key_2)
    person.ctrl(Key.Key_Z)
    assert [urgent for words, urgent in heard if "undo" in words.lower()] == [True]
