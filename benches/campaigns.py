"""Campaigns in the table world: runs made from one that was carried out, and runs one by one."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Iterator

from benches.row import Row
from smsl_studio import front
from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaign_runs import CampaignRun, judged
from smsl_studio.front.inputs import read
from smsl_studio.shipped import samples_dir

RUNS, ALONE = 10_000, 500


def rows() -> Iterator[Row]:
    """Run 10,000 times, and 500 of them one by one. Times are CPU time, each run's share of it."""
    blueprint = read(samples_dir() / "hanoi-corrected.json")
    begun = time.process_time()
    digest = hashlib.sha256()
    for seed in range(ALONE):
        digest.update(f"{judged(blueprint, CampaignRun('table', seed)).sha256}\n".encode())
    alone = (time.process_time() - begun) * 1e6 / ALONE
    begun = time.process_time()
    done = front.campaign(CampaignRequest(blueprint, seeds=RUNS))
    made = (time.process_time() - begun) * 1e6 / RUNS
    few = front.campaign(CampaignRequest(blueprint, seeds=ALONE))
    yield Row("a run of Hanoi in a campaign of 10,000, table world", made, "us",
              (("one by one", alone),), "at most 0.05x one by one")  # fmt: skip
    yield Row(f"digests that differ from {ALONE} runs one by one",
              float(few.digest != digest.hexdigest()), "of 1", bound="0")  # fmt: skip
    yield Row(f"runs made of {done.runs:,}, the others carried out as a proof", done.made, "")
