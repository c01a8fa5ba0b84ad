"""The reading of 2,000 random blueprints: false sentences, and the time of large reports.

Each sentence about what can happen is checked by plain steps of the tests, which share no code with
the program (``tests/inspection/reading/judged_reading.py``). The report of the towers of Hanoi with
eight disks (6,561 states) is measured as a whole command.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row, process_ms
from smsl_studio.generate.rules import hanoi_values
from tests.inspection.reading.judged_reading import judge

BLUEPRINTS = 2_000


def rows() -> Iterator[Row]:
    """Judge the sentences, and measure two reports."""
    found: Counter[str] = Counter()
    false = 0
    for number in range(BLUEPRINTS):
        try:
            found.update(judge(number))
        except AssertionError as fault:
            false += 1
            print(f"blueprint {number}: {fault}", file=sys.stderr)
    told = ", ".join(f"{many:,} {kind}" for kind, many in found.most_common())
    yield Row(f"{BLUEPRINTS:,} random blueprints ({told}): with a false sentence", false, bound="0")
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "hanoi.json"
        file.write_text(json.dumps(hanoi_values(8)))
        for form in ("html", "pdf"):
            command = [sys.executable, "-m", "smsl_studio", "report", str(file), "-o"]
            command.append(str(file.with_suffix(f".{form}")))

            def whole(words: list[str] = command) -> None:
                subprocess.run(words, check=True, capture_output=True)

            work = f"report of 6,561 states as {form.upper()}"
            yield Row(work, process_ms(whole, runs=3), bound="at most 20,000 ms")
