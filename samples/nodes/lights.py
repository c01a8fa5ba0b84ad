"""The lights over the table: how bright they are set (%)."""

import sys

from sample_node import Value, play

FAULTS = {"dim": "they are dimmed"}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """What they tell at a time (s)."""
    return {"light": 20.0 if "dim" in faults else 85.0}


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
