"""100,000 tampers with approvals: how many of them are let through.

Each is drawn from a number (``tests/inspection/approval/tampers.py``), so that a finding can be
looked at again. A tamper is let through if the blueprint counts as approved all the same. A changed
byte that changes no meaning of a blueprint is drawn again.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator

from benches.row import Row
from tests.inspection.approval.tampers import FITS, KINDS, tampered

COUNT = 100_000


def rows() -> Iterator[Row]:
    """Count the tampers that are let through, and those whose code does not fit, by kind."""
    began = time.process_time()
    each = -(-COUNT // len(KINDS))
    for kind in KINDS:
        through, unfit, tried = _tried(kind, each)
        yield Row(f"{tried:,} tampers, {kind}: let through", through, "", bound="0")
        yield Row(f"{kind}: told by a code that does not fit", unfit, "", bound="0")
    yield Row("one tamper", (time.process_time() - began) * 1000 / (each * len(KINDS)))


def _tried(kind: str, each: int) -> tuple[int, int, int]:
    through = unfit = tried = number = 0
    told: Counter[str] = Counter()
    while tried < each:
        found = tampered(kind, number)
        number += 1
        if found is None:
            continue
        tried += 1
        told.update(found[1])
        through += not found[1]
        unfit += not found[1] & FITS[kind]
    print(f"{kind}: {dict(told.most_common())}", file=sys.stderr)
    return through, unfit, tried
