"""Any history of edits, undo and redo restores each earlier text exactly, in both lossless
forms."""

from __future__ import annotations

import pytest

from tests.blueprint.histories import history
from tests.counts import share_of


@pytest.mark.parametrize("part", range(max(1, share_of(600) // 60)))
def test_undo_and_redo_are_exact_and_an_edit_touches_only_its_element(part: int) -> None:
    edits = sum(history(seed).edits for seed in range(part * 60, part * 60 + 60))
    assert edits > 150
