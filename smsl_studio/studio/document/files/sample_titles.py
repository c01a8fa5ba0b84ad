"""The titles of the samples, and the sentence on each."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ShownSample:
    """A sample with a title and one sentence."""

    file: str
    title: str
    words: str


SAMPLES = (
    ShownSample("hanoi-corrected.json", "Tower of Hanoi, 3 disks",
           "27 states in a triangle, and a run in physics."),
    ShownSample("registration.json", "Register a patient",
           "Four facts, and the ways back when one is undone."),
    ShownSample("registration-digitization.json", "Two levels: digitize, register",
           "A fact that a smaller State Branch makes true."),
    ShownSample("registration-failures.json", "Failures and recovery",
           "Three failure states, and the operations that lead out."),
    ShownSample("registration-people.json", "People in the loop",
           "Operations and facts that wait for a person."),
)  # fmt: skip
TITLES = {sample.file: sample.title for sample in SAMPLES}
"""The titles by the name of the file. Other samples are called by their file."""
