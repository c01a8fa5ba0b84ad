"""Runs a share of the sequences, one after the other at one window."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.sequences.seat import Seat
from tests.sequences.sequence import LENGTH, Sequence


def findings(first: int, last: int, length: int = LENGTH) -> Iterator[str]:
    """The first finding of each of these sequences that has one; one that hangs is a finding."""
    with tempfile.TemporaryDirectory() as name:
        seat = Seat(Path(name))
        for number in range(first, last):
            sequence = Sequence(seat, number, length)
            try:
                found = next(sequence.findings(), "")
            except AssertionError as error:
                found = f"sequence {number}: {error}, after {sequence.acts}"
                seat = Seat(Path(name))
            if found:
                yield found
        seat.close()
