"""10,000 random sequences of acts in a real window: after each act all its parts must agree.

An act adds a state or an operation, renames, moves, deletes, undoes, redoes, saves, opens the file
again, shows another mode, tab, SB or fact, or runs a few operations in a table world. After each
act the drawing, the selection, Properties, the outline, the title, the text, the history and the
blueprint are compared (``tests/sequences/agreement.py``). Saved files are read back with their
positions. Without ``--all`` it runs a tenth. ``python -m tests.sequences NUMBER`` shows one
sequence again.
"""

from __future__ import annotations

from collections.abc import Iterator

from benches.pooled import judged
from benches.row import Row

ALL, SOME = 10_000, 1_000
SHARE = 50
"""The number of sequences in one window before another window is opened."""


def rows() -> Iterator[Row]:
    """Run a tenth of the sequences."""
    return _rows(SOME)


def all_rows() -> Iterator[Row]:
    """Run all sequences, which takes an hour of two cores."""
    return _rows(ALL)


def _rows(count: int) -> Iterator[Row]:
    found, spent = judged(_share, count, SHARE)
    yield Row(f"{count:,} random sequences at a window, something does not agree in", found,
              "sequences", bound="0")  # fmt: skip
    yield Row("one sequence and what is compared", spent * 1000 / count)


def _share(first: int) -> tuple[list[str], float]:
    """The findings of one share, and the CPU seconds it took."""
    import time

    from smsl_studio.studio.shell.application import make_application
    from tests.sequences.shares import findings

    application = make_application(["sequences"])
    began = time.process_time()
    found = list(findings(first, first + SHARE))
    application.processEvents()
    return found, time.process_time() - began
