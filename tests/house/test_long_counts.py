"""Long counts of the benches go on after a stop, and count nothing twice."""

from __future__ import annotations

from pathlib import Path

import pytest

from benches.shares import Share, counted, shares_of

SEEDS = 10


class Work:
    """Counts the even seeds, and notes what it was asked; it may be stopped before a share."""

    def __init__(self, stop: int | None = None) -> None:
        self.asked: list[int] = []
        self._stop = stop

    def __call__(self, kind: str, first: int, behind: int) -> dict[str, int]:
        if first == self._stop:
            raise KeyboardInterrupt
        self.asked.append(first)
        return {"seen": behind - first, "even": sum(seed % 2 == 0 for seed in range(first, behind))}


def test_shares_have_each_seed_once() -> None:
    found = shares_of(["a", "b"], 3, SEEDS, 4)
    assert found == [Share("a", 3, 7), Share("a", 7, 10), Share("b", 3, 7), Share("b", 7, 10)]


def test_a_stopped_count_goes_on_and_has_the_same_sums(tmp_path: Path) -> None:
    keep, parts = tmp_path / "keep.jsonl", shares_of(["a"], 0, SEEDS, 4)
    whole = counted(Work(), parts)
    assert whole["a"] == {"seen": 10, "even": 5}
    first = Work(stop=8)
    with pytest.raises(KeyboardInterrupt):
        counted(first, parts, keep=keep)
    second = Work()
    assert counted(second, parts, keep=keep) == whole
    assert (first.asked, second.asked) == ([0, 4], [8])


def test_a_line_that_was_cut_is_counted_again(tmp_path: Path) -> None:
    keep, parts = tmp_path / "keep.jsonl", shares_of(["a"], 0, SEEDS, 4)
    whole = counted(Work(), parts, keep=keep)
    keep.write_bytes(keep.read_bytes()[:-9])
    again, once_more = Work(), Work()
    assert counted(again, parts, keep=keep) == whole
    assert counted(once_more, parts, keep=keep) == whole
    assert (again.asked, once_more.asked) == ([8], [])


def test_how_far_it_is_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    counted(Work(), shares_of(["a"], 0, SEEDS, 5))
    lines = capsys.readouterr().err.splitlines()
    assert [line.partition(",")[0] for line in lines] == ["1 of 2", "2 of 2"]
    assert lines[0].endswith("a 0-5: 5 seen, 3 even")
