"""How often forecasts were right: of one run, and of recordings."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.front import forecast_drift
from smsl_studio.front.forecast_drift import ForecastCount, ForecastRecord, drift_of, recorded_drift
from smsl_studio.front.inputs import read
from smsl_studio.runlog.events import ForecastTold
from smsl_studio.shipped import samples_dir

SAMPLE = samples_dir() / "hanoi-2.json"


def told(address: str, verdict: str, reason: str = "") -> ForecastTold:
    return ForecastTold(t=1.0, address=address, verdict=verdict, reason=reason)


def test_the_share_goes_on_and_what_was_wrong_stands_first() -> None:
    found = drift_of([
        told("SB/a/Go", "agrees"), told("SB/a/Go", "right"), told("SB/b/On", "wrong", "SB/0 is c"),
        told("SB/b/On", "right"), told("SB/a/Go", "right"), told("SB/c/End", "none"),
    ])  # fmt: skip
    assert found.rows == (
        ForecastCount("SB/b/On", 1, 2, "SB/0 is c"),
        ForecastCount("SB/a/Go", 2, 2),
    )
    assert found.words == "The world simulator was right in 3 of 4"
    assert found.shares == (1.0, 0.5, 2 / 3, 0.75)
    assert ForecastRecord().words == ""


def test_recordings_are_read_and_what_is_none_is_left_out(tmp_path: Path) -> None:
    assert recorded_drift(tmp_path / "missing") == ForecastRecord(runs=0)
    for name in ("one", "two"):
        front.run(read(SAMPLE), forecast="show", log=tmp_path / f"{name}.jsonl")
    front.run(read(SAMPLE), log=tmp_path / "without.jsonl")
    (tmp_path / "broken.jsonl").write_bytes(b"\x00nothing\n")
    found = recorded_drift(tmp_path)
    assert found.words == "The world simulator was right in 6 of 6, 2 runs"
    assert [row.count for row in found.rows] == [2, 2, 2]


def test_a_recording_that_is_too_large_is_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    front.run(read(SAMPLE), forecast="show", log=tmp_path / "one.jsonl")
    monkeypatch.setattr(forecast_drift, "LARGEST", 100)
    assert recorded_drift(tmp_path).outcomes == ()
