"""The random cases of tests in their whole counts: ``./dev test`` takes a twentieth, at least 25.

Which tests have such counts is read from their files: they use ``tests/counts.py``, or Hypothesis,
whose number of examples stands in ``tests/conftest.py``.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row

ROOT = Path(__file__).parent.parent
WORKERS = 2


def rows() -> Iterator[Row]:
    """Run the tests with random cases, and count those that are red."""
    words = ["-m", "pytest", "-q", "-n", str(WORKERS), "-p", "no:cacheprovider", *counted_tests()]
    done = subprocess.run(
        [sys.executable, *words],
        cwd=ROOT,
        env={**os.environ, "SMSL_COUNTS": "whole"},
        capture_output=True,
        text=True,
        check=False,
    )
    last = done.stdout.strip().splitlines()[-1] if done.stdout.strip() else done.stderr
    told = {kind: int(number) for number, kind in re.findall(r"(\d+) (passed|failed|error)", last)}
    red = told.get("failed", 0) + told.get("error", 0)
    if red or not told.get("passed"):
        print(done.stdout, done.stderr, sep="\n", file=sys.stderr)
        red = red or 1
    work = f"{sum(told.values()):,} tests with all their random cases, red ones"
    yield Row(work, red, "tests", bound="0")


def counted_tests() -> list[str]:
    """Return the test files with random cases, by their names from the root of the checkout."""
    found = []
    for file in sorted((ROOT / "tests").rglob("test_*.py")):
        text = file.read_text(encoding="utf-8")
        if "share_of(" in text or "@given" in text:
            found.append(str(file.relative_to(ROOT)))
    return found
