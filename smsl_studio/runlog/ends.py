"""The sentences for the end of a run that was stopped from outside."""

from __future__ import annotations

LET_GO = "The window let go of the run while it went on."
UNBEGUN = "Stopped before the run began."
BROKEN_OFF = "Stopped in the middle of a step."
