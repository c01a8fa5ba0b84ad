"""A twentieth of the frames of ``benches/frames.py``: no crash, and no operation begins."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.channel.frame_trials import KINDS, Trials

EACH = 1000


@pytest.mark.parametrize("kind", KINDS)
def test_no_operation_begins_by_a_wrong_frame(kind: str, tmp_path: Path) -> None:
    trials = Trials(tmp_path)
    try:
        left = [number for number in range(EACH) if not trials.tried(kind, number)]
    finally:
        trials.close()
    assert (left, trials.begun) == ([], 0)
