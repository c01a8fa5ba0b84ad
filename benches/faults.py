"""Nine faults in the hanoi world at three edges each, judged by the true positions of the rings.

Every run is done twice: with the plain blueprint, where a mismatch holds, and with the blueprint
that has failure states and recovery operations, where the sensed state may be adopted. ``--table``
prints the table of docs/failures.md, ``--write`` puts it there.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row
from smsl_studio.runlog.events import OperationStarted
from tests.plugins.faulted import PLAIN, WITH_FAILURES, Story, cases, run_with

PAGE = Path(__file__).parent.parent / "docs" / "failures.md"
BEGIN, END = "<!-- table of faults: begin -->\n", "<!-- table of faults: end -->\n"

HEAD = """\
| fault | during | it said | sensed, stands | decision | stands | with failure states |
|---|---|---|---|---|---|---|
"""


def rows() -> Iterator[Row]:
    """Count the ends of the 54 runs, and the runs that reported or committed something false."""
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
