"""The sentences with which a run ends that was stopped from outside its own events."""

from __future__ import annotations

LET_GO = "The window let go of the run while it went on."
UNBEGUN = "Stopped before the run began."
BROKEN_OFF = "Stopped in the middle of a step."
