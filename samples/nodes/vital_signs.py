"""A monitor of vital signs: pulse (bpm) and oxygen saturation (%) of the patient."""

import math
import sys

from sample_node import Value, play

FAULTS = {"fast": "the pulse is too high", "low": "too little oxygen", "loose": "a lead is loose"}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """What it measures at a time (s)."""
    if "loose" in faults:
        return {"pulse": None, "saturation": None}
    pulse = 138.0 if "fast" in faults else 72.0
    oxygen = 84.0 if "low" in faults else 97.0
    return {"pulse": pulse + 3 * math.sin(at / 2), "saturation": oxygen}


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
