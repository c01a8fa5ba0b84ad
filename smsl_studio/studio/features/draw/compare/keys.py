"""The keys that lead from change to change, in the compare view and back from the drawing."""

from __future__ import annotations

NEXT_KEYS, PREVIOUS_KEYS = "F7", "Shift+F7"
