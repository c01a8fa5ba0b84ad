"""From the rules of a procedure to its blueprint: every state that can be reached, every edge.

The rules are a function from the facts to the operations they permit. The Towers of Hanoi are the
example the paper prints, and the size of the procedure that benches turn up.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import UsageError
from smsl_studio.smsl.json_form import parse_json, write_json

Facts = tuple[str, ...]
Values = dict[str, dict[str, dict[str, str]]]
Moves = Callable[[Facts], Iterable[tuple[str, Facts]]]

PEGS = "abc"


def branch_values(name: str, states: Iterable[Facts], moves: Moves) -> Values:
    """One SB over ``states`` in their order, with the operations that ``moves`` permits in each.

    The first state is INITIAL and the last ACTIVATING, as the language has it by default.
    """
    table: dict[str, dict[str, str]] = {"HEADER": {}}
    for facts in states:
        table[_state(facts)] = {operation: _state(target) for operation, target in moves(facts)}
    return {name: table}


def hanoi_moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
    """The moves the game permits: a disk nothing lies on, to a peg without a smaller disk.

    Digit 0 is the peg of disk 1, the smallest. ``Op_2c`` moves disk 2 to peg c.
    """
    for disk, peg in enumerate(facts):
        smaller = facts[:disk]
        if peg in smaller:
            continue
        for other in PEGS:
            if other != peg and other not in smaller:
                yield f"Op_{disk + 1}{other}", (*smaller, other, *facts[disk + 1 :])


def hanoi_values(disks: int, branch: str = "SB1") -> Values:
    """The Towers of Hanoi as plain values: 3 ** ``disks`` states, all on a first, all on c last."""
    if not 1 <= disks <= 12:
        raise UsageError(
            f"Hanoi with {disks} disks is not offered", advice="Take a number from 1 to 12."
        )
    towers = (facts[::-1] for facts in itertools.product(PEGS, repeat=disks))
    return branch_values(branch, towers, hanoi_moves)


def hanoi(disks: int) -> Blueprint:
    """The Towers of Hanoi as a blueprint; UsageError for a number of disks that makes no sense."""
    text = write_json(hanoi_values(disks))
    return read_blueprint(parse_json(text, f"hanoi-{disks}.json"))


LOST = {"h": "held, not yet put down", "x": "dropped: on no peg, or on a smaller disk"}
"""The values of a disk's fact where the disk is on no peg."""


def recovering_moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
    """The moves of the game, and those that bring a lost disk back.

    ``Op_recover2c`` brings disk 2 to peg c, where no smaller disk is in the way.
    """
    lost = [disk for disk, peg in enumerate(facts) if peg in LOST]
    if not lost:
        yield from hanoi_moves(facts)
    for disk in lost:
        for peg in PEGS:
            if peg not in facts[:disk]:
                yield f"Op_recover{disk + 1}{peg}", (*facts[:disk], peg, *facts[disk + 1 :])


def hanoi_failures_values(disks: int, branch: str = "SB1") -> Values:
    """The Towers of Hanoi where one disk at a time may be lost: held (h) or dropped (x).

    The lost disk's value is a failure value; the states in which none is lost come first.
    """
    good = list(hanoi_values(disks, branch)[branch])[1:]
    towers = [tuple(state.removeprefix("State_")) for state in good]
    lost = [
        facts
        for disk in range(disks)
        for value in LOST
        for facts in dict.fromkeys((*t[:disk], value, *t[disk + 1 :]) for t in towers)
    ]
    values = branch_values(branch, [*towers, *lost], recovering_moves)
    table: dict[str, Any] = values[branch]
    table["HEADER"] = {"INITIAL": good[0], "ACTIVATING": good[-1], "NUM_FACTS": disks}
    pegs = {peg: f"on peg {peg}" for peg in PEGS}
    facts = {
        str(disk): {"name": f"Disk {disk + 1}", "values": pegs | LOST, "failure": list(LOST)}
        for disk in range(disks)
    }
    header = table.pop("HEADER")
    return {branch: {"HEADER": header, "_facts": facts, **table}}


def hanoi_failures(disks: int) -> Blueprint:
    """Hanoi with failure states as a blueprint; UsageError as ``hanoi`` has it."""
    text = write_json(hanoi_failures_values(disks))
    return read_blueprint(parse_json(text, f"hanoi-{disks}-failures.json"))


def switch_moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
    """Every switch may be turned, one at a time; ``Op_2`` turns switch 2."""
    for digit, value in enumerate(facts):
        turned = "1" if value == "0" else "0"
        yield f"Op_{digit + 1}", (*facts[:digit], turned, *facts[digit + 1 :])


def level_values(switches: Sequence[int] = (12, 12, 8)) -> Values:
    """SBs of independent switches, each the sub-SB under digit 1 of the one before.

    By default three levels with 100,352 operations: what a large file with sub-SBs costs.
    """
    values: Values = {}
    for level, count in enumerate(switches):
        states = itertools.product("01", repeat=count)
        values |= branch_values(f"Level{level + 1}", states, switch_moves)
    for level in range(1, len(switches)):
        header: dict[str, Any] = values[f"Level{level}"]["HEADER"]
        header["SUB_SBS"] = {f"Level{level + 1}": 1}
    return values


def _state(facts: Facts) -> str:
    return f"State_{''.join(facts)}"
