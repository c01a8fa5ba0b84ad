"""A seeded part of the tampers: none is let through, and each gets a code that fits."""

from __future__ import annotations

import pytest

from tests.inspection.approval.tampers import FITS, KINDS, base, tampered, verdict

EACH = 30
"""``python -m benches tampers`` tries many more."""


@pytest.mark.parametrize("number", range(3))
def test_what_was_signed_is_approved(number: int) -> None:
    assert verdict(base(number)) == set()


@pytest.mark.parametrize("kind", KINDS)
def test_no_tamper_is_let_through(kind: str) -> None:
    for number in range(EACH):
        found = tampered(kind, number)
        if found is not None:
            assert found[1] & FITS[kind], (kind, number, found[1])
