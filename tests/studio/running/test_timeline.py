"""The timeline: blocks that are too narrow, and room for words at its end."""

from __future__ import annotations

from pytestqt.qtbot import QtBot

from smsl_studio.front.views.timeline_lanes import Block, Lane
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running.lane_blocks import seen_blocks, words_width
from smsl_studio.studio.running.timeline import Timeline


def test_a_block_too_narrow_to_see_hides_none_that_follows_it() -> None:
    blocks = [Block(0.0, 1.0, "a", "past"), *(Block(1.0, 1.0, "b", "past"),) * 3,
              Block(1.0, 9.0, "c", "past"), Block(9.0, None, "d", "now")]  # fmt: skip
    starts = [block.start for block in blocks]
    assert list(seen_blocks(blocks, starts, 0.0, 10.0, 0.1)) == [0, 1, 4, 5]


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
    assert (right - 60.02) / (right - left) * box.width() >= words_width("state", "ccccccccc")


LONG = "Op_that_takes_the_disk_from_the_left_to_the_right"


def test_words_of_what_ended_long_ago_stand_behind_nothing(qtbot: QtBot) -> None:
    timeline = Timeline(LIGHT)
    qtbot.addWidget(timeline)
    timeline.resize(1200, 160)
    timeline.show()

    def room_behind(end: float) -> float:
        """The part of the time that is kept free for words behind the last operation."""
        blocks = (Block(0.0, 50.0, "Op_3c", "past"), Block(end - 0.02, end, LONG, "past"))
        timeline.show_lanes((Lane("Operation", "operation", blocks),), 60.0)
        timeline.follow()
        (left, right), _ = timeline.plot.getViewBox().viewRange()
        return float((right - 60.0) / (right - left))

    needed = words_width("operation", LONG)
    assert room_behind(60.0) * timeline.plot.getViewBox().width() >= needed
    assert room_behind(55.0) < room_behind(60.0) / 2
