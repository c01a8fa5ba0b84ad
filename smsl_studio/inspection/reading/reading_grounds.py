"""What a reading is made from besides the blueprint: a route, verdicts, ways out and changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.difference import Difference
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.inspection.proof.recovery import WayOut
from smsl_studio.inspection.proof.verdict import PropertyVerdict


@dataclass(frozen=True)
class ReadingGrounds:
    """The answers of the engine that the sentences repeat.

    ``start`` is the configuration in which a run starts, None if no run can start, and then
    ``refusal`` says why. ``steps`` is the cheapest route from there to all goals, None if there is
    none (or none was found: ``bound``). ``ways`` are the ways out of failure states, and ``costs``
    the costs from there to the goals, None for none. ``difference`` has the changes since a former
    version, ``former`` names it.
    """

    start: Mapping[str, str] | None
    steps: tuple[JointStep, ...] | None
    refusal: str = ""
    bound: str = ""
    verdicts: tuple[PropertyVerdict, ...] = ()
    ways: tuple[WayOut, ...] = ()
    costs: Mapping[Address, float | None] = field(default_factory=dict)
    difference: Difference | None = None
    former: str = ""
