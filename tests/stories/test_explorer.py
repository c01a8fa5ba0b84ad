"""Walking through the configurations of a blueprint by hand, in the tab Configuration."""

from __future__ import annotations

import json
from pathlib import Path
from threading import Event

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.stop import heed
from smsl_studio.studio.features.inspection.explorer import BROKEN, NOTHING, STOPPED
from smsl_studio.studio.features.inspection.state_pick import StatePick
from smsl_studio.studio.features.inspection.step_list import NONE_REFUSED
from tests.stories.at_explorer import (
    alt_left,
    at_configuration,
    button_of,
    here,
    page,
    permitted,
    pick,
    refused,
    settled,
    step,
    write,
)
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, address

Key = Qt.Key
ROTMS = SAMPLES / "registration-digitization.json"
WORDS = {
    "plan": "LandmarksPlanned",
    "auto-digitize": "DigitizeAllLandmarks",
    "digitize-one": "RedigitizeOneLandmark",
    "register": "Registered",
    "session-reinit": "ReinitState, REGISTRATION",
    "use-previous": "UsePrevRegister",
}


@pytest.fixture
def rotms(sit: Sit) -> Person:
    """Somebody at the start of the registration that the paper's authors built."""
    return at_configuration(sit, ROTMS)


def stands(person: Person, base: str, sub: str) -> None:
    assert here(person) == {"REGISTRATION": f"State{base}", "DIGITIZATION": f"State{sub}"}


def words_in(part: QWidget) -> list[str]:
    return [one.text() for one in part.findChildren(QLabel)]


def lit(person: Person) -> str | None:
    """The state that is lit on the canvas."""
    return person.window.canvas.marks.active


def test_the_seven_sequences_that_broke_the_first_system(rotms: Person) -> None:
    explorer = page(rotms).explorer

    def walk(*words: str) -> None:
        rotms.click(page(rotms).first)
        settled(rotms)
        stands(rotms, "000", "0")
        for word in words:
            step(rotms, WORDS[word])

    walk("plan", "auto-digitize")
    stands(rotms, "110", "1")
    step(rotms, WORDS["session-reinit"])
    stands(rotms, "000", "0")
    step(rotms, WORDS["plan"])
    step(rotms, WORDS["auto-digitize"])
    stands(rotms, "110", "1")

    walk("plan", "auto-digitize", "plan")
    stands(rotms, "100", "0")

    walk()
    assert not any(WORDS["auto-digitize"] in one for one in permitted(rotms))
    assert refused(rotms)[WORDS["auto-digitize"]] == (
        "It reaches State1, the ACTIVATING state of DIGITIZATION, and REGISTRATION has no "
        "operation out of State000 that changes REGISTRATION/Landmarks digitized alone."
    )

    walk("use-previous", "digitize-one")
    stands(rotms, "111", "1")

    walk("plan", "auto-digitize", "register")
    stands(rotms, "111", "1")
    assert not any(one.startswith(WORDS["plan"]) for one in permitted(rotms))
    assert WORDS["plan"] not in refused(rotms), "no operation of this name leaves this state"

    walk("use-previous")
    stands(rotms, "111", "1")

    walk("plan", "auto-digitize")
    button_of(rotms, WORDS["register"])
    stands(rotms, "110", "1")
    assert explorer.steps is not None
    assert len(explorer.configuration) == 2, "each SB has an active state before and after"


def test_each_branch_has_a_column_and_its_state_is_lit_while_the_tab_is_shown(
    rotms: Person,
) -> None:
    names = [one.accessibleName() for one in page(rotms).columns.buttons()]
    assert names == [
        "REGISTRATION State000, it stands here",
        "REGISTRATION State100, one step away",
        "REGISTRATION State110",
        "REGISTRATION State111, one step away",
        "DIGITIZATION State0, it stands here",
        "DIGITIZATION State1, one step away",
    ]
    assert lit(rotms) == "State000"
    step(rotms, WORDS["plan"])
    assert lit(rotms) == "State100"
    assert "State000" in rotms.window.canvas.marks.visited
    step(rotms, "DigitizeAllLandmarks")
    rotms.window.session.show_branch("DIGITIZATION")
    assert lit(rotms) == "State1"
    assert page(rotms).count.text() == "2 operations since it began"

    tabs = rotms.window.features.inspection.panel.tabs
    rotms.click(tabs, tabs.tabRect(0).center())
    assert lit(rotms) is None
    rotms.click(tabs, tabs.tabRect(2).center())
    assert lit(rotms) == "State1"
    rotms.window.show_tab("Findings")
    assert lit(rotms) is None
    rotms.window.show_tab("Inspection")
    assert lit(rotms) == "State1"
    stands(rotms, "110", "1")


def test_back_by_button_and_alt_left_and_keys_alone_walk(rotms: Person) -> None:
    assert not page(rotms).back.isEnabled()
    step(rotms, WORDS["plan"])
    step(rotms, "DigitizeAllLandmarks")
    rotms.click(page(rotms).back)
    settled(rotms)
    stands(rotms, "100", "0")
    button_of(rotms, WORDS["plan"]).setFocus()
    alt_left(rotms)
    stands(rotms, "000", "0")
    pick(rotms, "REGISTRATION", "State111")
    stands(rotms, "111", "1")
    page(rotms).field.setFocus()
    alt_left(rotms)
    stands(rotms, "000", "0")
    alt_left(rotms)
    stands(rotms, "000", "0")
    assert not rotms.window.session.edited

    page(rotms).steps.setFocus()
    rotms.press(Key.Key_Tab)
    first = QApplication.focusWidget()
    assert first is not None
    assert first.accessibleName() == permitted(rotms)[0]
    button_of(rotms, WORDS["plan"]).setFocus()
    rotms.press(Key.Key_Space)
    settled(rotms)
    stands(rotms, "100", "0")
    focus = QApplication.focusWidget()
    assert focus is not None
    assert page(rotms).steps.isAncestorOf(focus)


def test_a_typed_configuration_or_why_it_cannot_be(rotms: Person) -> None:
    field, refusal = page(rotms).field, page(rotms).refusal
    assert field.text() == "REGISTRATION/State000, DIGITIZATION/State0"
    write(rotms, "REGISTRATION/State110")
    stands(rotms, "110", "1")
    write(rotms, "000")
    stands(rotms, "000", "0")
    for text, words in (
        ("DIGITIZATION/State1", "disagrees with REGISTRATION/State000"),
        ("REGISTRATION/State7", "REGISTRATION has no state State7."),
        ("NOBODY/State7", "There is no State Branch NOBODY."),
        ("State000, 110", "REGISTRATION is named twice, with State000 and State110."),
        (" , ", "No state is named."),
    ):
        write(rotms, text)
        assert words in refusal.text(), refusal.text()
        assert field.text() == text, "what was typed stays, so that it can be mended"
        stands(rotms, "000", "0")
    pick(rotms, "REGISTRATION", "State100")
    assert not refusal.isVisible()
    assert field.text() == "REGISTRATION/State100, DIGITIZATION/State0"


def test_the_shortest_run_is_played_on_the_drawing(rotms: Person) -> None:
    run = page(rotms).run
    write(rotms, "REGISTRATION/State110")
    rotms.click(page(rotms).shortest)
    settled(rotms)
    assert run.isVisible()
    assert run.title.text() == "Shortest run to here"
    lit_ones = [one for one in page(rotms).columns.buttons() if "here" in one.accessibleName()]
    assert len(lit_ones) == 2
    rotms.until(lambda: not any(one.visibleRegion().isEmpty() for one in lit_ones))
    path = [str(one.operation) for one in run.lit.steps[1:]]
    assert path == [
        "REGISTRATION/State000/LandmarksPlanned", "DIGITIZATION/State0/ConfirmAllDigitized"
    ]  # fmt: skip
    assert lit(rotms) == "State000"
    rotms.click(run.step)
    assert lit(rotms) == "State100"
    rotms.click(run.step)
    assert not run.step.isEnabled()
    step(rotms, "Registered")
    assert not run.isVisible(), "the run is of another place"
    assert lit(rotms) == "State111"
    rotms.click(page(rotms).first)
    settled(rotms)
    rotms.click(page(rotms).shortest)
    settled(rotms)
    assert page(rotms).said.text() == "A run starts here."


def test_beside_a_run_in_a_low_window_the_active_states_stay_in_view(sit: Sit) -> None:
    person = at_configuration(sit, SAMPLES / "three-levels.json", (1280, 800))
    assert NONE_REFUSED in words_in(page(person).steps)
    pick(person, "SURGERY", "State111")
    assert NONE_REFUSED not in words_in(page(person).steps)
    person.click(page(person).shortest)
    settled(person)
    assert page(person).run.isVisible()
    lit_ones = [one for one in page(person).columns.buttons() if "here" in one.accessibleName()]
    assert len(lit_ones) == 3
    whole = [one.height() for one in lit_ones]
    person.until(lambda: [one.visibleRegion().boundingRect().height() for one in lit_ones] == whole)


def test_the_steps_are_known_too_after_a_run_that_is_asked_for_at_once(rotms: Person) -> None:
    step(rotms, WORDS["plan"])
    step(rotms, WORDS["auto-digitize"])
    step(rotms, WORDS["register"])
    rotms.click(page(rotms).back)
    # On a slow machine the steps are not known yet.
    rotms.click(page(rotms).shortest)
    settled(rotms)
    stands(rotms, "110", "1")
    assert page(rotms).run.isVisible()
    assert page(rotms).again.isHidden()
    step(rotms, WORDS["register"])
    stands(rotms, "111", "1")
    assert not page(rotms).run.isVisible(), "the run is of another place"


def test_a_run_starts_where_the_walk_stands(rotms: Person) -> None:
    write(rotms, "REGISTRATION/State110")
    rotms.click(page(rotms).begin)
    window = rotms.window
    assert window.mode == "run"
    pane = window.features.run.pane
    assert not pane.run.exists, "nothing runs before Play"
    assert pane.transport.start.currentText() == "REGISTRATION 110, DIGITIZATION 1"
    rotms.press(Key.Key_F5)
    rotms.until(lambda: pane.run.choice is not None and pane.run.status is not None)
    assert pane.run.choice is not None
    states = ("REGISTRATION/State110", "DIGITIZATION/State1")
    assert pane.run.choice.request(rotms.blueprint).starts == states
    rotms.until(lambda: not pane.run.exists or pane.run.phase == "goal_reached")

    window.set_mode("draw")
    rotms.until(page(rotms).isVisible)
    stands(rotms, "110", "1")
    assert lit(rotms) == "State110"


def test_another_run_is_not_ended_by_choosing_a_start(rotms: Person) -> None:
    pane = rotms.window.features.run.pane
    rotms.window.set_mode("run")
    pane.transport.by_hand.setChecked(True)
    rotms.press(Key.Key_F5)
    rotms.until(lambda: pane.run.exists and pane.run.status is not None)
    first = pane.run.choice
    rotms.window.set_mode("draw")
    rotms.until(page(rotms).isVisible)
    step(rotms, WORDS["plan"])
    stands(rotms, "100", "0")
    rotms.click(page(rotms).begin)
    assert pane.run.exists
    assert pane.run.choice is first
    rotms.press(Key.Key_F8)
    rotms.until(lambda: pane.run.phase == "stopped")


def test_an_edit_keeps_the_place_if_it_is_still_there(rotms: Person) -> None:
    step(rotms, WORDS["plan"])
    rotms.window.canvas.setFocus()
    rotms.select("REGISTRATION/State100/ClearLandmarks")
    rotms.press(Key.Key_Delete)
    settled(rotms)
    stands(rotms, "100", "0")
    assert not any("ClearLandmarks" in one for one in permitted(rotms))
    assert not page(rotms).back.isEnabled(), "what led here may not be possible any more"
    rotms.select("REGISTRATION/State100")
    rotms.press(Key.Key_Delete)
    settled(rotms)
    stands(rotms, "000", "0")
    assert page(rotms).said.text() == "Where it stood is gone, so it is at the start again."
    assert lit(rotms) == "State000"
    rotms.ctrl(Key.Key_Z)
    settled(rotms)
    stands(rotms, "000", "0")
    rotms.ctrl(Key.Key_Z)
    settled(rotms)
    step(rotms, WORDS["plan"])
    assert any("ClearLandmarks" in one for one in permitted(rotms))

    rotms.window.session.edit(
        "Rename",
        lambda bp: editing.rename(bp, address("REGISTRATION/State100"), "State200"),
    )
    settled(rotms)
    stands(rotms, "200", "0")


def test_an_empty_drawing_a_file_without_a_start_and_a_text_that_cannot_be_read(
    sit: Sit, tmp_path: Path
) -> None:
    file = tmp_path / "lost.json"
    table = {"State_0": {"go": "State_1"}, "State_1": {}}
    file.write_text(json.dumps({"SB": {"HEADER": {"INITIAL": "Nowhere"}, **table}}))
    person = at_configuration(sit, file)
    assert "has no state 'Nowhere' to start in" in page(person).said.text()
    assert not page(person).field.isEnabled()
    assert permitted(person) == []
    assert lit(person) is None
    other = tmp_path / "empty.json"
    other.write_text("{}")
    person.window.files.open(other)
    settled(person)
    assert page(person).said.text() == NOTHING
    person.window.files.open(ROTMS)
    settled(person)
    stands(person, "000", "0")

    session = person.window.session
    text = next(iter(session.texts.values()))
    session.write("Type", text.replace("{", "[", 1))
    settled(person)
    assert page(person).said.text() == BROKEN
    assert permitted(person) == []
    person.window.session.history.undo()
    settled(person)
    stands(person, "000", "0")


def test_a_long_search_is_called_off(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    from smsl_studio.studio.features.inspection import look_line

    monkeypatch.setattr(look_line, "PATIENCE", 0)
    ended = Event()

    def for_ever(*_: object) -> None:
        """A search that ends only when it is called off."""
        try:
            while True:
                heed()
        finally:
            ended.set()

    person = at_configuration(sit, SAMPLES / "hanoi-corrected.json")
    explorer, looking = page(person).explorer, page(person).looking
    monkeypatch.setattr("smsl_studio.studio.features.inspection.explorer.shortest_run_to", for_ever)
    write(person, "ccc")
    person.click(page(person).shortest)
    person.until(looking.isVisible)
    person.click(looking.cancel)
    assert not explorer.work
    assert page(person).said.text() == STOPPED
    person.until(looking.isHidden)
    assert explorer.steps is not None, "what was known stays"
    person.until(ended.is_set)


def test_one_of_many_states_is_chosen_from_a_list(sit: Sit) -> None:
    person = at_configuration(sit, SAMPLES / "hanoi-corrected.json")
    (name,) = here(person)
    page(person).columns.list_wanted.emit(name)
    (dialog,) = person.window.findChildren(StatePick)
    person.until(dialog.isVisible)
    dialog.search.setText("ccb")
    person.click(dialog.go)
    settled(person)
    assert here(person)[name].endswith("ccb")
