"""A tracker that sees a marker on the bone: how well it fits (mm). Hidden, it measures nothing."""

import math
import sys

from sample_node import Value, play

FAULTS = {"hidden": "somebody stands before the marker", "bent": "the marker is bent"}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """What it measures at a time (s)."""
    if "hidden" in faults:
        return {"marker_error": None}
    error = 3.1 if "bent" in faults else 0.35
    return {"marker_error": error + 0.08 * math.sin(at * 2)}


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
