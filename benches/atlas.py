"""The atlas of faults: every operation of Hanoi with every fault of its world, predicted and run.

For each of the 78 operations and each of the nine faults a run begins in the state that the
operation leaves. The operation is asked for, and the fault is injected 0.3 s after its begin. Then
the run goes on by itself to the goal, and adopts the sensed state where that is the only one that
fits. That is done with ``hanoi-failures.json``, which has failure states and ways out of them.

The prediction is that of the page Campaign (``front/fault_foresight.py``) and knows no physics. It
knows what a fault does to the facts, and which operations it makes impossible for good. The planner
then says whether a route leads from there to the goal, as ``check --recoverability`` does. Where
rings truly stood is judged from their poses
(``tests/plugins/faulted.py``), at each commit and at the goal.

    python -m benches.atlas --keep atlas.jsonl --workers 2 --write

goes on from ``atlas.jsonl`` after a stop, and writes docs/atlas.md. Without ``--all`` the bench
runs 18 cells.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

from benches.row import Row
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.foresight import sensed_values
from smsl_studio.front.campaign_faults import arguments_of
from smsl_studio.front.fault_foresight import HELD as FORESEEN_HELD
from smsl_studio.front.fault_foresight import FaultForesight
from smsl_studio.front.hosts import known_world
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from smsl_studio.runlog.events import (
    Committed,
    Event,
    Held,
    Mismatch,
    OperationEnded,
    OperationRisky,
    OperationStarted,
    Relocalised,
    RunFinished,
)
from smsl_studio.shipped import samples_dir
from tests.plugins.faulted import AFTER, WITH_FAILURES, standing

FAULTS = (
    "gripper_opens", "slippery", "blocked_peg", "tower_carried", "wrong_order", "disk_pushed",
    "seized_joint", "disk_off_board", "weak_grip",
)  # fmt: skip
RECOVERED, HELD, UNDISTURBED = "recovered", "held", "undisturbed"
SIGNS = {RECOVERED: "R", HELD: "H", UNDISTURBED: "."}
LONGEST = 600.0
"""Simulated seconds after which a run is stopped."""
SOME = 39
"""Without ``--all`` one of so many cells is run."""
PAGE = Path(__file__).parent.parent / "docs" / "atlas.md"


@dataclass(frozen=True)
class Foreseen:
    """What is predicted for a cell: how the run will end, and the facts after the operation.

    ``facts`` has a peg for each disk, disk 1 first; ``?`` is unknown. ``why`` says what stays
    impossible, empty if nothing does.
    """

    end: str
    facts: str
    why: str = ""


@dataclass(frozen=True)
class Cell:
    """One run of the atlas. ``wrong`` are commits and goals where the rings stood elsewhere."""

    edge: str
    fault: str
    foreseen: str
    facts: str
    end: str
    seen: str
    said: str
    wrong: tuple[str, ...]
    seconds: float

    @property
    def agrees(self) -> bool:
        """Whether the run ended as it was predicted."""
        return self.foreseen == self.end


def edges_of(blueprint: Blueprint) -> list[Address]:
    """Return the 78 operations of Hanoi that are no recovery."""
    found = (edge.address for edge in blueprint["SB1"].edges())
    return [edge for edge in found if not edge.operation.startswith("Op_recover")]


def given_of(fault: str, edge: Address) -> Mapping[str, int | str]:
    """Return the parameters of a fault: the disk that is moved, or the peg that it is put on."""
    disk, peg = int(edge.operation[3]), edge.operation[4]
    if fault in ("slippery", "disk_pushed", "disk_off_board"):
        return {"disk": disk}
    return {"peg": peg} if fault == "blocked_peg" else {}


def foreseen(edge: Address, fault: str) -> Foreseen:
    """Predict how a run with a fault in an operation ends, from the blueprint alone."""
    told = _foresight().look(fault, edge)
    assert told is not None
    end = HELD if told.end == FORESEEN_HELD else RECOVERED if told.disturbed else UNDISTURBED
    return Foreseen(end, "".join(value or "?" for value in told.facts), told.why)


@cache
def _foresight() -> FaultForesight:
    blueprint = _blueprint()
    loaded = known_world("hanoi")
    assert loaded is not None
    arguments = arguments_of(blueprint, "hanoi", loaded)
    return FaultForesight(blueprint, loaded.faults_of("hanoi"), arguments, adopts=True)


# -- the runs --------------------------------------------------------------------------------------


@cache
def _blueprint() -> Blueprint:
    return read(samples_dir() / WITH_FAILURES)


def cell(number: int) -> Cell:
    """Predict and run one cell, by its number: edge by edge, with the faults in their order."""
    blueprint, begun = _blueprint(), time.process_time()
    edge, fault = edges_of(blueprint)[number // len(FAULTS)], FAULTS[number % len(FAULTS)]
    told = foreseen(edge, fault)
    events, seen, wrong = _run(blueprint, edge, fault)
    last = events[-1]
    assert isinstance(last, RunFinished)
    disturbed = any(isinstance(e, Mismatch | Relocalised | OperationRisky) for e in events)
    reached = last.reason == "goal_reached"
    end = (RECOVERED if disturbed else UNDISTURBED) if reached else HELD
    spent = time.process_time() - begun
    said = "" if reached else f"{last.sentence} {_failed(events)}".strip()
    return Cell(str(edge), fault, told.end, told.facts, end, seen, said, tuple(wrong), spent)


def _run(blueprint: Blueprint, edge: Address, fault: str) -> tuple[list[Event], str, list[str]]:
    """Return the events, the facts after the operation, and what was told falsely."""
    dispatcher = open_run(
        blueprint,
        "hanoi",
        start=f"{edge.branch}/{edge.state}",
        host="local",
        automatic=False,
        attended=False,
        on_mismatch="adopt",
    )
    try:
        events: list[Event] = list(dispatcher.open())
        dispatcher.ask(edge)
        due, seen, wrong = float("inf"), "", list[str]()
        while not dispatcher.finished:
            new = dispatcher.tick()
            events += new
            for event in new:
                if isinstance(event, OperationStarted) and due == float("inf") and not seen:
                    due = event.t + AFTER
                    dispatcher.set_automatic(True)
                elif isinstance(event, Committed):
                    wrong += _judged(dispatcher, f"{event.operations[0]} committed", event)
                if isinstance(event, Committed | Mismatch | Held | Relocalised) and not seen:
                    seen = _sensed(dispatcher)
            if dispatcher.time >= due and not seen:
                dispatcher.inject(fault, by="atlas", **given_of(fault, edge))
                due = float("nan")
            if dispatcher.time > LONGEST:
                dispatcher.stop()
        last = events[-1]
        if isinstance(last, RunFinished) and last.reason == "goal_reached":
            wrong += _judged(dispatcher, "goal reached", last)
        return events, seen, wrong
    finally:
        dispatcher.close()


def _failed(events: Sequence[Event]) -> str:
    """Return what the last operation that failed said."""
    ended = [e for e in events if isinstance(e, OperationEnded) and e.outcome != "returned"]
    return f"{ended[-1].address} said: {ended[-1].message}." if ended and ended[-1].message else ""


def _sensed(dispatcher: Dispatcher) -> str:
    return "".join(value or "?" for value in sensed_values(dispatcher.standing.scene).values())


def _judged(dispatcher: Dispatcher, what: str, event: Committed | RunFinished) -> list[str]:
    said, stood = event.configuration["SB1"].removeprefix("State_"), standing(dispatcher)
    # A ring that is held or dropped stands on no peg, so the judge has one word for both.
    return [] if said.replace("h", "x") == stood else [f"{what} as {said}, the rings stood {stood}"]


# -- the rows and the page -------------------------------------------------------------------------


def rows() -> Iterator[Row]:
    """Run one of ``SOME`` cells."""
    yield from _rows([cell(number) for number in range(0, _count(), SOME)])


def all_rows(keep: Path | None = None) -> Iterator[Row]:
    """Run all cells with two processes. ``keep`` is the file of what was run before."""
    yield from _rows(all_cells(keep, 2))


def _count() -> int:
    return len(edges_of(_blueprint())) * len(FAULTS)


def all_cells(keep: Path | None, workers: int) -> list[Cell]:
    """Run all cells that the file does not have, and return them in order."""
    done = dict(_kept(keep))
    left = [number for number in range(_count()) if number not in done]
    with ProcessPoolExecutor(workers, multiprocessing.get_context("spawn")) as pool:
        asked = {pool.submit(cell, number): number for number in left}
        for future in as_completed(asked):
            found, number = future.result(), asked[future]
            done[number] = found
            if keep is not None:
                with keep.open("a", encoding="utf-8") as file:
                    # A stop may have cut the last line, so each begins behind a line end.
                    file.write("\n" + json.dumps({"number": number, **asdict(found)}) + "\n")
            if len(done) % 20 == 0:
                print(f"atlas: {len(done)} of {_count()} cells", file=sys.stderr, flush=True)
    return [done[number] for number in sorted(done)]


def _kept(keep: Path | None) -> Iterator[tuple[int, Cell]]:
    for line in keep.read_text("utf-8").splitlines() if keep and keep.exists() else ():
        with suppress(ValueError):
            said = json.loads(line)
            number = said.pop("number")
            yield number, Cell(**{**said, "wrong": tuple(said["wrong"])})


def _rows(cells: Sequence[Cell]) -> Iterator[Row]:
    ends = Counter(one.end for one in cells)
    words = ", ".join(f"{ends[end]} {end}" for end in SIGNS)
    yield Row(f"atlas of faults, {len(cells)} runs ({words}): false goals and wrong commits",
              sum(len(one.wrong) for one in cells), "", bound="0")  # fmt: skip
    yield Row("cells that ended otherwise than predicted (docs/atlas.md says why)",
              sum(not one.agrees for one in cells), f"of {len(cells)}")  # fmt: skip
    yield Row("one cell", sum(one.seconds for one in cells) / max(len(cells), 1), "CPU s")


def page(cells: Sequence[Cell]) -> str:
    """Return the tables of the page: a row an operation, a column a fault, and the notes."""
    notes: dict[tuple[str, str, str], int] = {}
    lines = ["| operation | " + " | ".join(FAULTS) + " |", "|---" * (len(FAULTS) + 1) + "|"]
    by_edge: dict[str, list[Cell]] = {}
    for one in cells:
        by_edge.setdefault(one.edge, []).append(one)
    for edge, own in by_edge.items():
        name = edge.partition("/")[2].removeprefix("State_").replace("/", " ")
        marks = [_mark(one, notes) for one in own]
        lines.append("| " + " | ".join((name, *marks)) + " |")
    return "\n".join([*lines, "", *_notes(cells, notes)]) + "\n"


def _mark(one: Cell, notes: dict[tuple[str, str, str], int]) -> str:
    if one.agrees:
        return SIGNS[one.end]
    number = notes.setdefault(_key(one), len(notes) + 1)
    return f"{SIGNS[one.foreseen]}→{SIGNS[one.end]} {number}"


def _key(one: Cell) -> tuple[str, str, str]:
    return one.fault, one.foreseen, one.end


def _notes(cells: Iterable[Cell], notes: Mapping[tuple[str, str, str], int]) -> Iterator[str]:
    told = [one for one in cells if not one.agrees]
    for key, number in notes.items():
        own = [one for one in told if _key(one) == key]
        fault, before, after = key
        why = REASONS.get(key, "")
        yield f"{number}. `{fault}`, {len(own)} cells: predicted {before}, {after}. {why}".rstrip()
        for one in own:
            words = f": {one.said}" if one.said else ""
            name = one.edge.partition("/")[2].removeprefix("State_").replace("/", " ")
            yield f"   - {name}: facts {one.seen}, predicted {one.facts}{words}"


REASONS: dict[tuple[str, str, str], str] = {
    ("gripper_opens", RECOVERED, HELD): "The ring stands on its edge, and the arm has no grip for "
    "that: both ways out fail as soon as they begin.",
    ("gripper_opens", RECOVERED, UNDISTURBED): "The ring fell onto the peg that it was carried to.",
    ("wrong_order", RECOVERED, HELD): "A ring that lies on a smaller one counts as on no peg, and "
    "so does one that was put on top of both; no state of the blueprint has two such rings. Where "
    "one alone is off, the arm did not get the largest ring onto a peg.",
    ("tower_carried", RECOVERED, HELD): "Both rings came down on a smaller one, so they count as "
    "on no peg; no state of the blueprint has two such rings.",
    ("slippery", HELD, RECOVERED): "The ring slipped out of the fingers before it was lifted, so "
    "all stands as before. The way on does not need this ring any more, or a later grip held.",
    ("blocked_peg", HELD, RECOVERED): "The ring pushed the cap off its peg, so the peg was free.",
    ("blocked_peg", RECOVERED, HELD): "The ring pushed the cap off its peg, and it came down on "
    "peg c, which the rest of the way needs.",
}  # fmt: skip
"""Why cells with this fault end otherwise than predicted, by fault, prediction and outcome. How
rings and cap lay was read from their poses, in one cell of each kind."""


def main() -> None:
    """Run all cells, and print or write the page."""
    parser = argparse.ArgumentParser(description="Run the atlas of faults.")
    parser.add_argument("--keep", type=Path, metavar="FILE", help="go on from this file")
    parser.add_argument("--workers", type=int, default=2, help="processes (default 2)")
    parser.add_argument("--write", action="store_true", help="write docs/atlas.md")
    told = parser.parse_args()
    cells = all_cells(told.keep, told.workers)
    for row in _rows(cells):
        print(f"{row.work}: {row.ours:g} {row.unit}", flush=True)
    if told.write:
        write(cells)
    else:
        print(page(cells))


BEGIN, END = "<!-- atlas: begin -->\n", "<!-- atlas: end -->\n"


def write(cells: Sequence[Cell]) -> None:
    """Put the tables into the page."""
    text = PAGE.read_text("utf-8")
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    PAGE.write_text(before + BEGIN + page(cells) + END + after, "utf-8")


if __name__ == "__main__":
    main()
