"""Campaigns on a Dask cluster: a scheduler and workers in processes of their own, as users start
them."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import UsageError, WorldError
from smsl_studio.front import campaign_cluster
from smsl_studio.front.campaign_cluster import carried_out, code_of, files_of
from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaign_runs import CampaignRun, run_as_json
from smsl_studio.shipped import samples_dir

SAMPLE = samples_dir() / "hanoi-2.json"


class Cluster:
    """A scheduler and workers. Each worker has one thread and no nanny that would restart it."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._processes = folder, list[subprocess.Popen[bytes]]()
        self._file = folder / "scheduler.json"
        self._start("scheduler", "--port", "0", "--host", "127.0.0.1")

    def _start(self, kind: str, *words: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "distributed.cli.dask_" + kind, *words]
        command += ["--scheduler-file", str(self._file), "--no-dashboard"]
        process = subprocess.Popen(
            command, cwd=self._folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self._processes.append(process)
        return process

    def worker(self) -> subprocess.Popen[bytes]:
        """Start a worker."""
        return self._start("worker", "--nthreads", "1", "--no-nanny", "--host", "127.0.0.1")

    @property
    def address(self) -> str:
        """The address of the scheduler, as soon as it has written its file."""
        while True:
            assert self._processes[0].poll() is None, "the scheduler has ended"
            try:
                return str(json.loads(self._file.read_text())["address"])
            except (FileNotFoundError, ValueError):
                continue

    def close(self) -> None:
        """End all processes."""
        for process in reversed(self._processes):
            process.kill()
            process.wait()


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    one = Cluster(tmp_path)
    yield one
    one.close()


def test_two_workers_of_which_one_is_lost_give_the_digest_of_one_process(
    cluster: Cluster, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(campaign_cluster, "TABLE_RUNS", 5)
    first, _second = cluster.worker(), cluster.worker()
    request = CampaignRequest(smsl.read(SAMPLE), seeds=20)
    alone = smsl.campaign(request)

    def lost(done: int, _every: int) -> None:
        """Kill a worker in the middle."""
        if done == 5:
            first.kill()

    part = tmp_path / "part.jsonl"
    there = replace(request, dask=cluster.address, part=part)
    assert smsl.campaign(there, lost) == alone
    half = part.read_text().splitlines(keepends=True)[:10]
    part.write_text("".join(half))
    told: list[int] = []
    resumed = replace(there, resume=True)
    assert smsl.campaign(resumed, lambda done, _: told.append(done)) == alone
    assert told == [*range(1, 21)]


def test_a_worker_with_other_code_is_refused(
    cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    cluster.worker()
    monkeypatch.setattr(campaign_cluster, "code_of", lambda *_: "0" * 64)
    request = CampaignRequest(smsl.read(SAMPLE), seeds=2, dask=cluster.address)
    with pytest.raises(WorldError, match="refuses: its program or the code of the world table"):
        smsl.campaign(request)


def test_a_cluster_without_workers_is_told(
    cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(campaign_cluster, "HELP", 0.1)
    request = CampaignRequest(smsl.read(SAMPLE), seeds=2, dask=cluster.address)
    with pytest.raises(WorldError, match=r"no worker for 0\.1 s"):
        smsl.campaign(request)


@pytest.mark.parametrize("address", ["nonsense", "http://a:1", "tcp://a b:1", "tcp://a:123456", ""])
def test_an_odd_address_is_refused(address: str) -> None:
    with pytest.raises(UsageError, match="no address of a Dask scheduler"):
        campaign_cluster.CampaignCluster(address, smsl.read(SAMPLE), "table")


def test_nobody_at_the_address_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(campaign_cluster, "CONNECT", 0.2)
    with pytest.raises(UsageError, match="no Dask scheduler answers at"):
        campaign_cluster.CampaignCluster("tcp://127.0.0.1:1", smsl.read(SAMPLE), "table")


def test_workers_here_and_there_are_refused() -> None:
    request = CampaignRequest(smsl.read(SAMPLE), workers=2, dask="tcp://127.0.0.1:1")
    with pytest.raises(UsageError, match="workers here or on a cluster"):
        smsl.campaign(request)


def test_a_task_carries_imports_and_bindings(tmp_path: Path) -> None:
    """They stand in folders beside and above, and are written again elsewhere."""
    (tmp_path / "smsl.toml").write_text("")
    (tmp_path / "parts").mkdir()
    (tmp_path / "main").mkdir()
    sub = {"SUB": {"State_0": {"Up": "State_1"}, "State_1": {}}}
    (tmp_path / "parts" / "sub.json").write_text(json.dumps(sub))
    header = {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1, "SUB_SBS": {"SUB": 0}}
    base = {"HEADER": header, "State_0": {"Rise": "State_1"}, "State_1": {}}
    main = tmp_path / "main" / "main.json"
    main.write_text(json.dumps({"_imports": ["../parts/sub.json"], "BASE": base}))
    main.with_suffix(".toml").write_text("")
    blueprint = smsl.read(main)
    files, own = files_of(blueprint)
    assert (sorted(files), own) == (
        ["main/main.json", "main/main.toml", "parts/sub.json", "smsl.toml"],
        "main/main.json",
    )
    line = json.dumps(run_as_json(CampaignRun("table", 0)))
    said = carried_out(files, own, "table", code_of(blueprint, "table"), [line])
    (verdict,) = map(json.loads, said)
    assert verdict["reason"] == smsl.run(blueprint).reason == "goal_reached"


def test_what_is_no_verdict_is_not_believed(
    cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    cluster.worker()
    request = CampaignRequest(smsl.read(SAMPLE), seeds=1, dask=cluster.address)
    for said in (5, ["x"], ["{}"], [], ['{"reached": true}'], None):
        monkeypatch.setattr(campaign_cluster, "carried_out", partial(_say, said))
        with pytest.raises(WorldError, match="gave no verdict"):
            smsl.campaign(request)


def _say(said: object, *_: object) -> object:
    return said
