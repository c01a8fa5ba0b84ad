"""What is typed in the form of Inspection is answered before it is written."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.features.inspection.tab_line import RECOVERABILITY
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.stories.test_inspection_page import BOTH, HAZARD, answered, at_page, no_offers, page

Key = Qt.Key
BLIND = 'DRILL/"drill running" = 1 and REG/"registered" = 0'


def said(person: Person) -> str:
    """What the form says about the verdict."""
    form = page(person).form
    assert form.mark.isVisible() == bool(form.verdict.text())
    return form.verdict.text()


def condition(person: Person, text: str) -> None:
    form = page(person).form
    form.first.setFocus()
    form.first.selectAll()
    person.type(text)
    no_offers(person)


def test_a_hazard_is_found_while_it_is_typed(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _properties=[BOTH])
    before = person.window.session.texts
    person.click(page(person).add)
    assert said(person) == ""
    condition(person, BLIND)
    # It has no name yet.
    assert not page(person).form.apply.isEnabled()
    person.until(lambda: said(person) == "Fails as drawn now, after 1 operation.")
    condition(person, f"{BLIND} and")
    assert said(person) == "", "no answer to another condition stays"
    condition(person, "DRILL in State_0 and REG/0 = 1")
    assert said(person) == "", "a hazard joins facts only"
    condition(person, "DRILL/0 = 1 and DRILL/0 = 0")
    assert said(person) == ""
    assert person.window.session.texts == before, "nothing is written"


def test_the_answer_follows_the_kind(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    person.click(page(person).add)
    form = page(person).form
    person.choose(form.kind, "It is possible")
    condition(person, "DRILL = 1")
    person.until(lambda: said(person).startswith("Holds as drawn now: "))
    person.choose(form.kind, "Never: a condition")
    person.until(lambda: said(person) == "Fails as drawn now, after 1 operation.")


def test_what_is_written_is_answered_with_its_change(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    table = page(person).table
    table.choose(Address("_hazards", "Blind"))
    table.setFocus()
    person.press(Key.Key_Return)
    person.until(lambda: said(person) == "Fails as drawn now, after 1 operation.")
    condition(person, f"{BLIND[:-1]}1")
    person.until(lambda: said(person) == "Fails as drawn now, after 2 operations.")
    person.press(Key.Key_Escape)
    person.press(Key.Key_Escape)
    assert not page(person).form.isVisible()


def test_the_operation_that_fails_looks_like_an_error_while_its_run_is_shown(
    sit: Sit, tmp_path: Path
) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    canvas = person.window.canvas
    person.until(lambda: page(person).run.isVisible())
    (failing,) = canvas.marks.failing
    assert str(failing) == "DRILL/State_0/start"
    sheet = canvas.sheet
    assert sheet is not None
    assert sheet.edge_look(sheet.picture.edge(failing)).finding == "E"
    tabs = page(person).tabs
    person.click(tabs, tabs.tabRect(RECOVERABILITY).center())
    assert not canvas.marks.failing


def test_the_table_gets_the_room_that_a_low_run_leaves(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-drilling.json", (1280, 800))
    answered(person)
    person.ctrl(Key.Key_I)
    panel = page(person)
    person.until(panel.run.isVisible)
    strip, table = panel.run.strip, panel.table.viewport()
    person.until(lambda: strip.visibleRegion().boundingRect().height() == strip.height())
    assert table.height() >= 3 * 27
    below = panel.below
    person.until(lambda: below.height() < 216)
    panel.table.setFocus()
    person.press(Key.Key_Return)
    person.until(panel.form.isVisible)
    person.until(lambda: below.height() == 216)
