"""Windows of small screens with large letters: what is the way on is in view, and nothing lies over
something else."""

from __future__ import annotations

from functools import partial
from itertools import combinations
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QLabel, QMenu, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.cli import main
from smsl_studio.studio.features.people.persons_dialog import PersonsDialog
from smsl_studio.studio.features.run.low_page import TIMELINE, WORLD
from smsl_studio.studio.shell.frame import screen_room
from tests.stories.at_supervise import AtSupervise
from tests.stories.at_tasks import NURSE, AtTasks
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.stories.test_inspection_page import answered, page
from tests.stories.test_merge_page import at_page, merged_file
from tests.stories.test_run_small import paused

Key = Qt.Key
PEOPLE, HFSM, HANOI = (
    SAMPLES / f"{name}.json" for name in ("registration-people", "hfsm", "hanoi")
)
LARGE = 1440, 900
LOW, LOWEST = (853, 466), (634, 336)
"""The windows that fill a screen of 1280 x 720 at scale 1.5 and 2."""


@pytest.fixture(autouse=True)
def any_size(monkeypatch: pytest.MonkeyPatch) -> None:
    """Here a window may be smaller than this screen asks for."""
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))


def shrink(person: Person, size: tuple[int, int]) -> None:
    """Make the window as small as on a screen that has no room for more."""
    person.window.resize(*size)
    person.until(lambda: (person.window.width(), person.window.height()) == size)


def at(sit: Sit, file: Path, size: tuple[int, int]) -> Person:
    """Somebody at a window of this size."""
    person = sit(file, LARGE)
    shrink(person, size)
    return person


def is_whole(part: QWidget) -> bool:
    """Whether all of a part is seen."""
    return part.isVisible() and part.visibleRegion().boundingRect().size() == part.size()


@pytest.mark.parametrize("size", [LOW, LOWEST])
def test_give_back_is_in_view_as_long_as_a_person_has_taken_over(
    sit: Sit, size: tuple[int, int]
) -> None:
    person = at(sit, PEOPLE, size)
    supervise = AtSupervise(person)
    step_in = supervise.pane.step_in
    person.press(Key.Key_F5)
    person.until(step_in.hand.isEnabled)
    person.press(Key.Key_T)
    person.until(lambda: "Take over" in supervise.asked)
    person.press(Key.Key_Return)
    supervise.until_phase("Taken over")
    person.until(lambda: is_whole(step_in.hand))
    assert step_in.hand.text().startswith("Give back")
    person.click(step_in.hand)
    person.until(lambda: "Give back" in supervise.asked)
    person.until(lambda: is_whole(step_in.asking.do))
    person.press(Key.Key_Escape)
    person.window.resize(*LARGE)
    person.until(lambda: step_in.isAncestorOf(step_in.hand) and is_whole(step_in.hand))
    assert step_in.hand.y() > step_in.veto.y(), "its place is below the other two"


@pytest.mark.parametrize("size", [LOW, LOWEST])
def test_where_nobody_is_entered_the_button_for_that_is_in_view(
    sit: Sit, size: tuple[int, int]
) -> None:
    person = at(sit, PEOPLE, size)
    room = AtTasks(person)
    room.start()
    person.until(lambda: room.card.card is not None)
    enter = room.card.answer.enter
    person.until(lambda: is_whole(enter))
    person.click(enter)
    person.until(lambda: bool(person.window.findChildren(PersonsDialog)))
    person.window.findChildren(PersonsDialog)[0].close()
    person.come_back()
    person.window.resize(*LARGE)
    person.until(lambda: room.card.answer.isAncestorOf(enter) and is_whole(enter))
    assert enter.y() > room.card.answer.who.y()


@pytest.mark.parametrize("size", [(1280, 800), (1272, 692), (960, 572)])
def test_what_decides_is_in_view_without_scrolling(sit: Sit, size: tuple[int, int]) -> None:
    """The button lay below the persons who must answer, under the edge of 1280 x 800."""
    person = at(sit, PEOPLE, size)
    room = AtTasks(person)
    room.start()
    person.until(lambda: room.card.card is not None)
    person.until(lambda: is_whole(room.card.answer.enter))
    room.person.windows.persons.put(NURSE)
    room.answer_as(NURSE)
    first = room.card.options[0]
    person.until(lambda: is_whole(room.card.answer.who.choice) and is_whole(first))
    button = room.card.answer.button
    if size[1] > 600:
        person.until(lambda: is_whole(button))
    room.choose(first.option.words)
    person.until(lambda: is_whole(button) and button.isEnabled())


def test_the_word_for_the_run_has_room_beside_four_modes(sit: Sit, tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    assert main(["run", str(HFSM), "--world", "table", "--log", str(log)]) == 0
    person = sit(HFSM, LARGE)
    person.window.open_path(log)
    segments = person.window.mode_bar.segments
    person.until(lambda: segments.buttons["mode_replay"].isVisible())
    supervise = AtSupervise(person)
    person.press(Key.Key_F5)
    supervise.until_phase("Goal reached")
    shrink(person, LOWEST)
    phase = supervise.pane.bar.phase
    person.until(lambda: is_whole(phase))
    assert phase.text() == "●  At goal" or phase.text() == "At goal"
    assert is_whole(supervise.pane.bar.stop)
    shown = [button for button in segments.buttons.values() if not button.isHidden()]
    assert len(shown) == 4
    assert all(is_whole(button) for button in shown)


@pytest.mark.parametrize("size", [(960, 540), LOW, LOWEST])
def test_world_start_and_goal_are_chosen_in_a_narrow_window(
    sit: Sit, size: tuple[int, int]
) -> None:
    """Where the row has no room for them they were gone, without a way to them."""
    person = at(sit, HFSM, size)
    person.ctrl(Key.Key_2)
    transport = person.window.features.run.pane.transport
    person.until(lambda: transport.isVisible() and transport.world.count() > 0)
    more = transport.more
    person.until(lambda: is_whole(more) or is_whole(transport.goal))
    if not more.isVisible():
        return
    more.menu().aboutToShow.emit()
    titles = [entry.text() for entry in more.menu().actions()]
    assert [title.split(":")[0] for title in titles[:4]] == ["World", "Start", "Goal", "Speed"]
    world, start = (entry.menu() for entry in more.menu().actions()[:2])
    assert isinstance(world, QMenu)
    assert isinstance(start, QMenu)
    entry = next(one for one in world.actions() if one.text() == "table")
    entry.trigger()
    assert transport.world.currentText() == "table"
    start.actions()[-1].trigger()
    assert transport.start.currentIndex() == transport.start.count() - 1
    assert is_whole(transport.stop)


@pytest.mark.parametrize("size", [LOW, LOWEST])
def test_how_to_begin_a_run_is_read_whole(sit: Sit, size: tuple[int, int]) -> None:
    person = at(sit, HFSM, size)
    notice = AtSupervise(person).pane.notice
    person.until(notice.isVisible)
    for part in (*notice.findChildren(QLabel), notice.begin):
        person.until(partial(is_whole, part))
        assert part.height() >= part.heightForWidth(part.width())


def test_the_active_state_is_whole_beside_a_question(sit: Sit) -> None:
    person = at(sit, PEOPLE, LOWEST)
    room = AtTasks(person)
    person.until(AtSupervise(person).pane.notice.isVisible)
    room.start()
    person.until(lambda: room.card.card is not None)
    board = AtSupervise(person).pane.board
    person.until(board.isVisible)
    assert board.height() >= 140, "its state is cut otherwise"


def test_in_the_lowest_run_page_the_timeline_and_the_world_are_tabs_that_are_whole(
    sit: Sit,
) -> None:
    person = sit(HFSM, LARGE)
    pane, body = paused(person).pane, person.window.body
    shrink(person, LOWEST)
    lists = pane.facts_place.lists
    person.until(lambda: lists.names[-2:] == (WORLD, TIMELINE))
    for name, part in ((TIMELINE, pane.timeline), (WORLD, pane.scene), ("Facts", pane.facts)):
        lists.show_page(name)
        person.until(partial(is_whole, part))
    last = lists.bar.tabRect(lists.bar.count() - 1)
    assert lists.bar.rect().contains(last), "no tab is beside the window"
    assert is_whole(lists.bar)
    assert body.verticalScrollBar().maximum() == 0, "nothing lies below the edge"
    assert body.horizontalScrollBar().maximum() == 0
    person.window.resize(*LARGE)
    person.until(lambda: lists.names == ("Possible now", "Events"))
    person.until(lambda: is_whole(pane.timeline) and is_whole(pane.scene))
    assert top(pane, pane.timeline) > top(pane, pane.canvas)
    assert top(pane, pane.scene) < top(pane, lists)


def test_the_timeline_shows_states_and_operations_at_every_height(sit: Sit) -> None:
    """In a window that fills a screen of 1920 x 1080 at scale 2 only the states were seen."""
    person = sit(HFSM, LARGE)
    pane = paused(person).pane
    for size in ((960, 572), (953, 540), (960, 515), LOW, LOWEST):
        shrink(person, size)
        if pane.low_page.tabbed:
            pane.facts_place.lists.show_page(TIMELINE)
        person.until(pane.timeline.isVisible)
        person.until(lambda: pane.timeline.visibleRegion().boundingRect().height() >= 90)


@pytest.mark.parametrize("size", [(960, 515), (960, 572), LOW, LOWEST])
def test_what_may_be_done_with_a_stopped_run_is_whole(sit: Sit, size: tuple[int, int]) -> None:
    """In a window that fills a screen of 1280 x 720 at scale 1.5 the buttons were cut."""
    person = sit(HFSM, LARGE)
    run = paused(person)
    shrink(person, size)
    person.press(Key.Key_F8)
    person.until(lambda: run.pane.run.phase == "stopped")
    person.until(lambda: len(run.pane.possible.hold.buttons()) == 2)
    for button in run.pane.possible.hold.buttons():
        person.until(partial(is_whole, button))


def top(pane: QWidget, part: QWidget) -> int:
    return part.mapTo(pane, QPoint(0, 0)).y()


def chosen(person: Person) -> QRect:
    """The place of the selected element in the view."""
    canvas = person.window.canvas
    rect = canvas.rect_of(person.window.session.selection[0])
    assert rect is not None
    return canvas.mapFromScene(rect).boundingRect()


@pytest.mark.parametrize("size", [LOW, LOWEST])
def test_the_card_of_a_finding_does_not_lie_on_what_it_is_about(
    sit: Sit, size: tuple[int, int]
) -> None:
    person = at(sit, HANOI, size)
    canvas, card = person.window.canvas, person.window.fix_card
    person.until_inspected()
    checked = 0
    for zoom in (0.4, 0.8, 1.2):
        canvas.zoom_to(zoom)
        for _ in range(3):
            person.press(Key.Key_F3)
            if not any(one.operation for one in person.window.session.selection):
                continue
            person.until(card.isVisible)
            person.until(lambda: not chosen(person).intersects(card.geometry()))
            person.until(lambda: canvas.viewport().rect().contains(chosen(person)))
            assert canvas.rect().contains(card.geometry())
            checked += 1
    assert checked == 6, "two findings, each at three zooms"


def test_in_the_lowest_window_the_page_inspection_has_whole_tabs_and_buttons(sit: Sit) -> None:
    person = at(sit, SAMPLES / "registration-drilling.json", LOWEST)
    panel, tabs = person.window.features.inspection.panel, person.window.docks.bottom_tabs
    person.ctrl(Key.Key_I)
    run = panel.run
    person.until(lambda: run.isVisible() and not run.walk.visibleRegion().isEmpty())
    buttons = run.walk, run.back, run.step, run.save, run.play
    person.until(lambda: all(one.width() >= one.sizeHint().width() for one in buttons))
    for button in buttons:
        assert button.accessibleName()
        assert run.rect().contains(button.geometry())
    bar = tabs.bar
    assert bar.rect().contains(bar.tabRect(0))
    assert bar.tabRect(bar.count() - 1).right() - 3 <= bar.rect().right(), "but its margin"
    canvas = person.window.canvas
    assert canvas.height() < 140, "the drawing is low"
    assert canvas.overlays.zoom.isHidden(), "so nothing floats over it"
    shrink(person, LARGE)
    person.until(lambda: not canvas.overlays.zoom.isHidden())
    person.until(lambda: run.save.text() == "Save script…")


def test_beside_the_page_inspection_the_path_covers_no_state(sit: Sit) -> None:
    """In the lowest window it lay on half of the state that was found."""
    person = at(sit, HANOI, LOWEST)
    canvas, crumb = person.window.canvas, person.window.canvas.overlays.breadcrumb
    canvas.camera.motion = False
    person.ctrl(Key.Key_I)
    person.until(lambda: canvas.height() < 140)
    for state in ("State_ccb", "State_aca", "State_bbb"):
        person.window.session.jump(Address("SB1", state))
        person.until(lambda: canvas.viewport().rect().intersects(chosen(person)))
        assert not chosen(person).intersects(crumb.geometry()), state
    person.ctrl(Key.Key_I)
    shrink(person, LARGE)
    canvas.fit(smooth=False)
    assert canvas.rect().contains(crumb.geometry())


@pytest.mark.parametrize("size", [LOW, LOWEST])
def test_one_row_of_the_page_inspection_is_whole(sit: Sit, size: tuple[int, int]) -> None:
    person = at(sit, SAMPLES / "registration-drilling.json", size)
    person.ctrl(Key.Key_I)
    table = page(person).table
    person.until(lambda: table.isVisible() and table.claims.rowCount() > 0)

    def whole() -> bool:
        return table.viewport().rect().contains(table.visualRect(table.currentIndex()))

    person.until(lambda: table.currentIndex().isValid() and whole())
    shrink(person, LARGE)
    person.until(lambda: not table.horizontalHeader().isHidden())


def test_in_a_low_panel_the_facts_have_the_room(sit: Sit) -> None:
    person = sit(HANOI, LARGE)
    panel = person.window.facts
    shrink(person, LOWEST)
    person.ctrl(Key.Key_T)
    person.until(panel.isVisible)
    for height in (336, 400, 466, 560, 700, 900):
        shrink(person, (1000, height))
        if not panel.isVisible():
            person.ctrl(Key.Key_T)
        person.until(lambda: panel.isVisible() and nothing_overlaps(panel))
        assert panel.add.isVisible() == panel.hint.isVisible()
    assert panel.add.isVisible(), "in a high window it is there"


def nothing_overlaps(panel: QWidget) -> bool:
    """Whether each part of a panel has its own place, in the panel."""
    parts = [getattr(panel, name) for name in ("words", "view", "add", "hint")]
    places = [part.geometry() for part in parts if part.isVisible()]
    apart = not any(one.intersects(other) for one, other in combinations(places, 2))
    return apart and all(panel.rect().contains(place) for place in places)


def test_what_may_be_written_on_the_page_inspection_is_not_squeezed(sit: Sit) -> None:
    person = at(sit, HANOI, (720, 380))
    answered(person)
    person.ctrl(Key.Key_I)
    title = page(person).empty.title
    person.until(title.isVisible)
    around = title.parentWidget()
    assert around is not None
    for part in around.findChildren(QLabel):
        assert part.height() >= part.heightForWidth(part.width())


@pytest.mark.parametrize("size", [LOW, LOWEST])
def test_the_drawing_of_a_recording_is_in_view(
    sit: Sit, tmp_path: Path, size: tuple[int, int]
) -> None:
    log = tmp_path / "run.jsonl"
    assert main(["run", str(HFSM), "--world", "table", "--log", str(log)]) == 0
    person = at(sit, HFSM, size)
    person.window.open_path(log)
    pane = person.window.features.replay.verbs.pane
    person.until(pane.isVisible)
    page = person.window.body
    seen = QRect(page.viewport().mapToGlobal(QPoint(0, 0)), page.viewport().size())
    view = pane.canvas.canvas

    def drawn() -> bool:
        nodes = [view.rect_of(Address("SB1", state)) for state in ("State000", "State111")]
        return all(one is not None and seen.contains(view.screen_rect(one)) for one in nodes)

    person.until(drawn)


def test_a_conflict_is_read_and_chosen_in_the_lowest_window(sit: Sit, tmp_path: Path) -> None:
    person = at(sit, merged_file(tmp_path), LOWEST)
    merging = at_page(person)
    mine = merging.list.cards[0].buttons["ours"]
    person.until(lambda: is_whole(mine))
    person.click(mine)
    assert mine.isChecked()


def test_the_library_leaves_out_its_hint_where_it_would_be_cut(sit: Sit) -> None:
    person = sit(HFSM, LARGE)
    library = person.window.library
    person.window.show_tab("Library")
    person.until(lambda: is_whole(library.hint))
    shrink(person, LOWEST)
    person.window.show_tab("Library")
    person.until(library.list.isVisible)
    assert not library.hint.isVisible()
    person.window.resize(*LARGE)
    person.until(lambda: is_whole(library.hint))
