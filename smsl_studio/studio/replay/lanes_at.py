"""The lanes of a whole run, with the blocks lit in which a moment lies."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import replace

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.status import DispatchStatus
from smsl_studio.studio.run.lanes import Lane, lanes
from smsl_studio.studio.run.story import Story


def whole_lanes(blueprint: Blueprint, status: DispatchStatus, story: Story) -> tuple[Lane, ...]:
    """Every lane of a run that is over."""
    return lanes(blueprint, replace(status, running=None, running_since=None), story)


def lit(whole: tuple[Lane, ...], time: float) -> tuple[Lane, ...]:
    """The same lanes; the state and the operation of this moment are lit."""
    return tuple(_lit(lane, time) if lane.kind != "fact" else lane for lane in whole)


def _lit(lane: Lane, time: float) -> Lane:
    at = bisect_right(lane.blocks, time, key=lambda block: block.start) - 1
    block = lane.blocks[at] if at >= 0 else None
    if block is None or block.look != "past" or (block.end is not None and block.end < time):
        return lane
    blocks = (*lane.blocks[:at], replace(block, look="now"), *lane.blocks[at + 1 :])
    return replace(lane, blocks=blocks)
