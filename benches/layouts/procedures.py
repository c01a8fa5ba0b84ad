"""Three procedures from publications, made from their rules: a registration, a river, a board."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable, Iterable, Iterator

Table = dict[str, dict[str, str]]
NEAR = {"A": "Ba", "B": "AC", "C": "BDc", "D": "Cd", "a": "A0", "c": "Cd", "d": "Dc1", "0": "a",
        "1": "d"}  # fmt: skip
"""The blocks of the board, each with those that a piece moves to from it."""


def rotms() -> Table:
    """A procedure of robotic stimulation: landmarks planned, digitized, registered, tool pose
    planned, robot connected. Everything can be taken back at any time.
    """

    def moves(facts: str) -> Iterator[tuple[str, str]]:
        planned, digitized, registered, posed, robot = tuple(facts)
        yield "PlanLandmarks", "100" + posed + robot
        yield "Reinitialize", "00000"
        word, other = ("DisconnectRobot", "0") if robot == "1" else ("ConnectRobot", "1")
        yield word, facts[:4] + other
        yield "PlanToolPose", facts[:3] + "1" + robot
        if posed == "1":
            yield "ClearToolPose", facts[:3] + "0" + robot
        if planned == "1":
            yield "ClearLandmarks", "000" + posed + robot
            yield "Digitize", "110" + posed + robot
            yield "UsePrevRegister", "111" + posed + robot
        if digitized == "1":
            yield "ClearDigitization", "100" + posed + robot
            yield "Register", "111" + posed + robot
        if registered == "1":
            yield "ClearRegistration", "110" + posed + robot
            if posed == robot == "1":
                yield "MoveToTarget", facts

    return _reached("00000", moves)


def river() -> Table:
    """A farmer brings grass, sheep and wolf over a river: 40 states."""
    items = ("grass", "sheep", "steve", "wolf")
    words = {"0": "red_land", "B": "boat", "1": "green_land"}

    def allowed(facts: str) -> bool:
        grass, sheep, steve, wolf = tuple(facts)
        aboard = facts.count("B")
        if aboard > 2 or (aboard == 2 and steve != "B"):
            return False
        return not (sheep in "01" and sheep != steve and sheep in (grass, wolf))

    def moves(facts: str) -> Iterator[tuple[str, str]]:
        steve = facts[2]
        for digit, place in enumerate(facts):
            for other in ("B",) if place in "01" else ("0", "1"):
                bank = place if place != "B" else other
                if digit != 2 and steve not in ("B", bank):
                    continue
                after = facts[:digit] + other + facts[digit + 1 :]
                if allowed(after):
                    yield f"move_{items[digit]}_from_{words[place]}_to_{words[other]}", after

    return _reached("0000", moves)


def chess() -> Table:
    """Two pieces on a board of nine blocks, one of them may stand on the other: 90 states."""

    def moves(facts: str) -> Iterator[tuple[str, str]]:
        for digit, piece in enumerate(("star", "circle")):
            block, layer = facts[2 * digit], facts[2 * digit + 1]
            other = facts[2 - 2 * digit]
            if layer == "B" and block == other:
                continue
            for to in NEAR[block]:
                own, rest = to + ("T" if to == other else "B"), other + "B"
                case = "uppercase-" if to.isupper() else "lowercase-" if to.islower() else ""
                after = own + rest if digit == 0 else rest + own
                yield f"move-{piece}-chess-to-block-{case}{to}", after

    return _reached("0B1B", moves)


def _reached(start: str, moves: Callable[[str], Iterable[tuple[str, str]]]) -> Table:
    """Every state that can be reached, nearest first, with its operations."""
    table: Table = {}
    queue = deque([start])
    while queue:
        facts = queue.popleft()
        if f"State_{facts}" not in table:
            operations = dict(moves(facts))
            table[f"State_{facts}"] = {name: f"State_{to}" for name, to in operations.items()}
            queue.extend(itertools.chain(operations.values()))
    return table
