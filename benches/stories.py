"""500 logs with impossible events but a valid chain, and 500 true logs with every kind of end.

``tests/runlog/true_stories.py`` makes the true logs, ``tests/runlog/impossible.py`` changes them.
Impossible stories are drawn evenly from all operators, each from another true log if there is one.
"""

from __future__ import annotations

import io
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random

from benches.row import Row
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.grammar.log_reader import verify
from tests.runlog.impossible import OPERATORS, Story, impossible
from tests.runlog.true_stories import log_of_a_dying_world, log_of_physics, true_log

STORIES, PHYSICS, DYING = 500, 4, 2


def rows() -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as name:
        logs = _true(Path(name))
        stories = [Story.of(raw) for raw in logs]
        refused = [str(verify(io.BytesIO(raw), "log", COMMANDS).doubt) for raw in logs
                   if verify(io.BytesIO(raw), "log", COMMANDS).doubt is not None]  # fmt: skip
        ends = Counter(story.end["reason"] for story in stories)
        words = ", ".join(f"{count} {reason}" for reason, count in sorted(ends.items()))
        yield Row(f"{len(logs)} true logs ({words})", len(logs) - len(refused), "accepted",
                  bound=str(len(logs)))  # fmt: skip
        drawn, accepted = _changed(stories)
        kinds = f"{len(drawn)} kinds, each at least {min(drawn.values())} times"
        yield Row(f"{drawn.total()} impossible stories with a good chain ({kinds})",
                  drawn.total() - len(accepted), "refused", bound=str(drawn.total()))  # fmt: skip


def _true(folder: Path) -> list[bytes]:
    paths = [log_of_physics(number, folder) for number in range(PHYSICS)]
    for number in range(DYING):
        place = folder / f"dying-{number}"
        place.mkdir()
        paths.append(log_of_a_dying_world(place))
    paths += [true_log(number, folder) for number in range(STORIES - len(paths))]
    return [path.read_bytes() for path in paths]


def _changed(stories: list[Story]) -> tuple[Counter[str], list[str]]:
    """Count the logs that each operator has changed, and the accepted logs among them."""
    random, drawn, accepted = Random(1), Counter[str](), list[str]()
    while drawn.total() < STORIES:
        for operator in OPERATORS[: STORIES - drawn.total()]:
            changed = None
            while changed is None:
                changed = impossible(random.choice(stories), operator, random)
            drawn[operator.__name__] += 1
            if verify(io.BytesIO(changed.raw()), "log", COMMANDS).doubt is None:
                accepted.append(operator.__name__)
    return drawn, accepted
