"""What the faults of the table do to an operation, told without physics: which facts it leaves, and
which rings and pegs are lost for good. Campaigns foresee with it how a run ends.

Each function gets the facts of the source (the peg of each disk, disk 1 first) and the arguments of
the operation: its disk and its peg.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from smsl_studio.library.fault_effect import FaultEffect

Facts = tuple[str, ...]
Given = Mapping[str, Any]


def dropped(facts: Facts, given: Given) -> FaultEffect:
    """The ring lies on no peg."""
    return FaultEffect({given["disk"] - 1: "x"})


def slips(facts: Facts, given: Given) -> FaultEffect:
    """The ring slips out of every grip."""
    disk = given["disk"]
    return FaultEffect({disk - 1: "x"}, ({"disk": disk},), f"disk {disk} slips out of every grip")


def capped(facts: Facts, given: Given) -> FaultEffect:
    """The ring stays in the hand, because its peg has a cap."""
    peg = given["peg"]
    return FaultEffect({given["disk"] - 1: "h"}, ({"peg": peg},), f"no disk goes on peg {peg}")


def carried_along(facts: Facts, given: Given) -> FaultEffect:
    """The ring below comes with the one that is carried."""
    disk, peg = given["disk"], given["peg"]
    below = [n for n in range(disk + 1, len(facts) + 1) if facts[n - 1] == facts[disk - 1]]
    return FaultEffect(dict.fromkeys((disk - 1, *(n - 1 for n in below[:1])), peg))


def misplaced(facts: Facts, given: Given) -> FaultEffect:
    """Another ring lies on a smaller one, which counts as on no peg."""
    disk, peg = given["disk"], given["peg"]
    others = [n for n in range(1, len(facts) + 1) if n != disk]
    tops = sorted({min(n for n in others if facts[n - 1] == facts[m - 1]) for m in others})
    other = tops[1] if len(tops) > 1 else max(others)
    return FaultEffect({disk - 1: peg, other - 1: "x"})


def seized(facts: Facts, given: Given) -> FaultEffect:
    """Nothing moves any more."""
    return FaultEffect({}, ({},), "the arm cannot move")


def out_of_sight(facts: Facts, given: Given) -> FaultEffect:
    """The ring is out of reach and out of sight."""
    disk = given["disk"]
    return FaultEffect({disk - 1: None}, ({"disk": disk},), f"disk {disk} is out of sight")


def without_force(facts: Facts, given: Given) -> FaultEffect:
    """No ring is held any more."""
    return FaultEffect({}, ({},), "the fingers have no force")


EFFECTS: Mapping[str, Callable[[Facts, Given], FaultEffect]] = {
    "gripper_opens": dropped,
    "slippery": slips,
    "blocked_peg": capped,
    "tower_carried": carried_along,
    "wrong_order": misplaced,
    "disk_pushed": dropped,
    "seized_joint": seized,
    "disk_off_board": out_of_sight,
    "weak_grip": without_force,
}
