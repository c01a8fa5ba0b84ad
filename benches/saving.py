"""Saves: the cost of a save that is complete or has no effect, and kill -9 during a save."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from benches.row import Row, median_ms
from smsl_studio.blueprint.writing import values_of
from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.json_form import parse_json, write_json
from smsl_studio.smsl.together import save_together

KILLS = 1000


def rows() -> Iterator[Row]:
    """One file and three of 700 kB; then kills at random moments and at every step."""
    document = parse_json(write_json(values_of(hanoi(8))), "bench.json")
    with tempfile.TemporaryDirectory() as name, _home():
        paths = [Path(name, f"{number}.json") for number in range(3)]
        raw = document.encoded()

        def plainly() -> None:
            for path in paths:
                path.write_bytes(raw)

        plain = ("write_bytes", median_ms(plainly))
        pairs = [(document, path) for path in paths]
        yield Row(
            "save three files together", median_ms(lambda: save_together(pairs)), "ms", (plain,)
        )
        one = ("write_bytes", plain[1] / 3)
        single = median_ms(lambda: save_document(document, paths[0]))
        yield Row("save one file", single, "ms", (one,))
    for how, words in ((str(KILLS), "at a random moment of saving"), ("grid", "at every step")):
        counts = _killed(how)
        kills = counts.pop("kills")
        del counts["unfinished"]
        wrong = sum(counts.values())
        yield Row(f"{kills:,} kills {words}", wrong, "mixtures", bound="0")


@contextmanager
def _home() -> Iterator[None]:
    """A user's folder for the records of saves, and for the processes that are killed."""
    before = os.environ.get("SMSL_STUDIO_HOME")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SMSL_STUDIO_HOME"] = folder
        try:
            yield
        finally:
            del os.environ["SMSL_STUDIO_HOME"]
            if before is not None:
                os.environ["SMSL_STUDIO_HOME"] = before


def _killed(how: str) -> dict[str, int]:
    with tempfile.TemporaryDirectory() as name, _home():
        done = subprocess.run(
            [sys.executable, "-m", "tests.smsl.killed", name, how, "1"],
            capture_output=True,
            check=True,
        )
        counts: dict[str, int] = json.loads(done.stdout)
        return counts
