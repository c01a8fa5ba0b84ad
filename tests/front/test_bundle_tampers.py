"""A seeded part of the tampers with bundles: ``verify.py`` believes none of them."""

from __future__ import annotations

import pytest

from tests.front.bundle_tampers import BUNDLE_KINDS, is_believed, is_let_through, whole

EACH = 30
"""``python -m benches.tampers`` tries many more."""


def test_the_bundle_itself_is_believed() -> None:
    assert is_believed(whole())


@pytest.mark.parametrize("kind", BUNDLE_KINDS)
def test_no_tamper_with_a_bundle_is_believed(kind: str) -> None:
    found = [is_let_through(kind, number) for number in range(EACH)]
    assert found.count(True) == 0, found.index(True)
    assert found.count(False) > EACH * 0.9
