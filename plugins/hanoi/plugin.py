"""The Tower of Hanoi in physics: one world, one operation pattern, one sensor pattern.

Facts are the pegs of the disks, disk 1 (the smallest) first: ``cba`` has disk 1 on peg c. A disk in
the hand reads ``h``. A disk off the pegs or on a smaller disk reads ``x`` (paper, SMSL Example 1:
Hanoi Tower).
"""

from __future__ import annotations

from collections.abc import Generator, Mapping
from typing import TYPE_CHECKING

from smsl_studio.errors import WorldError
from smsl_studio.world.arms.panda import ARM

from .faults import OTHER, register_faults
from .fit import refuse_unfit
from .moves import carry
from .recovery import recover
from .sensors import register_sensors
from .table import Table, stations_of

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.library.operation_library import OperationLibrary
    from smsl_studio.world.bodies import Robot
    from smsl_studio.world.bullet import BulletWorld


def register(library: OperationLibrary) -> None:
    """Register both worlds with their operations, sensors and faults."""

    @library.world("hanoi", settle=0.2, values=("a", "b", "c"), robots=("panda", "iiwa", "dvrk"))
    def build(world: BulletWorld, blueprint: Blueprint, seed: int, robot: Robot = ARM) -> Table:
        if len(blueprint) != 1:
            raise WorldError(
                f"the hanoi world needs a blueprint of one State Branch, this has {len(blueprint)}",
                advice="Use the world table, which runs any blueprint.",
            )
        (branch,) = blueprint
        table = Table(world, branch.num_facts, seed, robot)
        refuse_unfit(branch, table.disks)
        table.furnish()
        return table

    @library.arrange("hanoi")
    def arrange(table: Table, facts: Mapping[tuple[str, int], str]) -> None:
        pegs = {table.disk(digit + 1): value for (_, digit), value in facts.items()}
        table.arrange(pegs)

    library.stations("hanoi")(stations_of)
    library.stations(OTHER, robot=ARM)(stations_of)
    # The same table in another engine.
    library.world(OTHER, engine="mujoco", settle=0.2, values=("a", "b", "c"))(build)
    library.arrange(OTHER)(arrange)
    register_sensors(library)

    @library.operation("Op_{disk}{peg}", stop="hold", timeout=20.0)
    def move_disk(table: Table, disk: int, peg: str) -> Generator[None, None, bool]:
        return (yield from carry(table, table.disk(disk), peg))

    @library.operation("Op_recover{disk}{peg}", stop="hold", timeout=30.0, recovery=True)
    def recover_disk(table: Table, disk: int, peg: str) -> Generator[None, None, bool]:
        return (yield from recover(table, table.disk(disk), peg))

    register_faults(library)
