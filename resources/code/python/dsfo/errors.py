"""The expected errors: each is a sentence, and an advice where there is one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from itertools import islice


class DsfoError(Exception):
    """An expected error."""

    def __init__(self, sentence: str, advice: str = "") -> None:
        super().__init__(sentence)
        self.sentence, self.advice = sentence, advice

    @property
    def words(self) -> str:
        """The sentence with its advice."""
        return f"{self.sentence}. {self.advice}".strip()


class UsageError(DsfoError):
    """A word of the command line or a line of a script that makes no sense (exit status 2)."""


class RunRefused(DsfoError):
    """A check at the start has refused the run. Nothing has moved.

    ``refusals`` are pairs of a code and a sentence, where a policy guards the run.
    """

    def __init__(
        self, sentence: str, advice: str = "", refusals: Sequence[tuple[str, str]] = ()
    ) -> None:
        super().__init__(sentence, advice)
        self.refusals = [{"code": code, "sentence": words} for code, words in refusals]


class PlanningError(DsfoError):
    """The search for a route was given up. A route may exist."""


class WorldGone(DsfoError):
    """The world does not answer any more."""


class Unavailable(Exception):
    """An answer: an edge cannot be carried out from here, for these reasons."""

    def __init__(self, *reasons: str, hazard: str = "") -> None:
        super().__init__("; ".join(reasons))
        self.reasons, self.hazard = reasons, hazard


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return an advice with the most similar known name, or the empty text."""
    near = get_close_matches(name[:200], list(islice(known, 5000)), n=1)
    return f"Did you mean {near[0]}?" if near else ""
