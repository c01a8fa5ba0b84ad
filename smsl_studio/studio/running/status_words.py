"""The words of the status line about a run: world, seed, time, pace and process."""

from __future__ import annotations

from smsl_studio.studio.base.words import capital
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.runner import FASTEST
from smsl_studio.world.engines import TABLE

Words = tuple[tuple[str, ...], tuple[str, ...]]


def status_words(run: RunSession, speed: float, moved_on: bool) -> Words:
    """The texts for the left and the right side of the status line."""
    choice, status = run.choice, run.status
    if choice is None:
        return ("No run yet",), ("Simulation only",)
    left = [f"World {choice.world}", f"Seed {choice.seed}"]
    if status is not None:
        left.append(f"Simulated {status.time:.1f} s")
    if run.exists:
        left.append(_pace(speed, choice.world == TABLE))
        left.append(f"Frozen copy, drawing {'has moved on' if moved_on else 'unchanged'}")
    if run.sentence:
        left.append(capital(run.sentence))
    right = ("Recording", "Simulation only") if _is_recording(run) else ("Simulation only",)
    if run.latency is not None and status is not None:
        return tuple(left), (f"Alive, {max(run.latency * 1000, 0.1):.1f} ms", *right)
    return tuple(left), right


def _is_recording(run: RunSession) -> bool:
    return run.exists and run.record is not None


def _pace(speed: float, table: bool) -> str:
    if speed == FASTEST:
        return "As fast as it goes"
    if table:
        return f"Operations shown at {speed:g} ×"
    return "Paced at real time" if speed == 1.0 else f"Paced at {speed:g} × real time"
