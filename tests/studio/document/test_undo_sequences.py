"""A twentieth of the sequences of ``./dev bench undo --all`` comes back to the same bytes."""

from __future__ import annotations

import pytest

from tests.studio.document.undo_sequences import findings

PARTS, PART = 5, 100


@pytest.mark.parametrize("part", range(PARTS))
def test_what_gestures_did_is_undone_to_the_same_bytes(qapp: object, part: int) -> None:
    assert not list(findings(part * PART, (part + 1) * PART))
