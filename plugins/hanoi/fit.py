"""Which blueprints fit a table: those that have and move only its rings, on its pegs."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from smsl_studio.errors import WorldError
from smsl_studio.world.known_values import refuse_others

from .disks import PEGS, Disk
from .table import HELD, NOWHERE

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import StateBranch

MOVE = re.compile(r"Op_(?:recover)?(\d{1,9})(.+)")
"""The name of an operation that moves a ring: its number, and the peg."""


def refuse_unfit(branch: StateBranch, disks: Sequence[Disk]) -> None:
    """Refuse a blueprint with rings or pegs that the table does not have. WorldError names the
    first state or operation of this kind."""
    things = [f"disk {disk.number}" for disk in disks]
    refuse_others(branch, things, (*PEGS, HELD, NOWHERE))
    for edge in branch.edges():
        move = MOVE.fullmatch(edge.address.operation)
        if move and not 1 <= int(move[1]) <= len(disks):
            raise WorldError(
                f"{edge.address} moves disk {int(move[1])}, and this table has {len(disks)} disks",
                advice="The table has one disk for each fact.",
            )
        if move and move[2] not in PEGS:
            raise WorldError(
                f"{edge.address} moves a disk to {move[2]!r}, and there are the pegs a, b and c"
            )
