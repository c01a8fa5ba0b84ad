"""The keys for the next and previous change, in the compare view and in the drawing."""

from __future__ import annotations

NEXT_KEYS, PREVIOUS_KEYS = "F7", "Shift+F7"
