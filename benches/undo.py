"""10,000 random sequences of what gestures do to a session: undone whole, all bytes are as before.

``tests/studio/document/undo_sequences.py`` draws the sequences and redoes each one, too. Without
``--all`` it takes a tenth. The tests take a twentieth. ``./dev bench sequences`` does the same at a
real window, with the pointer and keys.
"""

from __future__ import annotations

from collections.abc import Iterator

from benches.pooled import judged
from benches.row import Row

ALL, SOME, PART = 10_000, 1_000, 100


def rows() -> Iterator[Row]:
    """Run a tenth of the sequences."""
    return _rows(SOME)


def all_rows() -> Iterator[Row]:
    """Run all sequences, some minutes."""
    return _rows(ALL)


def _rows(count: int) -> Iterator[Row]:
    found, spent = judged(_share, count, PART)
    yield Row(f"{count:,} random sequences in a session, not undone to the same bytes", found,
              "sequences", bound="0")  # fmt: skip
    yield Row("one sequence, undone and redone", spent * 1000 / count)


def _share(first: int) -> tuple[list[str], float]:
    """The findings of one part, and the CPU seconds it took."""
    import time

    from smsl_studio.studio.shell.application import make_application
    from tests.studio.document.undo_sequences import findings

    make_application(["undo"])
    began = time.process_time()
    return list(findings(first, first + PART)), time.process_time() - began
