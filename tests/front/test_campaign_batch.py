"""Campaigns in the table world: runs that differ in their seed alone are made from one of them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.campaign_batch import NOT_BEGUN, OTHER, PEOPLE, PROOF, SeedBatch
from smsl_studio.front.campaign_faults import CampaignRequest, injections_of
from smsl_studio.front.campaign_runs import CampaignRun, RunVerdict, judged
from smsl_studio.shipped import samples_dir
from tests.approval import DOOR


def sample(name: str) -> Blueprint:
    return smsl.read(samples_dir() / f"{name}.json")


def one_by_one(request: CampaignRequest) -> str:
    digest = hashlib.sha256()
    for injection in injections_of(request):
        for seed in range(request.seeds):
            run = CampaignRun(request.world, seed, injection)
            digest.update(f"{judged(request.blueprint, run).sha256}\n".encode())
    return digest.hexdigest()


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize(
    ("name", "seeds", "faults"),
    [("hanoi-2", PROOF + 20, ()), ("hanoi-failures", 5, ("fail", "hang")), ("three-levels", 4, ())],
)
def test_the_digest_is_that_of_runs_that_are_carried_out(
    name: str, seeds: int, faults: tuple[str, ...], workers: int
) -> None:
    request = CampaignRequest(sample(name), seeds=seeds, faults=faults, workers=workers)
    done = smsl.campaign(request)
    assert done.digest == one_by_one(request)
    proofs = len(done.rows) * len(range(0, seeds, PROOF))
    made = done.runs - proofs if workers == 1 else 0
    assert (done.made, done.alone) == (made, "")


def test_runs_that_are_refused_are_carried_out_one_by_one() -> None:
    request = CampaignRequest(sample("registration-people"), seeds=3)
    done = smsl.campaign(request)
    assert (done.digest, done.made, done.alone) == (one_by_one(request), 0, NOT_BEGUN)


def test_runs_that_ask_people_are_carried_out_one_by_one(tmp_path: Path) -> None:
    values = {**DOOR, "DOOR": {**DOOR["DOOR"], "_operations": {"open": {"actor": "shared"}}}}
    (tmp_path / "door.json").write_text(json.dumps(values))
    request = CampaignRequest(
        smsl.read(tmp_path / "door.json"), seeds=2, faults=("fail",), edges="all"
    )
    done = smsl.campaign(request)
    assert (done.digest, done.alone) == (one_by_one(request), PEOPLE)


def test_where_a_proof_differs_the_rest_is_carried_out() -> None:
    blueprint = sample("hanoi-2")
    batch = SeedBatch(blueprint)

    def judge(asked: Sequence[CampaignRun]) -> Iterator[RunVerdict]:
        for run in asked:
            own = judged(blueprint, run)
            yield own if not run.seed else RunVerdict(own.reached, True, own.reason, own.sha256)

    asked = [CampaignRun("table", seed) for seed in range(PROOF + 3)]
    found = list(batch.verdicts(asked, judge))
    assert (batch.made, batch.alone) == (PROOF - 1, OTHER)
    assert found[PROOF].recovered
    assert found[PROOF + 1] == judged(blueprint, asked[PROOF + 1])
