"""The words for the ten run states, and for the end of a run."""

from __future__ import annotations

PHASES: dict[str, tuple[str, str]] = {
    "": ("No run", "quiet"),
    "opening": ("Opening", "quiet"),
    "idle": ("Idle", "quiet"),
    "ready": ("Ready", "quiet"),
    "running": ("Running", "busy"),
    "paused": ("Paused", "quiet"),
    "waiting": ("Waiting for a human", "busy"),
    "no_route": ("No route", "held"),
    "taken_over": ("Taken over", "person"),
    "fault_hold": ("Fault hold", "held"),
    "stopped": ("Stopped", "held"),
    "done": ("Done", "good"),
    "goal_reached": ("Goal reached", "good"),
    "held": ("Held", "held"),
    "failed": ("Fault hold", "held"),
    "refused": ("Refused", "held"),
}
"""For each state its words, and the style of its badge."""

HOLDS: dict[str, str] = {
    "guard_lost": "Guarded fact lost",
    "goal_unconfirmed": "Goal not confirmed",
    "hazard": "Hazard",
}
"""The headings of special kinds of holds."""

LATCHED = ("stopped", "fault_hold", "no_route", "taken_over")
"""The run states in which nothing moves until a person has decided."""


OUTCOMES: dict[str, str] = {"failed": "failed"}
"""The words of ends that differ from those of the run state."""


def phase_words(phase: str, over: bool = False) -> tuple[str, str]:
    """Return the words of a run state and the style of its badge.

    ``over`` says that the run has ended in this state, so that it waits for nobody.
    """
    words, kind = PHASES.get(phase, (phase.replace("_", " ").capitalize(), "quiet"))
    if over and kind != "good" and phase not in ("", "refused"):
        return f"Ended: {OUTCOMES.get(phase, words.lower())}", "quiet"
    return words, kind


def outcome_words(phase: str) -> str:
    """Return how a run has ended, as words within a sentence."""
    return OUTCOMES.get(phase, phase_words(phase)[0].lower())
