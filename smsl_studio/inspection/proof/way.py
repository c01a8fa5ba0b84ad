"""The way to a place that a search has reached."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

Node = TypeVar("Node")
Step = TypeVar("Step")


def way_to(
    end: Node, before: Callable[[Node], tuple[Node, Step] | None]
) -> tuple[Node, tuple[Step, ...]]:
    """Return where the way to ``end`` begins, and its steps in order.

    ``before`` has for each place the one before it and the step from there; None at a beginning.
    """
    found: list[Step] = []
    while (origin := before(end)) is not None:
        end, step = origin
        found.append(step)
    return end, tuple(reversed(found))
