"""Two chess pieces in physics: star and circle move on nine blocks, and one may stand on the other
(an example of task families from publications of the paper's authors).

Each fact is the place of a piece in two characters: its block (A B C D a c d 0 1) and its layer,
``B`` on the block and ``T`` on top of the other piece. A piece in the hand reads ``hh``; one that
stands nowhere reads ``xx``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Mapping
from typing import TYPE_CHECKING

from smsl_studio.world.arms.panda import ARM
from smsl_studio.world.grasps import move
from smsl_studio.world.mishaps import Fault, drop, grease, one_of, seize, topple

from .board import (
    BLOCKS,
    GROUND,
    HEIGHT,
    HELD,
    NEAR,
    NOWHERE,
    PIECES,
    PITCH,
    PLACES,
    Board,
    case_of,
    stations_of,
)
from .sensors import register_sensors

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.library.operation_library import OperationLibrary
    from smsl_studio.world.bullet import BulletWorld

Work = Generator[None, None, bool]


def bring(board: Board, piece: str, block: str) -> Work:
    """Move a piece to the next block, or onto the piece that stands there. Return False if the
    block is further away, if the other piece stands on it, if it lies, or if the grasp fails.

    A piece that stands there already is not moved. Nothing moves while the hand holds the other.
    """
    reading = board.reading(piece)
    if reading[0] == block:
        return True
    if board.reading(board.other(piece)) == HELD:
        return False
    if reading == NOWHERE or block not in NEAR.get(reading[0], ()) or not board.is_free(piece):
        return False
    place = board.place_on(piece, block)
    return (yield from move(board.world, piece, board.grasp(piece, place), place))


def step(piece: str, block: str) -> Callable[[Board], Work]:
    """Return the function of the operation that moves a piece to a block."""

    def carried(board: Board) -> Work:
        return (yield from bring(board, piece, block))

    return carried


def gripper_opens(board: Board, after: float = 0.6, seconds: float = 0.3) -> Fault:
    """The fingers open a given time (s) after a piece was gripped, and stay open for a while."""
    yield from drop(board.world, PIECES, after, seconds)


def slippery(board: Board, piece: int = 0, friction: float = 0.005) -> None:
    """A piece (1 the star, 2 the circle, 0 both) gets a low friction."""
    grease(board.world, PIECES, piece, friction)


def toppled(board: Board, piece: int) -> None:
    """A piece lies where it stood."""
    topple(board.world, PIECES, piece)


def beside(board: Board, piece: int) -> None:
    """A piece stands beside the other one, at a corner of its block: seen from above, both are on
    one block."""
    name = one_of(PIECES, piece)
    x, y, _ = board.middle(board.other(name))
    block = min(BLOCKS.values(), key=lambda at: math.dist(at, (x, y)))
    other = (*block, GROUND + HEIGHT / 2 + 0.001)
    board.world.place(board.other(name), other)
    off = PITCH / 2 - 0.0003
    board.world.place(name, (other[0] + off, other[1] + off, other[2]))


def seized_joint(board: Board, joint: int = 1) -> None:
    """A joint of the arm (1 to 7, counted from the base) does not move any more."""
    seize(board.world, joint)


def weak_grip(board: Board, force: float = 0.1) -> None:
    """The fingers close with no more than this force (N)."""
    board.world.robot.weaken(force)


def register(library: OperationLibrary) -> None:
    """Register the world ``chess`` with its operations, sensor and faults."""

    @library.world("chess", settle=0.2, values=PLACES)
    def build(world: BulletWorld, blueprint: Blueprint, seed: int) -> Board:
        board = Board(world, blueprint, seed)
        board.furnish()
        return board

    @library.arrange("chess")
    def arrange(board: Board, facts: Mapping[tuple[str, int], str]) -> None:
        board.arrange({PIECES[digit]: value for (_, digit), value in facts.items()})

    library.stations("chess", robot=ARM)(stations_of)
    register_sensors(library)
    for piece in PIECES:
        for block in BLOCKS:
            name = f"move-{piece}-chess-to-block-{case_of(block)}"
            library.operation(name, stop="hold", timeout=30.0)(step(piece, block))
    for fault in (gripper_opens, slippery, toppled, beside, seized_joint, weak_grip):
        library.fault("chess", fault.__name__)(fault)
