"""A function has at most six parameters."""

from __future__ import annotations

from pathlib import Path

from tests.house.survey import survey

PACKAGE = Path(__file__).parents[2] / "smsl_studio"
MOST = 6
VERBS = {"generate_code", "generate_explore", "run", "open_run", "preview", "sweep", "try_edge"}
"""The verbs of the front door in their public form, with keywords."""


def test_functions_have_six_arguments_at_most() -> None:
    found = set()
    for one in survey(PACKAGE):
        file = one.path.relative_to(PACKAGE).as_posix()
        for line, name, count in one.functions:
            public = file.startswith("front/") and name in VERBS
            if count > MOST and not public:
                found.add(f"{file}:{line} {name}")
    assert not found
