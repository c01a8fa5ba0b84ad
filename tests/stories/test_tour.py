"""The tour: each step is done by the person, and recognised by what is there afterwards."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid

from smsl_studio.blueprint import editing
from smsl_studio.inspection.inspect import inspect
from smsl_studio.studio.base.theme import DARK
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.run.pane import RunPane
from smsl_studio.studio.features.tour.steps import STEPS, TourState, TourStep, step_of
from smsl_studio.studio.features.tour.tour import Tour
from smsl_studio.studio.running.run_session import RunSession
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, address

Key = Qt.Key
PATIENCE = 120_000


def tour_of(person: Person) -> Tour:
    tour = person.window.features.tour.tour
    assert tour is not None
    return tour


def run_of(person: Person) -> RunSession:
    return person.window.features.run.pane.run


def run_pane(person: Person) -> RunPane:
    return person.window.features.run.pane


def until_step(person: Person, title: str) -> Tour:
    """Until the callout asks for this, and points at what does it."""
    tour = tour_of(person)
    person.qtbot.waitUntil(lambda: tour.callout.words[0] == title, timeout=PATIENCE)
    person.until(lambda: tour.is_settled)
    return tour


def box(widget: QWidget, window: QWidget) -> QRect:
    return QRect(widget.mapTo(window, QPoint(0, 0)), widget.size())


def points_at(person: Person, widget: QWidget) -> bool:
    """Whether the ring is around a widget, or around a part of it, and nothing covers it."""
    tour, window = tour_of(person), person.window
    around = tour.ring.geometry().adjusted(3, 3, -3, -3)
    inside = box(widget, window).adjusted(-2, -2, 2, 2).contains(around)
    free = not tour.callout.geometry().adjusted(9, 9, -9, -9).intersects(around)
    in_window = window.rect().contains(tour.callout.geometry())
    return tour.ring.isVisible() and inside and free and in_window


def until_points_at(person: Person, widget: QWidget) -> None:
    person.until(lambda: points_at(person, widget))


def begun(sit: Sit, size: tuple[int, int] = (1280, 800)) -> Person:
    person = sit(begin=False, size=size)
    person.window.actions_table["first_steps"].trigger()
    until_step(person, "Find the misprint")
    person.until_inspected()
    return person


def mended(person: Person) -> None:
    """Find the misprint and correct it by keys."""
    person.press(Key.Key_F3)
    person.ctrl(Key.Key_Period)
    until_step(person, "Run it")


def table_run(person: Person) -> None:
    """Begin a run in the table world, and stop it."""
    person.ctrl(Key.Key_2)
    person.choose(run_pane(person).transport.world, "table")
    person.press(Key.Key_F10)
    until_step(person, "Stop it")
    person.press(Key.Key_F8)
    until_step(person, "Supervise it")


@pytest.mark.parametrize("size", [(1280, 800), (1280, 720), (1920, 1080)])
def test_the_whole_way_by_clicks_in_physics(sit: Sit, size: tuple[int, int]) -> None:
    person = sit(begin=False, size=size)
    window = person.window
    page = window.features.start.part.made
    assert page is not None
    person.click(page.column.cards[2])
    until_step(person, "Find the misprint")
    person.until_inspected()
    until_points_at(person, window.findings)
    rows = window.findings.list
    person.click(rows.viewport(), rows.visualRect(rows.model().index(0, 0)).center())
    until_step(person, "Correct it")
    until_points_at(person, window.fix_card)
    person.click(window.fix_card.fix)
    until_step(person, "Run it")
    until_points_at(person, window.mode_bar.run)
    person.click(window.mode_bar.run)
    until_step(person, "Stop it")
    transport = run_pane(person).transport
    assert transport.world.currentText() == "hanoi"
    until_points_at(person, transport.stop)
    person.click(transport.stop)
    until_step(person, "Supervise it")
    until_points_at(person, window.mode_bar.segments.buttons["mode_supervise"])
    person.click(window.mode_bar.segments.buttons["mode_supervise"])
    until_step(person, "Unlatch the stop")
    supervise = window.features.supervise.pane
    until_points_at(person, supervise.bar.reset)
    person.click(supervise.bar.reset)
    until_points_at(person, supervise.step_in.asking)
    person.click(supervise.step_in.asking.do)
    until_step(person, "Step in")
    until_points_at(person, supervise.step_in.veto)
    person.click(supervise.step_in.veto)
    until_points_at(person, supervise.step_in.asking)
    person.click(supervise.step_in.asking.do)
    tour = until_step(person, "That was the whole way")
    assert not tour.ring.isVisible()
    person.click(tour.callout.more)
    assert window.features.tour.tour is None
    (help_,) = window.features.help.windows
    assert help_.isVisible()


def test_the_whole_way_by_keys(sit: Sit) -> None:
    person = begun(sit)
    mended(person)
    table_run(person)
    person.ctrl(Key.Key_3)
    until_step(person, "Unlatch the stop")
    person.press(Key.Key_F5)
    person.press(Key.Key_Return)
    until_step(person, "Step in")
    person.press(Key.Key_V)
    person.press(Key.Key_Return)
    until_step(person, "That was the whole way")
    person.press(Key.Key_Escape)
    assert person.window.features.tour.tour is None
    assert run_of(person).exists, "leaving ends no run"


def test_the_copy_has_one_misprint_and_the_sample_stays(sit: Sit) -> None:
    before = {path: path.read_bytes() for path in SAMPLES.glob("hanoi*")}
    person = begun(sit)
    assert [f.rule for f in inspect(person.blueprint) if f.severity.value == "E"] == ["R15"]
    assert (person.window.files.path, person.window.files.edited) == (None, False)
    assert person.steps() == []
    mended(person)
    assert person.steps() == ["Rename to Op_1b"]
    assert person.windows.settings.recent == ()
    assert {path: path.read_bytes() for path in SAMPLES.glob("hanoi*")} == before


@pytest.mark.parametrize("answer", ["cancel", "discard"])
def test_unsaved_work_is_asked_about_first(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    file = Path(shutil.copy(SAMPLES / "hfsm.json", tmp_path / "mine.json"))
    person = sit(file)
    person.select("SB1/State100")
    person.press(Key.Key_Delete)
    text = person.blueprint.document.text
    asked: list[str] = []

    def ask(_: Dialogs, said: str) -> str:
        asked.append(said)
        return answer

    monkeypatch.setattr(Dialogs, "unsaved", ask)
    person.window.actions_table["first_steps"].trigger()
    assert len(asked) == 1
    assert "mine.json" in asked[0]
    assert (person.window.features.tour.tour is None) == (answer == "cancel")
    assert (person.blueprint.document.text == text) == (answer == "cancel")
    assert file.read_bytes() == (SAMPLES / "hfsm.json").read_bytes()


@pytest.mark.parametrize("how", ["escape", "leave", "another file", "new"])
def test_it_can_be_left_and_the_window_stays_as_it_is(sit: Sit, how: str) -> None:
    person = begun(sit)
    mended(person)
    callout, ring = tour_of(person).callout, tour_of(person).ring
    if how == "escape":
        person.press(Key.Key_Escape)
    elif how == "leave":
        person.click(callout.leave)
    else:
        person.window.session.history.setClean()
        person.window.files.new() if how == "new" else person.window.open_path(
            SAMPLES / "hfsm.json"
        )
    assert person.window.features.tour.tour is None
    assert not person.window.actions_table["leave_tour"].isEnabled()
    assert not any(isValid(part) and part.isVisible() for part in (callout, ring))
    if how in ("escape", "leave"):
        assert person.steps() == ["Rename to Op_1b"], "the copy stays open"
    # Nothing is to be asked about.
    person.window.session.history.setClean()
    person.window.actions_table["first_steps"].trigger()
    until_step(person, "Find the misprint")


def test_escape_belongs_to_a_question_and_to_a_field_first(sit: Sit) -> None:
    person = begun(sit)
    mended(person)
    person.window.canvas.setFocus()
    person.select("SB1/State_cbb/Op_1b")
    person.press(Key.Key_F2)
    assert person.window.editor.field is not None
    person.press(Key.Key_Escape)
    assert person.window.editor.field is None
    assert person.window.features.tour.tour is not None
    table_run(person)
    person.ctrl(Key.Key_3)
    person.press(Key.Key_F5)
    asking = person.window.features.supervise.pane.step_in.asking
    assert asking.isVisible()
    person.press(Key.Key_Escape)
    assert not asking.isVisible()
    until_step(person, "Unlatch the stop")
    person.press(Key.Key_Escape)
    assert person.window.features.tour.tour is None


def test_what_is_done_another_way_counts_and_what_is_undone_does_not(sit: Sit) -> None:
    person = begun(sit)
    person.press(Key.Key_F3)
    until_step(person, "Correct it")
    person.press(Key.Key_Delete)
    until_step(person, "Bring it back")
    person.ctrl(Key.Key_Z)
    person.window.session.select(())
    until_step(person, "Find the misprint")
    wrong = address("SB1/State_cbb/Op_1c")
    person.window.session.select((wrong,))
    until_step(person, "Correct it")
    person.window.session.edit("Rename", lambda one: editing.rename(one, wrong, "Op_1b"))
    until_step(person, "Run it")
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_2)
    until_step(person, "Back to the drawing")


def test_a_run_that_ended_first_is_run_again(sit: Sit) -> None:
    person = begun(sit)
    mended(person)
    person.ctrl(Key.Key_2)
    transport = run_pane(person).transport
    person.choose(transport.world, "table")
    person.choose(transport.speed, "Max")
    person.press(Key.Key_F5)
    until_step(person, "Run it once more")
    until_points_at(person, transport.play)


def test_it_does_not_begin_while_a_run_goes_on(sit: Sit) -> None:
    person = begun(sit)
    mended(person)
    table_run(person)
    actions = person.window.actions_table
    assert not actions["first_steps"].isEnabled()
    run_of(person).end()
    person.until(lambda: not run_of(person).exists)
    assert actions["first_steps"].isEnabled()


def test_the_callout_follows_its_control_and_the_theme(sit: Sit) -> None:
    person = begun(sit)
    mended(person)
    window = person.window
    for size in ((1920, 1080), (1100, 700)):
        window.resize(*size)
        until_points_at(person, window.mode_bar.run)
    person.windows.set_theme("dark")
    callout = tour_of(person).callout
    picture = callout.grab().toImage()
    assert picture.pixelColor(16, callout.height() - 20).name() == DARK.surf.name()
    assert callout.accessibleName().startswith("Step 3 of 5: Run it.")


def test_each_step_follows_from_what_is_seen() -> None:
    ready = TourState("draw", mended=True)
    stopped = TourState("supervise", mended=True, stopped=True, exists=True, phase="stopped")
    seen: dict[str, TourState] = {
        "Back to the drawing": TourState("run"),
        "Find the misprint": TourState("draw"),
        "Correct it": TourState("draw", chosen=True),
        "Bring it back": TourState("draw", gone=True),
        "Run it": ready,
        "Run it once more": TourState("run", mended=True, finished=True),
        "The world opens": TourState("run", mended=True, exists=True, phase="opening"),
        "Stop it": TourState("run", mended=True, exists=True, phase="running", moves=True),
        "Supervise it": TourState("run", mended=True, stopped=True, exists=True, phase="stopped"),
        "Unlatch the stop": stopped,
        "A run to supervise": TourState("supervise", mended=True, stopped=True),
        "Step in": TourState("supervise", mended=True, stopped=True, exists=True, phase="paused"),
        "That was the whole way": TourState("draw", mended=True, stopped=True, decided=True),
    }
    assert {title: step_of(one).title for title, one in seen.items()} == {t: t for t in seen}
    assert {step.title for step in STEPS} == set(seen)
    moving = TourState("supervise", mended=True, stopped=True, exists=True, phase="running")
    found: TourStep = step_of(moving)
    assert "take_over" in found.controls, "a veto of what moves comes too late"


def test_every_control_of_a_step_is_one_of_the_window(sit: Sit) -> None:
    window = sit(SAMPLES / "hanoi.json").window
    assert window.features.supervise.pane is not None
    names = {name for step in STEPS for name in step.controls}
    assert [name for name in names if not window.controls(name)] == []


def covered(person: Person, widget: QWidget) -> bool:
    """Whether the callout covers some of a widget."""
    body = tour_of(person).callout.geometry().adjusted(10, 10, -10, -10)
    return body.intersects(box(widget, person.window))


def test_a_callout_does_not_cover_what_it_speaks_of(sit: Sit) -> None:
    person = begun(sit)
    person.until(lambda: tour_of(person).is_settled)
    window, found = person.window, person.window.findings.findings[0].address
    place = window.canvas.place_of(found)
    body = tour_of(person).callout.geometry().adjusted(10, 10, -10, -10)
    here = QRect(window.mapFromGlobal(place.topLeft()), place.size())
    assert not here.isEmpty()
    assert not body.intersects(here), "the misprint"
    mended(person)
    table_run(person)
    person.ctrl(Key.Key_3)
    until_step(person, "Unlatch the stop")
    pane = person.window.features.supervise.pane
    person.until(lambda: tour_of(person).is_settled and not covered(person, pane.hold))
    person.press(Key.Key_F5)
    person.press(Key.Key_Return)
    until_step(person, "Step in")
    person.until(lambda: not covered(person, pane.step_in))
    assert not covered(person, pane.board)
