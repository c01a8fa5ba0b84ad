"""The tab Recoverability of the page Inspection: the way back from each failure."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import Qt

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.stories.test_inspection_page import answered, page

Key = Qt.Key


def rows(person: Person) -> list[list[str]]:
    """What the table shows."""
    model = page(person).recovery.model()
    return [
        [str(model.index(row, column).data()) for column in range(model.columnCount())]
        for row in range(model.rowCount())
    ]


def at_tab(sit: Sit, file: Path) -> Person:
    """Somebody who looks at the ways back in a file."""
    person = sit(file)
    answered(person)
    person.ctrl(Key.Key_I)
    page(person).tabs.setCurrentIndex(1)
    person.until(lambda: page(person).look.answer is not None)
    return person


def test_each_failure_has_its_way_back_which_is_lit(sit: Sit, tmp_path: Path) -> None:
    values = json.loads((SAMPLES / "registration-drilling.json").read_text())
    values["TRACKER"]["State_o"] = {}
    file = tmp_path / "drill.json"
    file.write_text(json.dumps(values, indent=1))
    person = at_tab(sit, file)
    assert rows(person) == [
        ["TRACKER/State_o", "Tracker is occluded (o)", "No way back", "", "", "no route"],
        [
            "HEAD/State_m",
            "Head is moved in the clamp (m)",
            "State_1",
            "1 operation: Op_FixHeadAgain",
            "surgeon",
            "cost 25",
        ],
    ]
    assert page(person).sum.text() == "1 of 2 have a way back"
    table, run = page(person).recovery, page(person).run
    assert table.chosen is not None, "the first row is chosen by itself"
    assert page(person).said.isVisible()
    assert "No way back" in page(person).said.text()
    table.setFocus()
    person.press(Key.Key_Down)
    assert run.isVisible()
    assert run.title.text() == "Shortest way back"
    assert not run.play.isVisible(), "a run does not begin in a failure"
    person.click(run.step)
    assert person.window.session.branch == "HEAD"
    assert person.window.canvas.marks.active == "State_1"

    page(person).tabs.setCurrentIndex(0)
    assert page(person).sum.text() == "1 fails, 7 hold"
    assert run.title.text() == "Shortest run to it", "the run of the first row that fails"
    assert person.window.canvas.marks.active == "State_0", "where that run stands in HEAD"
    page(person).choose(page(person).table.claims.rows[0].address)
    assert run.play.isVisible()


def test_after_an_edit_the_ways_are_asked_again(sit: Sit) -> None:
    person = at_tab(sit, SAMPLES / "registration-failures.json")
    before = rows(person)
    assert [row[3].partition(":")[0] for row in before] == ["1 operation"] * 3
    assert page(person).sum.text() == "3 of 3 have a way back"
    person.select("REGISTRATION/State_1ee/Op_DiscardPoints")
    person.window.canvas.setFocus()
    person.press(Key.Key_Delete)
    assert rows(person) == [], "nothing old is shown as true"
    assert page(person).said.text() == "Not known yet."
    person.until(lambda: page(person).look.answer is not None)
    assert rows(person)[0][:3] == [
        "REGISTRATION/State_1ee",
        "Landmarks digitized is badly: a point is too far from the plan (e) and "
        "Registered is no more: the patient has moved (e)",
        "No way back",
    ]
    assert page(person).said.text().startswith("REGISTRATION/State_1ee:"), "it is chosen"


def test_without_failures_it_says_what_they_are(sit: Sit) -> None:
    person = at_tab(sit, SAMPLES / "hfsm.json")
    assert page(person).said.isVisible()
    assert page(person).said.text().startswith("No failure value is declared")


def test_another_file_may_be_opened_while_the_page_is_looked_at(sit: Sit) -> None:
    """The run of the former file was walked once more, in the new one, where its SB is unknown."""
    person = sit(SAMPLES / "registration-drilling.json")
    answered(person)
    person.ctrl(Key.Key_I)
    person.until(lambda: page(person).run.isVisible())
    person.window.files.open(SAMPLES / "hanoi-2.json")
    assert not page(person).run.isVisible()
    assert page(person).table.claims.rows == ()
