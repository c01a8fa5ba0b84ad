"""No two classes of the package have the same name."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

from tests.house.survey import survey

PACKAGE = Path(__file__).parents[2] / "smsl_studio"


def test_no_class_name_is_used_twice() -> None:
    homes: dict[str, list[str]] = defaultdict(list)
    for one in survey(PACKAGE):
        for name in one.classes:
            homes[name].append(one.path.relative_to(PACKAGE).as_posix())
    assert {name: files for name, files in homes.items() if len(files) > 1} == {}
