"""The hanoi plugin on a table of its own, as a host would drive it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from plugins.hanoi.plugin import register
from plugins.hanoi.table import Table
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.host.default_decision import decided
from smsl_studio.library.fact_default import default_of
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.smsl.files import read_document
from smsl_studio.world.bullet import BulletWorld

SAMPLES = Path(__file__).parents[2] / "samples"
FILES = {2: "hanoi-2.json", 3: "hanoi-corrected.json", 4: "hanoi-4.json"}
SETTLE = 48


def library() -> OperationLibrary:
    """The Operation Library with nothing but this plugin in it."""
    found = OperationLibrary("hanoi")
    register(found)
    return found


def sample(name: str) -> Blueprint:
    return read_blueprint(read_document(SAMPLES / name))


class Game:
    """A table; states are written as their pegs, disk 1 first."""

    def __init__(self, count: int = 3, seed: int = 0) -> None:
        self.library = library()
        self.world = BulletWorld("hanoi")
        entry = self.library.worlds["hanoi"]
        self.table: Table = entry.build(self.world, sample(FILES[count]), seed)
        sensors = self.library.sensors
        fact = next(one for one in sensors if one.predicate)
        self._pegs = [
            decided(default_of(fact.predicate, fact.otherwise, {"n": str(disk.number)}, sensors))
            for disk in self.table.disks
        ]

    def put(self, pegs: str) -> None:
        facts = {("SB1", digit): peg for digit, peg in enumerate(pegs)}
        self.library.arrangers["hanoi"](self.table, facts)

    def read(self) -> str:
        """The pegs that the default predicates decide from what the sensors measure."""
        return "".join(peg(self.table) or "?" for peg in self._pegs)

    def start(self, operation: str) -> Any:
        """The generator of an operation such as ``2b``."""
        function = self.library.operations[0].function
        return function(self.table, disk=int(operation[0]), peg=operation[1])

    def run(self, operation: str) -> tuple[object, float]:
        """Carry an operation out and let it settle: what it returned, how long it took (s)."""
        result, ticks = self.advance(self.start(operation))
        self.wait(SETTLE)
        return result, ticks * self.world.tick

    def advance(self, generator: Any, ticks: int = 10_000) -> tuple[object, int]:
        """Let an operation go on for so many ticks at most: what it returned, ticks it took."""
        for tick in range(ticks):
            try:
                next(generator)
            except StopIteration as end:
                return end.value, tick
            self.world.step()
        return "running", ticks

    def advance_until(self, generator: Any, pegs: str) -> None:
        """Let an operation go on until these pegs are read."""
        while self.read() != pegs:
            assert self.advance(generator, 1)[0] == "running", f"{pegs} was never read"

    def wait(self, ticks: int) -> None:
        for _ in range(ticks):
            self.world.step()
