"""Previews against what happens: every operation of a procedure is previewed in physics, then run.

Both start anew with the same seed. They agree if the operation is committed in the run exactly when
the preview agrees with the blueprint, and if all sensed facts are the same afterwards. Without
``--all`` only Hanoi with two disks is looked at.

A greased ring and a blocked peg are then put into both worlds, and both have to show the same. They
are put into the live world alone as well: then the forecast of the run is wrong, and the event
``forecast`` has to say so wherever the facts differ from it.

    python -m benches.previews --keep previews.jsonl

goes on from ``previews.jsonl`` after a stop.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path

from benches.row import Row
from benches.shares import Share, asked, counted, shares_of
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.foresight import sensed_values
from smsl_studio.front.forecasts import Facts, carried, terms_of
from smsl_studio.front.hosts import known_world, make_host
from smsl_studio.front.inputs import read
from smsl_studio.front.previews import preview
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import open_run
from smsl_studio.front.starts import start_for_edge
from smsl_studio.runlog.events import Committed, Event, ForecastTold, RunFinished
from smsl_studio.runlog.regulation import WRONG
from smsl_studio.shipped import plugins_dir, samples_dir

FILES: Mapping[str, tuple[Callable[[], Path], str, str]] = {
    "hanoi-2.json": (samples_dir, "hanoi-2.json", "hanoi"),
    "hanoi-corrected.json": (samples_dir, "hanoi-corrected.json", "hanoi"),
    "river.json": (plugins_dir, "river/river.json", "river"),
    "chess.json": (plugins_dir, "chess/chess.json", "chess"),
    "registration.json": (samples_dir, "registration.json", "registration"),
    "registration-digitization.json": (
        samples_dir, "registration-digitization.json", "registration",
    ),
    "hanoi.json": (samples_dir, "hanoi.json", "hanoi"),
}  # fmt: skip
"""The folder, the file and the world of each procedure."""
SHARE = 6
"""So many operations are one share."""
MISHAPS: tuple[tuple[str, Callable[[Address], Mapping[str, int | str]]], ...] = (
    ("slippery", lambda edge: {"disk": int(edge.operation[3])}),
    ("blocked_peg", lambda edge: {"peg": edge.operation[4]}),
)
LIVE = 6
"""With mishaps every so-manyth operation of Hanoi is looked at."""


def rows() -> Iterator[Row]:
    """Preview a small procedure."""
    yield from _rows(counted(compared, _shares(("hanoi-2.json",))))


def all_rows(keep: Path | None = None) -> Iterator[Row]:
    """Preview every operation of Hanoi, river, chess and registration. ``keep`` is the file of what
    was looked at before.
    """
    yield from _rows(counted(compared, _shares([*FILES][1:]), keep=keep))
    sums = counted(with_mishaps, shares_of(["mishaps"], 0, len(_hanoi()), SHARE), keep=keep)
    yield from _mishap_rows(sums["mishaps"])


def _shares(names: list[str] | tuple[str, ...]) -> list[Share]:
    return [share for name in names for share in shares_of([name], 0, len(_edges(name)), SHARE)]


@cache
def _blueprint(name: str) -> Blueprint:
    folder, file, _ = FILES[name]
    return read(folder() / file)


@cache
def _edges(name: str) -> list[Address]:
    return [edge.address for branch in _blueprint(name) for edge in branch.edges()]


def compared(name: str, first: int, behind: int) -> dict[str, int]:
    """Count the operations from one number to before another, and where preview and run differ."""
    blueprint, world = _blueprint(name), FILES[name][2]
    counts, begun = Counter(edges=0, agree=0, apart=0), time.process_time()
    for edge in _edges(name)[first:behind]:
        told = preview(blueprint, edge, world)
        done, facts = _run(blueprint, edge, world)
        right = (told.agrees, told.after) == (done, facts)
        counts.update(edges=1, agree=told.agrees, apart=not right)
        if not right:
            print(f"{name}, {edge}: {told.after} was predicted, {facts} came", flush=True)
    return {**counts, "ms": round((time.process_time() - begun) * 1000)}


def _run(blueprint: Blueprint, edge: Address, world: str) -> tuple[bool, Facts]:
    """Run an operation alone from its source. Return whether it was committed, and the facts. An
    operation without a start is not run, and has no facts.
    """
    start = start_for_edge(Hierarchy(blueprint), edge)
    if start is None:
        return False, {}
    starts = [Address(branch, state) for branch, state in start.items()]
    dispatcher = open_run(blueprint, world, start=starts, host="local", automatic=False)
    try:
        events = [*dispatcher.open()]
        if not dispatcher.finished:
            dispatcher.host.suppose(edge)
            dispatcher.ask(edge)
            events += dispatcher.tick()
            while dispatcher.phase == "running":
                events += dispatcher.tick()
        done = any(isinstance(e, Committed) and str(edge) in e.operations for e in events)
        facts = {} if dispatcher.finished else sensed_values(dispatcher.standing.scene)
        return done and dispatcher.phase == "ready", facts
    finally:
        dispatcher.close()


def _rows(sums: Mapping[str, Counter[str]]) -> Iterator[Row]:
    for name, counts in sums.items():
        words = f"{name}: {counts['edges']} operations previewed, then run ({counts['agree']} agree"
        yield Row(f"{words} with the blueprint): facts or outcome differ", counts["apart"], "",
                  bound="0")  # fmt: skip
        yield Row(f"{name}: one preview and run", counts["ms"] / counts["edges"], "CPU ms")


# -- mishaps in one world and in both --------------------------------------------------------------


def _hanoi() -> list[Address]:
    return _edges("hanoi-corrected.json")[::LIVE]


def with_mishaps(_: str, first: int, behind: int) -> dict[str, int]:
    """Count operations of Hanoi with a mishap in both worlds, and in the live one alone."""
    blueprint = _blueprint("hanoi-corrected.json")
    counts = Counter(both=0, apart=0, live=0, differ=0, told=0, falsely=0)
    for edge in _hanoi()[first:behind]:
        for fault, given in MISHAPS:
            facts, wrong = _live(blueprint, edge, fault, given(edge))
            same = _disturbed(blueprint, edge, fault, given(edge)) == facts
            counts.update(both=1, apart=not same)
            predicted = preview(blueprint, edge, "hanoi").after
            known = {key: value for key, value in facts.items() if value is not None}
            differs = any(predicted[key] != value for key, value in known.items())
            counts.update(live=1, differ=differs, told=differs and wrong)
            counts.update(falsely=wrong and not differs)
    return dict(counts)


def _disturbed(
    blueprint: Blueprint, edge: Address, fault: str, given: Mapping[str, int | str]
) -> Facts:
    """Return the facts after an operation in a world of its own in which the mishap was before."""
    request = RunRequest(blueprint, "hanoi", host="local")
    host = make_host(request, known_world("hanoi"))
    try:
        start = {edge.branch: edge.state}
        dispatcher = Dispatcher(blueprint, host, terms_of(start, 0))
        dispatcher.open()
        dispatcher.inject(fault, by="a bench", **given)
        dispatcher.tick()
        return carried(Hierarchy(blueprint), host, dispatcher, edge).after
    finally:
        host.close()


def _live(
    blueprint: Blueprint, edge: Address, fault: str, given: Mapping[str, int | str]
) -> tuple[Facts, bool]:
    """Run an operation with forecasts, and the mishap in the world of the run alone. Return the
    facts, and whether the forecast was told to be wrong.
    """
    dispatcher = open_run(
        blueprint,
        "hanoi",
        start=f"{edge.branch}/{edge.state}",
        host="local",
        automatic=False,
        forecast="show",
    )
    try:
        events: list[Event] = [*dispatcher.open()]
        dispatcher.inject(fault, by="a bench", **given)
        dispatcher.tick()
        dispatcher.ask(edge)
        events += dispatcher.tick()
        while dispatcher.phase == "running":
            events += dispatcher.tick()
        wrong = any(isinstance(e, ForecastTold) and e.verdict == WRONG for e in events)
        assert not any(isinstance(e, RunFinished) for e in events), events[-1]
        return sensed_values(dispatcher.standing.scene), wrong
    finally:
        dispatcher.close()


def _mishap_rows(counts: Counter[str]) -> Iterator[Row]:
    words = f"hanoi, {counts['both']} operations, a greased ring or a blocked peg in both worlds"
    yield Row(f"{words}: facts differ", counts["apart"], "", bound="0")
    live = f"the same in the live world alone, {counts['live']} operations: forecasts that were "
    yield Row(f"{live}wrong ({counts['differ']}) and not told so",
              counts["differ"] - counts["told"], "", bound="0")  # fmt: skip
    yield Row(f"{live}right and told to be wrong", counts["falsely"], "", bound="0")


def main() -> None:
    """Look at all of them, and print the rows."""
    told = asked("Compare previews with what happens.", 0)
    for row in all_rows(told.keep):
        print(f"{row.work}: {row.ours:g} {row.unit}", flush=True)


if __name__ == "__main__":
    main()
