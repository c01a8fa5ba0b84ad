"""A surgical drill that tells how fast it turns (rpm) and how warm it is (degC)."""

import math
import sys

from sample_node import Value, play

FAULTS = {"turning": "it turns although nobody uses it", "hot": "it is too warm to be used"}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """What its sensors measure at a time (s)."""
    speed = 800.0 if "turning" in faults else 0.0
    warm = 71.0 if "hot" in faults else 31.0
    return {"drill_speed": speed, "drill_temperature": warm + 0.4 * math.sin(at / 3)}


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
