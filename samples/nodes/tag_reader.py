"""A reader below the tray: it reads the passive tags of instruments that lie within its range.

A tag has no battery and says nothing by itself. So the reader tells how far (m) each tag is that it
reads, and how many it reads at all. A tag out of range is not read: nothing is told about it.
"""

import sys

from sample_node import Value, play

RANGE = 0.6
"""How far the reader reads, in metres."""
TRAY = {"tag_drill": 0.1, "tag_pointer": 0.2, "tag_clamp": 0.3, "tag_saw": 0.35}
"""How far each tag is when its instrument lies in the tray."""
FAULTS = {
    "put back": "the drill lies in the tray again",
    "pointer out": "the pointer was taken out of the tray",
    "weak": "the reader reads half as far and misses some tags",
}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """The distance of each tag that is read, and their number."""
    taken = set() if "put back" in faults else {"tag_drill"}
    taken |= {"tag_pointer"} if "pointer out" in faults else set()
    reach = RANGE / 3 - 0.05 if "weak" in faults else RANGE
    far = {tag: 2.0 if tag in taken else metres for tag, metres in TRAY.items()}
    read: dict[str, Value] = {tag: metres for tag, metres in far.items() if metres <= reach}
    return {**read, "tags_read": float(len(read))}


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
