"""A badge reader at the door: how many surgeons and how many persons are in the room.

It knows roles and counts. The names stay in the badge system.
"""

import sys

from sample_node import Value, play

FAULTS = {"surgeon out": "the surgeon leaves the room", "one out": "the assistant leaves the room"}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """The counts at a time (s)."""
    surgeons = 0.0 if "surgeon out" in faults else 1.0
    others = 2.0 if "one out" in faults else 3.0
    return {"surgeons": surgeons, "persons": surgeons + others}


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
