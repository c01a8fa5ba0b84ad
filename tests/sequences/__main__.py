"""Runs sequences and prints the findings: ``python -m tests.sequences FIRST [LAST]``."""

from __future__ import annotations

import os
import sys


def main(first: int, last: int) -> int:
    """Do these sequences at one window; 1 where something does not agree."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from smsl_studio.studio.shell.application import make_application
    from tests.sequences.shares import findings

    application = make_application(["sequences"])
    found = 0
    for finding in findings(first, last):
        print(finding, flush=True)
        found += 1
    print(f"{last - first} sequences, {found} with findings")
    application.processEvents()
    return 1 if found else 0


if __name__ == "__main__":
    start = int(sys.argv[1])
    raise SystemExit(main(start, int(sys.argv[2]) if len(sys.argv) > 2 else start + 1))
