"""The parts of Supervise: what is shown by itself, what a person hides, and what is chosen."""

from __future__ import annotations

from itertools import pairwise

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.partial import partial_view
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.supervise.columns import NARROWEST, STACKED, stacked_columns
from smsl_studio.studio.features.supervise.seen_parts import GRAPH, NAMES, SCENE, TEXT, SeenParts
from smsl_studio.studio.features.supervise.text_panel import TextPanel
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.world_pane import WorldPane
from smsl_studio.world.protocol import Shape
from tests.front.views.statuses import sample, status

SAMPLE = sample("hanoi-2.json")
EDGE = Address("SB1", "State_ba", "Op_2c")
HERE = status({"SB1": "State_ba"}, route=(EDGE,))


@pytest.fixture
def run() -> RunSession:
    made = RunSession()
    made.blueprint, made.status = SAMPLE, HERE
    return made


def parts(run: RunSession, qtbot: QtBot) -> SeenParts:
    made = SeenParts(run, QWidget(), TextPanel(LIGHT), WorldPane(run, LIGHT, watches=True), LIGHT)
    qtbot.addWidget(made)
    made.resize(900, 500)
    made.show()
    return made


def test_text_and_scene_come_by_themselves_with_a_picture_where_there_is_room(
    run: RunSession, qtbot: QtBot
) -> None:
    made = parts(run, qtbot)
    assert [*made.shown] == [GRAPH]
    run.shapes = (Shape("thing", (), (1.0, 0.0, 0.0)),)
    made.fit()
    assert [*made.shown] == [*NAMES]
    made.resize(700, 500)
    assert [*made.shown] == [GRAPH]


def test_each_part_can_be_hidden_but_the_last_one_and_that_is_remembered(
    run: RunSession, qtbot: QtBot
) -> None:
    made, told = parts(run, qtbot), list[str]()
    made.remember = told.append
    made.choices[SCENE].trigger()
    assert [*made.shown] == [GRAPH, SCENE]
    assert made.scene.isVisible()
    made.choices[GRAPH].trigger()
    assert [*made.shown] == [SCENE]
    assert not made.choices[SCENE].isEnabled()
    assert told == [f"{GRAPH},{SCENE}", SCENE]
    again = parts(run, qtbot)
    again.restore(told[0])
    assert [*again.shown] == [GRAPH, SCENE]
    again.restore("nonsense,")
    assert [*again.shown] == [GRAPH]


def test_the_partial_view_goes_to_a_window_of_its_own_and_comes_back(
    run: RunSession, qtbot: QtBot
) -> None:
    made = parts(run, qtbot)
    made.apart.trigger()
    assert made.own is not None
    graph = made.graph
    assert graph.window() is made.own
    qtbot.addWidget(made.own)
    assert made.own.isVisible()
    assert [*made.shown] == [TEXT, SCENE], "the place that is left is used"
    assert not made.own.stop.isEnabled(), "nothing runs"
    made.own.close()
    assert made.own is None
    assert not made.apart.isChecked()
    assert [*made.shown] == [GRAPH]
    assert graph.window() is made.window()
    assert graph.isVisible()


def test_without_a_picture_the_scene_shows_the_facts_as_tiles(
    run: RunSession, qtbot: QtBot
) -> None:
    made = parts(run, qtbot)
    made.restore(SCENE)
    made.refresh()
    assert made.scene.shows_tiles


def test_the_proposed_line_is_marked_and_a_click_on_a_line_chooses_its_operation(
    qtbot: QtBot,
) -> None:
    panel, chosen = TextPanel(LIGHT), list[Address]()
    qtbot.addWidget(panel)
    panel.resize(400, 200)
    panel.show()
    panel.chosen.connect(chosen.append)
    panel.show_state(SAMPLE, partial_view(SAMPLE, HERE, "SB1"), EDGE, at_work=False)
    items = [panel.list.item(at) for at in range(panel.list.count())]
    assert [item.text() for item in items] == [
        "   7      State_ba: [",
        "   8          Op_1a -> State_aa,",
        "   9          Op_1c -> State_ca,",
        "  10          Op_2c -> State_bc",
        "  11      ],",
    ]
    assert [item.toolTip() for item in items] == ["", "", "", f"{EDGE} is proposed", ""]
    at = panel.list.visualItemRect(items[1]).center()
    QTest.mouseClick(panel.list.viewport(), Qt.MouseButton.LeftButton, pos=at)
    QTest.mouseClick(
        panel.list.viewport(),
        Qt.MouseButton.LeftButton,
        pos=panel.list.visualItemRect(items[0]).center(),
    )
    assert chosen == [Address("SB1", "State_ba", "Op_1a")]
    panel.turned.connect(
        lambda: panel.show_state(SAMPLE, partial_view(SAMPLE, HERE, "SB1"), EDGE, at_work=True)
    )
    panel.tabs[1].click()
    told = [panel.list.item(at).toolTip() for at in range(panel.list.count())]
    assert f"{EDGE} is running" in told


@pytest.mark.parametrize("width", [STACKED, 424, 500, NARROWEST - 1])
def test_stacked_columns_lie_beside_each_other_in_the_view(width: int) -> None:
    found = stacked_columns(width, (108.0, 140.0, 108.0))
    assert found.previous == found.current
    ends = [found.current, found.cards, found.neighbours, (float(width), 0.0)]
    for (x, wide), (following, _) in pairwise(ends):
        assert x + wide < following
    assert found.cards[1] >= 178
