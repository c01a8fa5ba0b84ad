"""A camera over the sterile zone: how many sterile persons stand in it, and how many others."""

import sys

from sample_node import Value, play

FAULTS = {
    "one away": "one of the sterile persons steps back",
    "stranger": "a person who is not sterile stands in the zone",
}


def measured(at: float, faults: frozenset[str]) -> dict[str, Value]:
    """The counts at a time (s)."""
    return {
        "sterile": 1.0 if "one away" in faults else 3.0,
        "not_sterile": 1.0 if "stranger" in faults else 0.0,
    }


if __name__ == "__main__":
    sys.exit(play(measured, FAULTS))
