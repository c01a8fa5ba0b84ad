"""An imaging arm that tells its angle (deg): 0 is parked, 90 is over the table."""

import math
import sys

from sample_node import Value, play

FAULTS = {"over": "it stands over the table"}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """What it measures at a time (s)."""
    return {"arm_angle": (88.0 if "over" in faults else 2.0) + 0.2 * math.sin(at)}


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
