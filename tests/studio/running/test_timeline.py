"""The timeline: blocks that are too narrow, and room for words at its end."""

from __future__ import annotations

from pytestqt.qtbot import QtBot

from smsl_studio.front.views.timeline_lanes import Block, Lane
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running.timeline import Timeline, _seen, _wide


def test_a_block_too_narrow_to_see_hides_none_that_follows_it() -> None:
    blocks = [Block(0.0, 1.0, "a", "past"), *(Block(1.0, 1.0, "b", "past"),) * 3,
              Block(1.0, 9.0, "c", "past"), Block(9.0, None, "d", "now")]  # fmt: skip
    starts = [block.start for block in blocks]
    assert list(_seen(blocks, starts, 0.0, 10.0, 0.1)) == [0, 1, 4, 5]


def test_the_goal_of_a_long_run_has_room_for_its_words(qtbot: QtBot) -> None:
    timeline = Timeline(LIGHT)
    qtbot.addWidget(timeline)
    timeline.resize(1200, 160)
    timeline.show()
    blocks = (Block(0.0, 60.0, "acc", "past"), Block(60.0, 60.02, "ccccccccc", "past"))
    timeline.show_lanes((Lane("State", "state", blocks),), 60.02)
    timeline.follow()
    box = timeline.plot.getViewBox()
    (left, right), _ = box.viewRange()
    assert (right - 60.02) / (right - left) * box.width() >= _wide("state", "ccccccccc")
