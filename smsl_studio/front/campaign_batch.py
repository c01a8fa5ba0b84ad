"""Runs of a campaign that differ in their seed alone. One is carried out, and the bytes of the
others are made from its bytes.

Only runs in the table world are such: nothing there is left to chance, and a seed stands in the
first event and nowhere else. Each hundredth run is carried out all the same, to prove it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.campaign_runs import (
    CampaignRun,
    Injection,
    RunVerdict,
    judged,
    request_of,
    verdict_of,
)
from smsl_studio.front.runs import run_request
from smsl_studio.runlog.events import RunStarted, TaskOpened

PROOF = 100
"""A run whose seed is a multiple of this number is carried out."""
NOT_BEGUN = "the run is refused"
PEOPLE = "people are asked"
OTHER = "a run with another seed has other events"

Judge = Callable[[Sequence[CampaignRun]], Iterator[RunVerdict]]
"""Carries runs out, and yields their verdicts in order."""


@dataclass(frozen=True, slots=True)
class _Template:
    """The bytes that a run prints, before and behind its seed, and its verdict."""

    before: bytes
    behind: bytes
    verdict: RunVerdict

    def of_seed(self, seed: int) -> RunVerdict:
        printed = b"%b%d%b" % (self.before, seed, self.behind)
        return replace(self.verdict, sha256=hashlib.sha256(printed).hexdigest())


class SeedBatch:
    """The verdicts of a campaign in the table world.

    ``made`` counts the runs whose bytes were made. ``alone`` says why others were carried out one
    by one; it is empty if none were.
    """

    def __init__(self, blueprint: Blueprint) -> None:
        self.made, self.alone = 0, ""
        self._blueprint = blueprint
        self._templates: dict[tuple[str, str], _Template | None] = {}

    def verdicts(self, asked: Sequence[CampaignRun], judge: Judge) -> Iterator[RunVerdict]:
        """Yield the verdicts of some runs in their order. ``judge`` carries runs out."""
        proofs = [run for run in asked if not run.seed % PROOF or self._template(run) is None]
        carried_out, seen = judge(proofs), set(map(id, proofs))
        for run in asked:
            template = self._template(run)
            if id(run) in seen:
                verdict = next(carried_out)
                if template is not None and verdict != template.of_seed(run.seed):
                    self._templates[_row(run.injection)], self.alone = None, OTHER
                yield verdict
            elif template is None:
                yield judged(self._blueprint, run)
            else:
                self.made += 1
                yield template.of_seed(run.seed)

    def _template(self, run: CampaignRun) -> _Template | None:
        """Return the template of a run's row, made from this run if there is none yet."""
        row = _row(run.injection)
        if row not in self._templates:
            self._templates[row] = self._made(run)
        return self._templates[row]

    def _made(self, run: CampaignRun) -> _Template | None:
        done = run_request(request_of(self._blueprint, run))
        if any(isinstance(event, TaskOpened) for event in done.events):
            self.alone = PEOPLE
            return None
        if not any(isinstance(event, RunStarted) for event in done.events):
            self.alone = NOT_BEGUN
            return None
        printed = b"".join(f"{event.line()}\n".encode() for event in done.events)
        before, mark, behind = printed.partition(b'"seed":')
        seed = b"%d" % run.seed
        if not mark or mark in behind or not behind.startswith(seed):
            self.alone = OTHER
            return None
        return _Template(before + mark, behind.removeprefix(seed), verdict_of(done))


def _row(injection: Injection | None) -> tuple[str, str]:
    return ("", "") if injection is None else (injection.fault, str(injection.edge))
