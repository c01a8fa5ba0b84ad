"""True runs with the blueprints that were run: their logs are told again, and forged."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from random import Random
from typing import Any, NamedTuple
from unittest.mock import patch

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.run_header import log_header
from smsl_studio.front.script.lines import script_of
from smsl_studio.smsl.json_form import parse_json
from tests.dispatch.generated import blueprint_values
from tests.runlog.true_stories import true_log


class ToldRun(NamedTuple):
    """The bytes of a log, and the blueprint that was run."""

    raw: bytes
    blueprint: Blueprint


def told_runs(numbers: range, folder: Path) -> list[ToldRun]:
    """The runs of these numbers; equal numbers give equal stories. Every third is of a random
    blueprint of up to three levels, with shared subs, ``load`` and ``requires``.
    """
    with _blueprints() as ran:
        paths = [_leveled(n, folder) if n % 3 == 2 else true_log(n, folder) for n in numbers]
    return [ToldRun(path.read_bytes(), ran[path]) for path in paths if path in ran]


def _leveled(number: int, folder: Path) -> Path:
    """From anywhere to anywhere in a random blueprint; sometimes something fails or moves."""
    random, path = Random(f"levels {number}"), folder / f"levels-{number}.jsonl"
    values = blueprint_values(number)
    made = read_blueprint(parse_json(json.dumps(values), f"levels-{number}.json"))
    branches = list(made)
    goals = []
    for branch in random.sample(branches, random.choice([1, 1, 2]) if branches[1:] else 1):
        goals.append(str(Address(branch.name, random.choice(list(branch.table)))))
    lines = [json.dumps(line) for line in _faults(random, made)]
    acts = script_of("\n".join(lines).encode(), "script", made) if lines else None
    with suppress(StudioError):  # nothing was run, so there is no log or only a refusal
        smsl.run(
            made,
            goal=goals if random.random() < 0.7 else None,
            script=acts,
            on_mismatch=random.choice(["hold", "adopt"]),
            seed=number,
            log=path,
        )
    return path


def _faults(random: Random, made: Blueprint) -> Iterator[dict[str, Any]]:
    edges = [edge.address for branch in made for edge in branch.edges()]
    for edge in random.sample(edges, min(len(edges), random.choice([0, 0, 1, 2, 3]))):
        kind = random.choice(["fail", "raise", "nothing", "prune", "veto"])
        if kind in ("prune", "veto"):
            why = {"reason": "by chance"} if kind == "prune" else {}
            yield {"at": 0.0, "do": kind, "address": str(edge), **why}
        else:
            yield {"during": str(edge), "do": "inject", "fault": kind}


@contextmanager
def _blueprints() -> Iterator[dict[Path, Blueprint]]:
    """The blueprint of every log that is begun meanwhile, by its path."""
    found: dict[Path, Blueprint] = {}

    def noted(request: Any, loaded: Any) -> Any:
        found[request.log] = request.blueprint
        return log_header(request, loaded)

    with patch("smsl_studio.front.recorder.log_header", noted):
        yield found
