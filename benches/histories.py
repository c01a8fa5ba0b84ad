"""Twenty random histories of a blueprint in git: branches, merges and rebases, some with renames.

Every merge of git is held against the merge of the three versions in one process, and that against
an oracle (see ``tests/cli/histories.py``). Without ``--all`` it grows four. A finding is printed
with the number of the history.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from benches.row import Row
from tests.cli.histories import History

ALL, SOME = 20, 4


def rows() -> Iterator[Row]:
    """Grow a fifth."""
    return _rows(SOME)


def all_rows() -> Iterator[Row]:
    """Grow all, some minutes."""
    return _rows(ALL)


def _rows(count: int) -> Iterator[Row]:
    found = merges = conflicts = 0
    for number in range(count):
        with TemporaryDirectory() as folder:
            history = History(Path(folder), number)
            try:
                history.grow()
            except AssertionError as error:
                found += 1
                print(f"history {number}: {error}", file=sys.stderr)
            merges += history.merges
            conflicts += history.conflicts
    words = f"{count} histories in git, {merges:,} merges, {conflicts:,} conflicts"
    yield Row(f"{words}: findings", found, "histories", bound="0")
