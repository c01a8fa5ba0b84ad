"""The look of Supervise: nothing overlaps in any size; the text is highlighted; several SBs."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QWidget

from tests.stories.at_supervise import AtSupervise
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES
from tests.stories.test_files import copy_of

Key = Qt.Key
REGISTRATION = SAMPLES / "registration-digitization.json"
HANOI = SAMPLES / "hanoi-corrected.json"


def _boxes(at: AtSupervise) -> list[tuple[str, QRect]]:
    """The boxes of cards and states, where they stand on the board."""
    board, inner = at.pane.board, at.pane.board.inner
    found = []
    for widget in (*board.cards, *board.spots):
        rect = QRect(widget.mapTo(inner, widget.rect().topLeft()), widget.size())
        inset = (3, 3, -3, -3) if widget in board.cards else (26, 26, -26, -64)
        found.append((widget.accessibleName(), rect.adjusted(*inset)))
    return found


@pytest.mark.parametrize("size", [(1280, 800), (1440, 900), (1920, 1080)])
def test_no_card_and_no_state_lies_over_another(sit: Sit, size: tuple[int, int]) -> None:
    at = AtSupervise(sit(REGISTRATION, size))
    at.start_paused()
    boxes = _boxes(at)
    assert len(boxes) >= 8
    for (one, here), (other, there) in itertools.combinations(boxes, 2):
        assert not here.intersects(there), f"{one} lies over {other}"
    inner = at.pane.board.inner
    assert all(inner.rect().contains(box) for _, box in boxes)
    legend = next(w for w in inner.findChildren(QWidget) if w.accessibleName().startswith("Legend"))
    if legend.isVisible():
        assert not any(legend.geometry().intersects(box) for _, box in boxes)


def test_twenty_operations_scroll_and_the_active_state_stays_in_sight(
    sit: Sit, tmp_path: Path
) -> None:
    states = [f"State_{n:05b}" for n in range(32)]
    table: dict[str, dict[str, object]] = {name: {"Op_Home": states[31]} for name in states}
    table[states[0]] = {f"Operation_of_a_rather_long_name_{n}": states[n] for n in range(1, 21)}
    header = {"NUM_FACTS": 5, "INITIAL": states[0], "ACTIVATING": states[31]}
    path = tmp_path / "twenty.json"
    path.write_text(json.dumps({"SB1": {"HEADER": header, **table}}), "utf-8")
    at = AtSupervise(sit(path, (1280, 800)))
    at.person.ctrl(Key.Key_2)
    at.person.choose(at.person.window.features.run.pane.transport.world, "table")
    at.person.click(at.person.window.features.run.pane.transport.by_hand)
    at.person.ctrl(Key.Key_3)
    at.press(Key.Key_F5)
    at.until_phase("Ready")
    at.person.qtbot.waitUntil(lambda: len(at.pane.board.cards) == 20)
    board = at.pane.board
    board.cards[0].setFocus()
    at.press(*[Key.Key_Down] * 19)
    last = board.cards[19]
    assert last.hasFocus()
    seen = board.viewport().rect()
    assert seen.contains(QRect(last.mapTo(board.viewport(), last.rect().topLeft()), last.size()))
    active = next(s for s in board.spots if s.accessibleName().startswith("active state"))
    middle = active.mapTo(board.viewport(), active.rect().center())
    assert seen.contains(middle)
    at.press(Key.Key_Return)
    assert "number" not in at.asked
    assert "Operation_of_a_rather_long_name_20" in at.asked


def test_the_operation_that_waits_below_the_others_is_scrolled_into_view(
    sit: Sit, tmp_path: Path
) -> None:
    states = [f"State_{n:04b}" for n in range(14)]
    table: dict[str, dict[str, object]] = {name: {"Home": states[13]} for name in states}
    table[states[0]] = {f"Way_{n}": states[n] for n in range(1, 13)}
    notes = {f"Way_{n}": {"cost": 9} for n in range(1, 12)} | {"Way_12": {"confirm": ["anybody"]}}
    header = {"NUM_FACTS": 4, "INITIAL": states[0], "ACTIVATING": states[13]}
    path = tmp_path / "ways.json"
    values = {"SB1": {"HEADER": header, "_operations": notes, **table}}
    path.write_text(json.dumps(values), "utf-8")
    at = AtSupervise(sit(path, (1280, 800)))
    at.person.ctrl(Key.Key_2)
    at.person.choose(at.person.window.features.run.pane.transport.world, "table")
    at.person.ctrl(Key.Key_3)
    at.press(Key.Key_F5)
    at.until_phase("Waiting for a human")
    board = at.pane.board

    def is_seen() -> bool:
        """Whether the last card is wholly in view."""
        last = board.cards[-1]
        corner = last.mapTo(board.viewport(), last.rect().topLeft())
        return board.viewport().rect().contains(QRect(corner, last.size()))

    at.person.qtbot.waitUntil(is_seen)
    board.verticalScrollBar().setValue(0)
    at.person.qtbot.waitUntil(lambda: not is_seen())
    at.press(Key.Key_9)
    board.verticalScrollBar().setValue(0)
    at.press(Key.Key_Escape, Key.Key_9)
    ninth = board.cards[8]
    at.person.qtbot.waitUntil(lambda: not ninth.visibleRegion().isEmpty())


def test_the_active_state_is_lit_in_the_text_while_a_run_exists(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    at.until_in("State_caa")
    at.person.ctrl(Key.Key_1)
    at.person.ctrl(Key.Key_U)
    source = at.person.window.source
    at.person.until(lambda: bool(source.editor.gutter.active))
    lines = at.person.blueprint.document.text.splitlines()
    lit = [lines[line] for line in sorted(source.editor.gutter.active)]
    assert '"State_caa"' in lit[0]
    at.run.stop()
    at.until_phase("Stopped")
    at.run.end()
    at.person.until(lambda: not source.editor.gutter.active)


def test_several_sbs_one_of_them_is_shown_the_one_that_is_chosen_or_where_it_goes_on(
    sit: Sit,
) -> None:
    at = AtSupervise(sit(REGISTRATION))
    at.start_paused()
    assert [b.accessibleName() for b in at.pane.head.branches()] == ["REGISTRATION", "DIGITIZATION"]
    assert at.pane.view is not None
    assert at.pane.view.branch == "REGISTRATION"
    at.person.click(at.pane.head.branches()[1])
    assert at.pane.view.branch == "DIGITIZATION"
    assert at.pane.head.branches()[1].isChecked()
    assert at.pane.check.words.startswith("State1 ")


def test_the_check_has_the_paper_s_form_and_every_source(sit: Sit) -> None:
    at = AtSupervise(sit(REGISTRATION))
    at.start_paused()
    table = at.pane.check.table.model()
    words = [str(table.index(row, 4).data()) for row in range(table.rowCount())]
    assert words == ["table_REGISTRATION_0", "DIGITIZATION in State1", "table_REGISTRATION_2"]
    tips = [w.toolTip() for w in at.pane.check.findChildren(QWidget) if "lambda s:" in w.toolTip()]
    assert tips
    assert "f1(s): true, Landmarks planned reads 1" in tips[0]


def is_whole(button: QPushButton) -> bool:
    """Whether nothing of a button's words is cut off by its padding and its frame."""
    words = button.text().replace("&&", "&")
    return button.fontMetrics().horizontalAdvance(words) + 26 <= button.width()


@pytest.mark.parametrize("width", [1440, 1280])
def test_the_buttons_of_a_question_have_their_whole_words(
    sit: Sit, tmp_path: Path, width: int
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    long = "OperationThatBringsThePatientToWhereTheToolCanReachTheTargetUnderTheSkin"
    path.write_text(path.read_text().replace("Operation100B", long))
    at = AtSupervise(sit(path, (width, 900)))
    at.start_paused()
    asking = at.pane.step_in.asking
    at.press(at.number("Operation100A"))
    at.person.until(lambda: is_whole(asking.do))
    assert asking.do.text() == "Carry out Operation100A"
    assert is_whole(asking.leave)
    at.press(at.number(long))
    assert asking.do.accessibleName() == f"Carry out {long}"
    assert "…" in asking.do.text()
    assert long in asking.do.toolTip()
    at.person.until(lambda: is_whole(asking.do) and is_whole(asking.leave))
    assert asking.rect().contains(asking.do.geometry())
    assert asking.do.geometry().bottom() < asking.leave.geometry().top()


def test_what_is_offered_while_a_run_holds_has_its_whole_words(sit: Sit) -> None:
    at = AtSupervise(sit(SAMPLES / "hfsm.json"))
    at.start_paused()
    for name in ("Operation100A", "Operation100B"):
        at.press(at.number(name), Key.Key_P)
        at.person.type("x")
        at.press(Key.Key_Return)
        at.until_stands(name, "pruned")
    at.press(Key.Key_F5)
    at.until_phase("No route")
    buttons = at.pane.hold.buttons()
    assert "Restore Operation100B" in [button.text() for button in buttons]
    at.person.until(lambda: all(map(is_whole, buttons)))


def test_the_large_layout_has_few_words_and_is_remembered(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI, (1280, 800)))
    at.start_paused()
    seen = at.pane.seen
    seen.restore("Partial view,Text,Scene")
    at.pane.refresh()
    at.person.until(lambda: at.pane.scene.isVisible() and at.pane.board.cards[0].isVisible())
    low, wide = at.pane.text.height(), at.pane.board.width()
    at.person.window.resize(1920, 1080)
    at.person.until(lambda: at.pane.text.height() > low + 60 and at.pane.board.width() > wide + 60)
    at.person.window.resize(1280, 800)
    at.person.until(lambda: at.pane.text.height() < low + 3 and at.pane.board.width() < wide + 3)
    parts = at.pane.board, at.pane.text, at.pane.scene
    sizes = [one.size() for one in parts]
    at.press(Key.Key_W)
    assert at.pane.large.isVisible()
    assert at.pane.large.words.state == "State_caa"
    hidden = (at.pane.board, at.pane.text, at.pane.below, at.pane.forecast)
    assert not any(one.isVisible() for one in hidden)
    assert at.pane.step_in.veto.isVisible()
    assert at.pane.bar.stop.isVisible()
    at.press(Key.Key_W)

    def as_before() -> bool:
        """But for a pixel, which a splitter may give to either part."""
        now = [one.size() for one in parts]
        pairs = zip(now, sizes, strict=True)
        return all(max(abs(a.width() - b.width()), abs(a.height() - b.height())) <= 2
                   for a, b in pairs)  # fmt: skip

    at.person.until(as_before)
    at.press(Key.Key_W)
    again = sit(HANOI, (1280, 800))
    again.ctrl(Key.Key_3)
    large = again.window.features.supervise.pane
    assert large.is_large
    again.window.actions_table["large_supervise"].trigger()
    assert not large.is_large
    assert large.below.isVisible()
    assert large.notice.isVisible()


def test_what_is_chosen_in_one_part_is_chosen_in_all(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI, (1440, 900)))
    at.start_paused()
    pane = at.pane
    pane.seen.restore("Partial view,Text,Scene")
    pane.refresh()
    fact = frozenset({("SB1", 1)})
    tiles = pane.scene.tiles
    assert tiles.isVisible(), "the table has no picture"
    center = tiles.visualRect(tiles.tiles.index(1)).center()
    QTest.mouseClick(tiles.viewport(), Qt.MouseButton.LeftButton, pos=center)
    assert pane.facts.keys == fact
    assert tiles.painter.chosen == fact

    def marked() -> list[str]:
        tips = [pane.text.list.item(row).toolTip() for row in range(pane.text.list.count())]
        return [tip for tip in tips if "changes" in tip or "proposed" in tip]

    assert marked() == ["SB1/State_caa/Op_2b is proposed"], "which changes the fact, too"
    # A state in the graph shows its facts.
    spot = next(s for s in pane.board.spots if "State_aaa" in s.accessibleName())
    QTest.mouseClick(spot, Qt.MouseButton.LeftButton, pos=spot.rect().center())
    assert pane.facts.keys == {("SB1", 0)}
    assert "SB1/State_caa/Op_1a changes Fact 1" in marked()
    # A row of the state check, and again for nothing.
    table = pane.check.table
    for chosen in (fact, frozenset()):
        place = table.visualRect(table.model().index(1, 0)).center()
        QTest.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=place)
        assert pane.facts.keys == chosen
    at.press(at.number("Op_1b"))
    assert pane.facts.keys == {("SB1", 0)}, "an operation shows what it changes"
    at.press(Key.Key_Escape)
    assert not pane.facts.keys
    at.press(at.number("Op_1b"))
    assert pane.facts.keys
    at.press(Key.Key_Return)
    assert not pane.facts.keys, "no longer than the question"
