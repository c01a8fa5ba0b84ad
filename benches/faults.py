"""Faults in the worlds of physics, judged by what is drawn (``tests/plugins``).

Nine faults in the hanoi world at three edges each: every run is done twice, with the plain
blueprint, where a mismatch holds, and with the blueprint that has failure states and recovery
operations, where the sensed state may be adopted. ``python -m benches.faults`` prints the table of
docs/failures.md, ``--write`` puts it there.

Every fault of each of the four worlds, at other moments, starts and seeds: eight runs of each
world, with ``--all`` 125, which makes 500. ``--seeds=A:B`` chooses the runs of each world.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row
from benches.seeds import chosen, is_part
from smsl_studio.runlog.events import OperationStarted
from tests.plugins.faulted import (
    PLAIN,
    WITH_FAILURES,
    Case,
    Hand,
    Story,
    cases,
    run_with,
)
from tests.plugins.pose_judges import judged_run
from tests.plugins.world_runs import WORLDS

FEW, EACH = 8, 125
"""The numbers of runs in each world."""

HANDS = (Hand(robot="iiwa"), Hand(robot="dvrk"), Hand("hanoi-mujoco"))
ACCIDENTS = (
    Case("gripper_opens", 1),
    Case("slippery", 1),
    Case("blocked_peg", 1, {"peg": "c", "seconds": 6.0}),
)
"""What befalls the other hands: a drop, a slip, and a peg that is blocked for a while."""

PAGE = Path(__file__).parent.parent / "docs" / "failures.md"
BEGIN, END = "<!-- table of faults: begin -->\n", "<!-- table of faults: end -->\n"

HEAD = """\
| fault | during | it said | sensed, stands | decision | stands | with failure states |
|---|---|---|---|---|---|---|
"""


def rows() -> Iterator[Row]:
    """Count what 54 runs of hanoi, nine with other hands, and a few of each world, reported or
    committed falsely."""
    yield from _hanoi()
    yield from _hands()
    yield from _worlds(FEW)


def all_rows() -> Iterator[Row]:
    """Count the same with 500 runs in the four worlds."""
    if not is_part():
        yield from _hanoi()
        yield from _hands()
    yield from _worlds(EACH)


def _hanoi() -> Iterator[Row]:
    start = time.process_time()
    pairs = list(stories())
    spent = time.process_time() - start
    for number, what in enumerate(("a mismatch holds", "failure states, adopted")):
        told = [pair[number] for pair in pairs]
        ended = Counter(story.decision for story in told)
        words = ", ".join(f"{count} {word}" for word, count in sorted(ended.items()))
        wrong = sum(len(story.wrong) for story in told)
        yield Row(
            f"faults in hanoi, {len(told)} runs, {what}: {words}; false reached or wrong commits",
            wrong,
            "",
            bound="0, and every run held, refused or recovered",
        )
    yield Row("faults in hanoi, one run", spent / (2 * len(pairs)), "CPU s")


def _hands() -> Iterator[Row]:
    """Count a drop, a slip and a block with each other robot and in the other engine."""
    for hand in HANDS:
        told = [run_with(case, WITH_FAILURES, adopt=True, hand=hand) for case in ACCIDENTS]
        words = ", ".join(f"{story.case.fault} {story.decision}" for story in told)
        wrong = sum(len(story.wrong) for story in told)
        yield Row(
            f"faults in hanoi with {hand}, failure states: {words}; false reached or wrong commits",
            wrong,
            "",
            bound="0, and every run held, refused or recovered",
        )


def _worlds(each: int) -> Iterator[Row]:
    for world in WORLDS:
        start, commits, wrong, runs = time.process_time(), 0, list[str](), 0
        ended, faults = Counter[str](), set[str]()
        for number in chosen(f"faults in {world}", 0, each):
            story = judged_run(world, number)
            ended[story.reason] += 1
            faults.add(story.fault)
            commits, runs, wrong = commits + story.commits, runs + 1, wrong + list(story.wrong)
        print(*wrong, sep="\n", end="\n" * bool(wrong), file=sys.stderr)
        words = ", ".join(f"{count} {word}" for word, count in sorted(ended.items()))
        done = f"{world}, {len(faults)} faults in {runs} runs, judged by poses: {words}, {commits}"
        yield Row(f"{done} commits; false goals and wrong commits", len(wrong), "", bound="0")
        spent = time.process_time() - start
        yield Row(f"{world}: one judged run with a fault", spent / max(runs, 1), "CPU s")


def stories() -> Iterator[tuple[Story, Story]]:
    """Run every case twice: with hold, and with failure states adopted."""
    for case in cases():
        yield run_with(case, PLAIN), run_with(case, WITH_FAILURES, adopt=True)


def table() -> str:
    """The table as Markdown."""
    lines = [HEAD]
    for plain, failing in stories():
        assert plain.wrong == failing.wrong == ()
        edge = plain.edge.partition("/")[2].removeprefix("State_").replace("/", " ")
        cells = (
            str(plain.case),
            edge,
            plain.at_first,
            f"{plain.sensed}, {plain.stood}",
            plain.decision,
            failing.stood,
            f"{failing.decision}: {_way(failing)}",
        )
        lines.append("| " + " | ".join(cells) + " |\n")
        print(lines[-1], end="", file=sys.stderr, flush=True)
    return "".join(lines)


def _way(story: Story) -> str:
    """Name the first operations from the faulted one on."""
    names = [
        event.address.rpartition("/")[2].removeprefix("Op_")
        for event in story.events
        if isinstance(event, OperationStarted)
    ][story.case.during - 1 :]
    return " ".join(names[:6]) + (" ..." if len(names) > 6 else "")


def main() -> None:
    """Print the table, or put it into its page."""
    text = table()
    if "--write" not in sys.argv:
        print(text)
        return
    page = PAGE.read_text("utf-8")
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    PAGE.write_text(before + BEGIN + text + END + after, "utf-8")


if __name__ == "__main__":
    main()
