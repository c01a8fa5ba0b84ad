"""Plans over many sub-SBs: the four large files of the tests, and equal routes.

A row of a file is the CPU time of the whole command, start and reading included. Beside it stands
the plan alone, in this process. With ``--all`` the walk over joint configurations, which the quick
paths replace, plans them too; if it gives up, its figure is the time until then, and more than
12,000 random questions are asked (seeds 0 to 5399) instead of 1,200. A route is equal if all its
steps are. ``--seeds=A:B`` asks those of a part of the seeds, and runs no files.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from subprocess import DEVNULL, run

from benches.row import Row, process_ms
from benches.seeds import chosen, is_part
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.terms import Terms
from tests.dispatch.large import LARGE
from tests.dispatch.planned import Question, answer, decomposed, lines, questions, walked
from tests.dispatch.runs import blueprint

SEEDS, SHARE = 5_400, 540
EACH = 3
"""The largest number of questions that a seed gives."""
PROMISES = (10, 2, 2, 2)


def rows() -> Iterator[Row]:
    """The files, and a share of the questions."""
    if not is_part():
        yield from _files(everything=False)
    yield from _equal(SHARE)


def all_rows() -> Iterator[Row]:
    """The same with the walk beside it, and all questions."""
    if not is_part():
        yield from _files(everything=True)
    yield from _equal(SEEDS)


def _files(everything: bool) -> Iterator[Row]:
    for (name, make), promise in zip(LARGE.items(), PROMISES, strict=True):
        values = make()
        made = blueprint(values)
        base = made["BASE"]
        start = start_configuration(Hierarchy(made), {})
        question = Question(made, Terms(), start, (Address("BASE", base.activating),))
        others = [("the plan alone", _seconds(question, walk=False))]
        if everything:
            others.append(("the walk", _seconds(question, walk=True)))
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "large.json"
            file.write_text(json.dumps(values), "utf-8")
            asked = ("run", str(file), "--world", "table")
            seconds = _command(*asked)
            bound = f"at most {promise} s"
            yield Row(f"run in the table world, {name}", seconds, "s", tuple(others), bound)
            ends = ("--sb", "BASE", "--from", base.initial, "--to", base.activating)
            yield Row(f"route, {name}", _command("route", str(file), *ends), "s", (), bound)


def _command(*words: str) -> float:
    """Return the CPU seconds of one command of the program. CalledProcessError if it fails."""
    line = (sys.executable, "-m", "smsl_studio", *words)
    return (
        process_ms(lambda: run(line, check=True, stdout=DEVNULL, stderr=DEVNULL), runs=3, warmup=1)
        / 1000
    )


def _seconds(question: Question, walk: bool) -> float:
    began = time.process_time()
    found = walked(question) if walk else answer(question)
    print(*lines(found)[:1], file=sys.stderr, flush=True) if isinstance(found, str) else None
    return time.process_time() - began


def _equal(seeds: int) -> Iterator[Row]:
    seen: Counter[str] = Counter()
    spent = {"quick": 0.0, "walk": 0.0}
    for seed in chosen("plans", 0, seeds):
        for question in questions(seed, EACH):
            began = time.process_time()
            found = answer(question)
            middle = time.process_time()
            oracle = walked(question)
            spent["quick"] += middle - began
            spent["walk"] += time.process_time() - middle
            seen["all"] += 1
            seen["routes"] += bool(found)
            seen["short"] += decomposed(question)
            seen["different"] += found != oracle
            if found != oracle:
                print(seed, *lines(found), *lines(oracle), sep="\n", file=sys.stderr, flush=True)
    words = f"{seen['all']:,} random questions, {seen['routes']:,} with a route, "
    words += f"{seen['short']:,} decomposed: other routes than by the walk"
    yield Row(words, seen["different"], "", (), "0")
    yield Row(
        f"the plans of these {seen['all']:,} questions",
        spent["quick"],
        "s",
        (("the walk", spent["walk"]),),
    )
