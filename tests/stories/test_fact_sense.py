"""The sources and predicates of a fact are written in its form, with offers and faults in place."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.features.draw.panels.sense_part import DECIDE, LEAVE, UNSAID
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
REGISTRATION = SAMPLES / "registration.json"
SB = "REGISTRATION"


def entry(person: Person) -> dict[str, Any]:
    found: dict[str, Any] = person.blueprint[SB].fields.get("_facts", {}).get("3", {})
    return found


def test_a_fact_is_decided_from_what_is_measured(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.window.going.show_fact(SB, 3)
    part = person.window.properties.fact.sensed
    assert part.button.text() == DECIDE
    person.click(part.button)
    assert QApplication.focusWidget() is part.sources.rows[""].name

    person.write(part.sources.rows[""].name, "force")
    assert entry(person)["sources"] == {"force": "1"}
    assert QApplication.focusWidget() is part.sources.rows["force"].unit
    assert part.fault.text() == UNSAID

    person.write(part.sources.rows["force"].unit, "Nm")
    assert "is no unit" in part.sources.rows["force"].fault.text()
    person.write(part.sources.rows["force"].unit, "N")
    person.write(part.sources.rows["force"].range, "50 to 0")
    assert "is no range" in part.sources.rows["force"].fault.text()
    person.write(part.sources.rows["force"].range, "0 to 50")

    closed = part.predicates.rows["1"]
    person.click(closed.condition)
    QTest.keyClicks(closed.condition, "fo")
    QTest.keyClick(closed.condition, Key.Key_Return)
    assert closed.condition.text() == "force ", "Enter takes the first offer"
    QTest.keyClicks(closed.condition, "> 2 mm")
    assert closed.fault.text().startswith("Character 9: 2 mm is compared with a measure in N")
    person.write(closed.condition, "force > 2 N for 0.5 s")
    assert not closed.fault.text()
    person.write(part.predicates.rows["0"].condition, "force < 1 N")
    assert entry(person) == {
        "sources": {"force": "N"}, "range": {"force": [0, 50]},
        "predicate": {"1": "force > 2 N for 0.5 s", "0": "force < 1 N"},
    }  # fmt: skip
    assert not person.window.properties.fact.line("sensors").isVisible()

    person.write(part.sources.rows["force"].name, "grip")
    assert entry(person)["predicate"]["1"] == "grip > 2 N for 0.5 s"
    assert f"Rename source force to grip in digit 3 of {SB}" in person.steps()
    person.click(part.button)
    assert part.button.text() == DECIDE
    assert entry(person) == {}
    person.window.session.history.undo()
    assert part.button.text() == LEAVE
    for _ in range(len(person.steps())):
        person.window.session.history.undo()
    assert person.blueprint.document.text == REGISTRATION.read_text()
