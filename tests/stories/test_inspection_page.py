"""The page Inspection: verdicts, and the run that shows why something fails."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from smsl_studio.studio.base.canvas.accessible import state_words
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.help.pages import HelpPlace
from smsl_studio.studio.features.inspection.panel import InspectionPanel
from smsl_studio.studio.features.inspection.tab_line import NAMES, SHOWN
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
DRILL = {
    "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1"},
    "_facts": {"0": {"name": "drill running"}},
    "State_0": {"start": "State_1"},
    "State_1": {"halt": "State_0"},
}
REG = {
    "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1"},
    "_facts": {"0": {"name": "registered"}},
    "State_0": {"register": "State_1"},
    "State_1": {"forget": "State_0"},
}
HAZARD = {"name": "Blind", "facts": {"DRILL/0": "1", "REG/0": "0"}}
BOTH = {"name": "Both", "reachable": "DRILL = 1 and REG = 1", "severity": "W"}


def at_page(sit: Sit, folder: Path, **fields: Any) -> Person:
    """Somebody at the page of a drill that may run before it is registered."""
    file = folder / "drill.json"
    file.write_text(json.dumps({**fields, "DRILL": DRILL, "REG": REG}, indent=1))
    person = sit(file)
    answered(person)
    person.ctrl(Key.Key_I)
    return person


def answered(person: Person) -> None:
    """Wait for the verdicts of what is drawn."""
    person.until(lambda: person.window.inspector.proof is not None)


def page(person: Person) -> InspectionPanel:
    return person.window.features.inspection.panel


def cells(person: Person, name: str) -> list[str]:
    """What the row of a hazard or property shows."""
    model = page(person).table.claims
    (row,) = [at for at, one in enumerate(model.rows) if one.name == name]
    return [str(model.index(row, column).data()) for column in range(model.columnCount())]


def choose(person: Person, name: str) -> None:
    table = page(person).table
    (row,) = [at for at, one in enumerate(table.claims.rows) if one.name == name]
    rect = table.visualRect(table.claims.index(row, 1))
    QTest.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=rect.center())


def test_each_hazard_and_property_has_a_verdict_and_a_sentence(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD], _properties=[BOTH])
    assert page(person).isVisible()
    assert page(person).shown.text() == SHOWN
    assert cells(person, "Blind") == [
        "Fails", "Blind", "hazard", "Never: drill running while not registered",
        "4 configurations, all", "error",
    ]  # fmt: skip
    assert cells(person, "Both") == [
        "Holds", "Both", "possible", "Possible: drill running and registered",
        "4 configurations, all", "warning",
    ]  # fmt: skip
    assert page(person).sum.text() == "1 fails, 1 holds"
    texts = [row.sentence for row in page(person).table.claims.rows]
    assert not any("safe" in text.lower() for text in texts)


def test_the_first_row_that_fails_is_chosen_until_somebody_chooses(
    sit: Sit, tmp_path: Path
) -> None:
    third = {"name": "Third", "never": "REG = 1"}
    person = at_page(sit, tmp_path, _properties=[BOTH, third], _hazards=[HAZARD])
    first = page(person).table.chosen
    assert first is not None
    assert first.name == "Blind"
    assert page(person).run.isVisible()
    assert person.window.canvas.marks.active == "State_0"
    choose(person, "Third")
    page(person).again.click()
    answered(person)
    chosen = page(person).table.chosen
    assert chosen is not None
    assert chosen.name == "Third", "a choice stays"


def test_nothing_is_chosen_by_itself_where_all_holds(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _properties=[BOTH])
    assert page(person).table.chosen is None
    assert person.window.canvas.marks.active is None


def test_f1_on_a_verdict_tells_what_holds_means(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    choose(person, "Blind")
    person.press(Key.Key_F1)
    person.until(lambda: any(one.isVisible() for one in person.window.features.help.windows))
    (help_,) = person.window.features.help.windows
    assert help_.page.place == HelpPlace("shown.md")


def test_a_file_without_them_says_what_they_are(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path)
    assert page(person).empty.title.isVisible()
    assert not page(person).table.isVisible()
    assert not page(person).again.isVisible()


def test_after_an_edit_nothing_old_is_shown_as_true(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    choose(person, "Blind")
    assert page(person).run.isVisible()
    person.window.canvas.setFocus()
    person.select("DRILL/State_0/start")
    person.press(Key.Key_Delete)
    assert cells(person, "Blind")[0] == "Unknown"
    assert cells(person, "Blind")[4] == "Changed since checked"
    assert not page(person).run.isVisible()
    assert person.window.canvas.marks.active is None
    answered(person)
    assert cells(person, "Blind")[0] == "Holds"
    assert "It holds: 2 configurations, all" in page(person).said.text()
    person.ctrl(Key.Key_Z)
    answered(person)
    assert cells(person, "Blind")[0] == "Fails"


def test_the_run_is_walked_on_the_drawing_in_base_and_sub(sit: Sit, tmp_path: Path) -> None:
    first = {"name": "First", "never": "DRILL = 1 and REG = 1"}
    person = at_page(sit, tmp_path, _properties=[first])
    window, run = person.window, page(person).run
    choose(person, "First")
    assert run.count.text() == "2 operations, shown at the start"
    assert window.canvas.marks.active == "State_0"
    assert window.canvas.marks.next_states == {"State_1"}, "its name is shown, however far away"
    # Nothing runs, so a screen reader does not hear that a state is active.
    read = [state_words(window.canvas, at) for at in range(2)]
    assert [words.split(", ")[1] for words in read] == ["at the shown step", "at a later step"]
    path = [one.operation for one in run.lit.steps[1:] if one.operation]
    for number, operation in enumerate(path, 1):
        person.click(run.step)
        assert window.session.branch == operation.branch, "the SB in which it happens is shown"
        assert window.canvas.marks.active == "State_1"
        assert operation in window.canvas.marks.trail
        assert run.count.text() == f"2 operations, shown at step {number}"
    assert not run.step.isEnabled()
    assert not window.canvas.marks.next_states
    window.session.show_branch("DRILL")
    assert window.canvas.marks.active == "State_1", "every SB has its own active state"
    person.click(run.back)
    person.click(run.back)
    assert {one.operation for one in run.lit.steps[:1]} == {None}
    assert run.lit.at == 0


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_what_a_verdict_means_is_told_whole(
    sit: Sit, tmp_path: Path, size: tuple[int, int]
) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    person.window.resize(*size)
    line, shown, limit = page(person).line, page(person).shown, page(person).line.limit
    person.until(lambda: line.width() == page(person).width())
    assert shown.isVisible()
    person.until(lambda: shown.width() >= shown.sizeHint().width())
    assert limit.isVisible()
    for one in (shown, limit):
        assert line.rect().contains(one.geometry())
    assert not shown.geometry().intersects(page(person).tabs.geometry())


@pytest.mark.parametrize("tab", ["Verdicts", "Recoverability", "Configuration"])
def test_another_theme_leaves_the_light_where_it_is(sit: Sit, tmp_path: Path, tab: str) -> None:
    file = tmp_path / "drill.json"
    file.write_bytes((SAMPLES / "registration-drilling.json").read_bytes())
    person = sit(file)
    answered(person)
    person.ctrl(Key.Key_I)
    page(person).tabs.setCurrentIndex(NAMES.index(tab))
    lit = page(person).run.lit
    person.until(lambda: len(lit.steps) > 0)
    lit.go(lit.last)
    marks = person.window.canvas.marks
    person.windows.set_theme("dark")
    assert (lit.at, person.window.canvas.marks) == (lit.last, marks)


def test_cards_are_chosen_by_pointer_and_by_arrows(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    choose(person, "Blind")
    strip, lit = page(person).run.strip, page(person).run.lit
    at = strip.card(1).center()
    person.click(strip, QPoint(int(at.x()), int(at.y())))
    assert lit.at == 1
    assert "Step 1 of 1, start" in strip.accessibleDescription()
    strip.setFocus()
    person.press(Key.Key_Left)
    assert lit.at == 0
    person.press(Key.Key_End)
    assert lit.at == 1
    assert strip.cards is not None
    assert [chip.bad for name in ("DRILL", "REG") for chip in strip.cards.chips(1, name)] == [
        True,
        True,
    ]


def test_another_tab_takes_the_light_away(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    choose(person, "Blind")
    assert person.window.canvas.marks.active == "State_0"
    height = person.window.docks.bottom.height()
    person.window.show_tab("Findings")
    assert person.window.canvas.marks.active is None
    assert person.window.docks.bottom.height() < height
    person.window.show_tab("Inspection")
    assert person.window.canvas.marks.active == "State_0"
    assert person.window.docks.bottom.height() == height


def test_another_file_has_its_own_rows(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    other = tmp_path / "other.json"
    other.write_text(json.dumps({"DRILL": DRILL}))
    person.window.files.open(other)
    assert not page(person).table.claims.rows
    answered(person)
    assert page(person).empty.title.isVisible()


def no_offers(person: Person) -> None:
    """Close the offers below the field of the condition, if there are any."""
    field = page(person).form.first
    popup = field.offers.popup()
    assert popup is not None
    if popup.isVisible():
        QTest.keyClick(field, Key.Key_Escape)
    person.come_back()
    field.setFocus()


def test_a_property_is_written_found_and_undone(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path)
    form = page(person).form
    before = person.window.session.texts
    person.click(page(person).add_empty)
    assert form.isVisible()
    assert form.name.hasFocus()
    assert form.fault.text() == "", "what is only missing yet is no fault"
    person.type("Not blind")
    assert not form.apply.isEnabled()
    person.choose(form.kind, "Never: a condition")
    person.type('DRILL/"drill running" = 1 and REG/"registred" = 0')
    no_offers(person)
    assert form.isVisible()
    assert "no fact named" in form.fault.text()
    assert "Did you mean registered?" in form.fault.text()
    assert not form.apply.isEnabled()
    form.first.selectAll()
    person.type('DRILL/"drill running" = 1 and REG/"registered" = 0')
    no_offers(person)
    assert form.fault.text() == ""
    assert form.sentence.text() == "Never: drill running while not registered"
    person.click(form.apply)
    assert person.blueprint.documents[0].values["_properties"] == [
        {"name": "Not blind", "never": 'DRILL/"drill running" = 1 and REG/"registered" = 0'}
    ]
    answered(person)
    assert not form.isVisible()
    assert cells(person, "Not blind")[0] == "Fails"
    assert page(person).run.isVisible(), "the row that was written is chosen"
    assert person.window.session.history.undoText() == "Add “Not blind”"
    person.ctrl(Key.Key_Z)
    assert person.window.session.texts == before


def test_the_offers_complete_facts_values_and_words(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path)
    form = page(person).form
    person.click(page(person).add_empty)
    person.click(form.first)
    popup = form.first.offers.popup()
    assert popup is not None
    person.type("run")
    assert popup.isVisible()
    for text in ('DRILL/"drill running" ', 'DRILL/"drill running" = ',
                 'DRILL/"drill running" = 0 '):  # fmt: skip
        QTest.keyClick(form.first, Key.Key_Return)
        assert form.first.text() == text
        assert popup.isVisible(), "what comes next is offered at once"
    QTest.keyClick(form.first, Key.Key_Escape)
    assert not popup.isVisible()
    assert form.isVisible()


def test_a_hazard_is_changed_duplicated_and_deleted(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD], _properties=[BOTH])
    panel, form = page(person), page(person).form

    def hazards() -> list[Any]:
        found: list[Any] = person.blueprint.documents[0].values.get("_hazards", [])
        return found

    choose(person, "Blind")
    person.press(Key.Key_Return)
    assert form.isVisible()
    assert form.first.text() == 'DRILL/"drill running" = 1 and REG/"registered" = 0'
    person.write(form.name, "Blind drill")
    assert hazards() == [{"name": "Blind drill", "facts": HAZARD["facts"]}]
    answered(person)
    assert panel.table.chosen is not None
    assert panel.table.chosen.name == "Blind drill"

    person.press(Key.Key_Return)
    person.click(form.copy)
    assert [one["name"] for one in hazards()] == ["Blind drill", "Blind drill 2"]
    answered(person)
    assert panel.table.chosen.name == "Blind drill 2"
    person.press(Key.Key_Delete)
    assert [one["name"] for one in hazards()] == ["Blind drill"]
    answered(person)

    choose(person, "Blind drill")
    person.press(Key.Key_Return)
    person.choose(form.kind, "Never: a condition")
    person.click(form.apply)
    assert hazards() == []
    names = [one["name"] for one in person.blueprint.documents[0].values["_properties"]]
    assert names == ["Both", "Blind drill"]
    for _ in range(4):
        person.ctrl(Key.Key_Z)
    assert hazards() == [HAZARD]


def test_a_name_that_is_taken_is_refused(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _properties=[BOTH])
    form = page(person).form
    person.click(page(person).add)
    person.type("Both")
    person.choose(form.kind, "It is possible")
    person.type("DRILL in State_1")
    no_offers(person)
    person.click(form.apply)
    assert form.isVisible()
    assert form.fault.text() == "There is one of the name “Both” already. Choose another."
    assert not person.window.session.edited


def test_typed_text_stays_when_another_row_is_chosen(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD], _properties=[BOTH])
    form = page(person).form
    person.click(page(person).add)
    person.type("Half")
    choose(person, "Blind")
    assert form.isVisible()
    assert form.name.text() == "Half"
    form.name.setFocus()
    person.press(Key.Key_Escape)
    assert form.isVisible(), "one key does not lose what was typed"
    person.press(Key.Key_Escape)
    assert not form.isVisible()
    assert page(person).run.isVisible()


def test_the_run_is_saved_as_a_script_and_played(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    both = {"name": "Never both", "never": "DRILL = 1 and REG = 1"}
    person = at_page(sit, tmp_path, _properties=[both])
    window = person.window
    choose(person, "Never both")
    saved = tmp_path / "both.jsonl"
    monkeypatch.setattr(Dialogs, "script_to_save", lambda self, suggested: saved)
    person.click(page(person).run.save)
    lines = [json.loads(line) for line in saved.read_text("utf-8").splitlines()]
    assert [line["do"] for line in lines] == ["by_hand", "ask", "ask"]
    path = [str(one.operation) for one in page(person).run.lit.steps[1:]]
    assert [line["address"] for line in lines[1:]] == path

    person.click(page(person).run.play)
    assert window.mode == "run"
    run = window.features.run.pane.run

    def shown() -> dict[str, str]:
        return dict(run.status.configuration) if run.status is not None else {}

    person.until(lambda: shown() == {"DRILL": "State_1", "REG": "State_1"})
    assert run.choice is not None
    assert run.choice.world == "table"
    assert [line["do"] for line in run.lines][:2] == ["by_hand", "ask"]


def test_another_run_is_not_ended_by_playing(sit: Sit, tmp_path: Path) -> None:
    person = at_page(sit, tmp_path, _hazards=[HAZARD])
    pane = person.window.features.run.pane
    choose(person, "Blind")
    person.click(page(person).run.play)
    person.until(lambda: pane.run.exists)
    first = pane.run.choice
    person.window.set_mode("draw")
    person.click(page(person).run.play)
    assert pane.run.choice is first
    person.until(lambda: pane.run.phase == "ready")


def test_a_condition_that_is_too_long_for_the_form_is_said_so(sit: Sit, tmp_path: Path) -> None:
    long = {"name": "Long", "never": " and ".join(["DRILL = 1", "REG = 0"] * 600)}
    person = at_page(sit, tmp_path, _properties=[long])
    choose(person, "Long")
    person.press(Key.Key_Return)
    assert not page(person).form.isVisible()
    assert "too long for the form" in page(person).said.text()
    assert not person.window.session.edited
