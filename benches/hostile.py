"""200 hostile answers over a server on this machine: injection, code, links, pages, 10 MB, drips,
hangs, redirects, wrong schemas.

The chain runs in a process that is watched (``tests/generate/text/watched_chain.py``): what it asks
of the system is counted, and what it connects to besides the server. A server that is known to hang
gets 0.3 s here, so that it costs little.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from benches.row import Row
from tests.generate.text.hostile_cases import WHOLE, hostile_cases


def rows() -> Iterator[Row]:
    """Give all of them, and count what was run, opened or fetched."""
    with TemporaryDirectory() as folder:
        bait = Path(folder) / "bait.json"
        bait.write_text('{"BAIT": {"State_0": {}}}', encoding="utf-8")
        found = hostile_cases(range(WHOLE), bait)
        strange = len(list(Path(folder).iterdir())) - 1
    asked = sum(len(one.events) for one in found) + strange
    stages = Counter(one.stage for one in found)
    told = ", ".join(f"{stages[stage]} {name}" for stage, name in enumerate(STAGES))
    carried = sum(one.kind != "text" for one in found)
    kinds = f"{len(found) - carried} by their text, {carried} by how they are sent"
    work = f"{len(found)} hostile answers ({told}; {kinds}): run, opened or fetched"
    yield Row(work, asked, "events", bound="0")
    unkept = sum(not KEPT[one.stage] <= set(one.files) for one in found)
    yield Row("the same: what was reached before is not kept", unkept, "cases", bound="0")


STAGES = ("PM", "HIM", "PSM", "RMM")
_FILES = ("pm.md", "him.toml", "psm.json")
KEPT = tuple({"answers.json", *_FILES[:stage]} for stage in range(len(STAGES)))
