"""A long random count of a bench can be split by its seeds, and tells them."""

from __future__ import annotations

import sys

import pytest

from benches import proof, seeds


def test_the_parts_of_a_count_are_the_whole(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["bench"])
    whole = list(seeds.chosen("count", 10, 5))
    parts: list[int] = []
    for part in ("10:12", "12:15"):
        monkeypatch.setattr(sys, "argv", ["bench", f"--seeds={part}"])
        parts += seeds.chosen("count", 10, 5)
    assert parts == whole == [10, 11, 12, 13, 14]
    assert "count: seeds 12 to 14" in capsys.readouterr().err


def test_a_part_tells_how_far_it_is_and_measures_nothing_else(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(seeds, "EVERY", -1.0)
    monkeypatch.setattr(sys, "argv", ["bench", "--seeds=100000:100002"])
    (row,) = proof.all_rows()
    assert (row.ours, row.work.partition(",")[0]) == (0, "2 random blueprints")
    assert "1 of 2 are done" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["5", "a:b", "7:7", "9:3", "-1:4"])
def test_seeds_that_cannot_be_read_are_refused(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setattr(sys, "argv", ["bench", f"--seeds={text}"])
    with pytest.raises(SystemExit, match="two whole numbers"):
        list(seeds.chosen("count", 0, 1))
