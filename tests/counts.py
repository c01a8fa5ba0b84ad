"""The number of random cases of a test: a share in the tests, all in the bench ``counts``.

A case has the same seed in both. ``SMSL_COUNTS=whole`` chooses all of them, as the bench does.
"""

from __future__ import annotations

import os

WHOLE = os.environ.get("SMSL_COUNTS") == "whole"
LEAST = 25
"""A share has at least so many cases, if there are so many."""


def share_of(count: int, least: int = LEAST) -> int:
    """Return a twentieth of ``count`` and at least ``least`` in the tests; in the bench, all."""
    return count if WHOLE else min(count, max(least, count // 20))
